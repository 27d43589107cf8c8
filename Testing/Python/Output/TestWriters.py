# SPDX-License-Identifier: BSD-3-Clause
"""Every output of every filter, by every writer that ParaView offers for it: none ends the program, files are
there, and what ParaView reads again has as many points. Writers run in another process, which is begun again
after what has ended it."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

from rt_filters import FILTERS
from rt_proxies import proxies
from rt_testing import (closed_surface, density_image, disk_surface, load_plugin, main, points_in,
                        producer, region_map, size_of)

# What the writers of VTK do not take, with a message of their own: kinds of data and extensions.
NOT_WRITTEN = {
    ("image", "cgns"): "CGNS: no images",
    ("image", "jpg"): "unsigned char alone",
    ("image", "png"): "unsigned char and unsigned short alone",
    ("image", "tiff"): "neither double nor ids",
}

# Extensions whose writer ends the program with ParaView's own Wavelet, too: that of ParaView 5.13's IOSS.
ENDS_THE_PROGRAM = ("exo",)

# What is in a file, or read of it, where that is not all points.
NOT_COMPARED = {
    ("image", "csv"): "rows are cells where the arrays are theirs",
    ("image", "e"): "ParaView's reader does not take the cells of plane images",
    ("particles", "cgns"): "neither vertices nor lines are written",
    ("particles", "csv"): "rows are those of the field data where there are no others",
    ("particles", "e"): "points of no cell are not written, and lines not read",
    ("particles", "pdf"): "GDAL's reader reads no drawing",
    ("particles", "stl"): "triangles alone",
    ("surface", "csv"): "rows are cells where the arrays are theirs",
    ("surface", "pdf"): "GDAL's reader reads no drawing",
}


def ends_the_program(data, extension):
    """VTK's PLY writer has room for polygons of 256 corners. Its Exodus writer can write beyond its memory where
    some have more than four, ParaView 5.11 when it reads such a file: what comes later may then end the program."""
    corners = data.GetPolys().GetMaxCellSize() if data.IsA("vtkPolyData") else 0
    return corners > {"ply": 256, "e": 4}.get(extension, corners)


def kind_of(data):
    if data.IsA("vtkPolyData"):
        if data.GetNumberOfPoints() == 0:
            return "nothing"
        return "surface" if data.GetNumberOfPolys() else "particles"
    return {"vtkImageData": "image", "vtkTable": "table"}.get(data.GetClassName(), "grid")


def sources(simple, dimension, cells=True):
    """A small source for each kind of input. A density and its partner differ."""
    shape = (8, 6) if dimension == 2 else (4, 3, 2)

    def image(seed=0):
        return producer(simple, density_image(shape, cells, seed))

    def mesh():
        if dimension == 3:  # with arrays of points and of cells
            return simple.Elevation(Input=simple.Tetrahedralize(Input=image()))
        return simple.Plane(Origin=[0, 0, 0], Point1=[3, 0, 0], Point2=[0, 9, 0], XResolution=3)

    return {"density": image, "image": image, "Target": lambda: image(2),
            "densities": lambda: [image(), image(seed=2)], "mesh": mesh,
            "points": lambda: producer(simple, points_in(density_image((8, 6)), 9)),
            "disk": lambda: producer(simple, disk_surface()),
            "solid": lambda: producer(simple, closed_surface()),
            "map": lambda: producer(simple, region_map())}


def cases(simple):
    """Filters by name of the case, each for a quick run: in the plane and in space, with all of its inputs,
    and as it gives outputs of another kind."""
    found = {}
    for filter_ in FILTERS:
        def add(case, dimension, filter_=filter_, **options):
            found[(filter_.name + " " + case).strip()] = lambda: filter_.make(
                simple, sources(simple, dimension, options.pop("cells", True)), **options)

        add("", 2)
        if filter_.port_of("density", "densities", "mesh", "image") is not None:
            add("volume", 3)
            add("volume of points", 3, cells=False)
        if filter_.optional:
            add("with all inputs", 3, optional=True)
        for variant, properties in filter_.variants.items():
            add(variant, 3, **properties)
    return found


def writer_of(made, port, path):
    from paraview import servermanager
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    if path.endswith("xdmf3.xmf"):  # the second one of this extension
        writer = servermanager.writers.Xdmf3Writer(
            Input=servermanager.OutputPort(made, port), FileName=path)
    else:
        writer = servermanager._getPyProxy(factory.CreateWriter(path, made.SMProxy, port))
    if writer.GetProperty("DataMode"):  # not raw: see reads_appended_data
        writer.DataMode = "Binary"
    return writer


def file_names(made, port):
    """A file of the first extension of each writer that ParaView offers for an output."""
    from paraview import servermanager
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    factory.UpdateAvailableWriters()
    types = factory.GetSupportedFileTypes(made.SMProxy, port)
    names = ["file." + extension for extension in re.findall(r"\(\*\.(\w+)", types)
             if extension not in ENDS_THE_PROGRAM]
    return [name if name not in names[:i] else name.replace("file.xmf", "xdmf3.xmf")
            for i, name in enumerate(names)]


def read_again(simple, path):
    """The number of points, or rows, of what ParaView reads; None where it has no reader."""
    if path.endswith(".csv"):
        with open(path, encoding="utf-8") as file:
            return len(file.readlines()) - 1
    try:
        reader = simple.OpenDataFile(path)
    except RuntimeError:
        return None
    if reader is None:
        return None
    reader.UpdatePipeline()
    information = reader.GetDataInformation()
    return max(information.GetNumberOfPoints(), information.GetNumberOfRows())


def write_all(folder, done):
    """In the other process: writes what is not done yet, and says so before and after each."""
    simple = load_plugin()
    from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    lines = os.dup(1)  # among which are none that writers print
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)

    def say(*what):
        os.write(lines, (json.dumps(what) + "\n").encode())

    for name, make in cases(simple).items():
        made = make()
        made.UpdatePipeline()
        algorithm = made.GetClientSideObject()
        for port in range(algorithm.GetNumberOfOutputPorts()):
            data = algorithm.GetOutputDataObject(port)
            for file in file_names(made, port):
                extension = file.split(".")[1]
                key = "%s, port %d, %s" % (name, port, file)
                if key in done or ends_the_program(data, extension):
                    continue
                say("begin", key)
                at = os.path.join(folder, re.sub(r"\W", "-", key))
                os.makedirs(at)
                path = os.path.join(at, file)
                before = len(window.GetOutput() or "")
                writer = writer_of(made, port, path)
                try:
                    writer.UpdatePipeline()
                except RuntimeError:
                    pass
                files = os.listdir(at)
                again = read_again(simple, path) if os.path.exists(path) else None
                say("end", key, {"kind": [kind_of(data), extension], "written": bool(files),
                                 "size": size_of(data), "again": again,
                                 "said": (window.GetOutput() or "")[before:].strip()[:300]})
    say("all")
    os._exit(0)


def run_writers():
    """What happened to each output and file: None for the end of the program. And how that ended."""
    results, ends = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        while True:
            run = subprocess.run(
                [os.environ.get("RT_PVPYTHON", "pvpython"), os.path.abspath(__file__),
                 "--write", folder, json.dumps(sorted(results))],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
            lines = [json.loads(line) for line in run.stdout.decode().splitlines()
                     if line.startswith('["')]
            begun = None
            for kind, *rest in lines:
                if kind == "begin":
                    begun = rest[0]
                    results[begun] = None
                elif kind == "end":
                    results[rest[0]] = rest[1]
                elif kind == "all":
                    return results, ends
            if begun is None or results[begun] is not None:
                raise RuntimeError("the program that writes has ended without writing: %d"
                                   % run.returncode)
            ends[begun] = (run.returncode, run.stderr.decode(errors="replace")[-2000:])


class Writers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results, cls.ends = run_writers()

    def test_every_filter(self):
        written = {re.split(r"\W", key)[0] for key in self.results}
        filters = {re.sub(r"\W", "", proxy.label) for proxy in proxies()
                   if proxy.menu in ("filters", "sources")}
        self.assertEqual(written, filters)

    def test_nothing_ends_the_program(self):
        self.assertGreater(len(self.results), 200)
        self.assertEqual(self.ends, {})

    def finished(self):
        for key, result in self.results.items():
            if result is not None and result["kind"][0] != "nothing":
                yield key, tuple(result["kind"]), result

    def test_files(self):
        for key, kind, result in self.finished():
            with self.subTest(key):
                self.assertEqual(result["written"], kind not in NOT_WRITTEN, result)
                if kind in NOT_WRITTEN:
                    self.assertNotEqual(result["said"], "")

    def test_points(self):
        for key, kind, result in self.finished():
            if result["again"] is not None and kind not in NOT_COMPARED:
                with self.subTest(key):
                    self.assertEqual(result["again"], result["size"], result)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--write"]:
        write_all(sys.argv[2], json.loads(sys.argv[3]))
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Every output of every filter, by every writer that ParaView offers for it: none ends the program, files are
there, and what ParaView reads again has as many points. Writers run in another process, which is begun again
after what has ended it."""
import fnmatch
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from rt_proxies import proxies
from rt_testing import (closed_surface, density_image, disk_surface, load_plugin, main, points_in,
                        producer, size_of)

# What a writer of VTK does not take, and why: by "case.port.extension".
NOT_WRITTEN = {
}

# What is written but not compared: what of the points is in the file, and why.
NOT_COMPARED = {
}


def cases(simple):
    """Filters by name of the case, each with inputs and properties for a quick run."""
    def image(shape=(8, 6), cells=True, seed=0):
        return producer(simple, density_image(shape, cells, seed))

    def points(number=9):
        return producer(simple, points_in(density_image((8, 6)), number))

    volume = (4, 3, 2)
    return {
        "SampleDensity": lambda: simple.SampleDensity(Input=image(), NumberOfParticles=50),
        "SampleDensity paths": lambda: simple.SampleDensity(
            Input=image(volume), NumberOfParticles=5, OutputPaths=1, NumberOfSteps=4),
        "TransportMap": lambda: simple.TransportMap(Input=image()),
        "TransportMap points": lambda: simple.TransportMap(Input=image(volume, cells=False)),
        "EqualMassCells": lambda: simple.EqualMassCells(Input=points(), Resolution=16),
        "MorphDensities": lambda: simple.MorphDensities(Input=image(), Target=image(seed=2)),
        "DensityBarycenter": lambda: simple.DensityBarycenter(
            Input=[image(volume, False), image(volume, False, 2)], Weights=[1, 2]),
        "SplatMass": lambda: simple.SplatMass(Input=points(), Dimensions=[4, 5, 1]),
        "SolidDensity": lambda: simple.SolidDensity(
            Input=producer(simple, closed_surface()), Resolution=8),
        "UniformSeeds": lambda: simple.UniformSeeds(NumberOfPoints=40, Dimension=3),
        "RelaxBlueNoise": lambda: simple.RelaxBlueNoise(
            Input=points(), Density=image(), MaximumIterations=2),
        "AreaPreservingParameterization": lambda: simple.AreaPreservingParameterization(
            Input=producer(simple, disk_surface()), Resolution=32),
        "SampleSurface": lambda: simple.SampleSurface(
            Input=producer(simple, disk_surface()), NumberOfParticles=40, Resolution=32),
        "DensityEqualizingWarp": lambda: simple.DensityEqualizingWarp(
            Input=simple.Plane(Origin=[0, 0, 0], Point1=[3, 0, 0], Point2=[0, 9, 0], XResolution=3),
            Density=image()),
        "TransportQuality": lambda: simple.TransportQuality(Input=points(), Density=image()),
    }


def writer_of(simple, made, port, path):
    from paraview import servermanager
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    writer = servermanager._getPyProxy(factory.CreateWriter(path, made.SMProxy, port))
    if writer.GetProperty("DataMode"):  # not raw: see reads_appended_data
        writer.DataMode = "Binary"
    return writer


def extensions(simple, made, port):
    """The first extension of each writer that ParaView offers for an output."""
    from paraview import servermanager
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    factory.UpdateAvailableWriters()
    types = factory.GetSupportedFileTypes(made.SMProxy, port)
    return re.findall(r"\(\*\.(\w+)", types)


def read_again(simple, path):
    """The number of points, or rows, of what ParaView reads; None where it has no reader."""
    if path.endswith(".csv"):
        with open(path, encoding="utf-8") as file:
            return len(file.readlines()) - 1
    reader = simple.OpenDataFile(path)
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

    def say(*what):
        os.write(1, (json.dumps(what) + "\n").encode())

    for name, make in cases(simple).items():
        made = make()
        made.UpdatePipeline()
        algorithm = made.GetClientSideObject()
        for port in range(algorithm.GetNumberOfOutputPorts()):
            data = algorithm.GetOutputDataObject(port)
            for extension in extensions(simple, made, port):
                key = "%s.%d.%s" % (name, port, extension)
                if key in done:
                    continue
                say("begin", key)
                at = os.path.join(folder, key.replace(" ", "-"))
                os.makedirs(at)
                path = os.path.join(at, "file." + extension)
                before = len(window.GetOutput() or "")
                writer = writer_of(simple, made, port, path)
                try:
                    writer.UpdatePipeline()
                except RuntimeError:
                    pass
                files = os.listdir(at)
                again = read_again(simple, path) if os.path.exists(path) else None
                say("end", key, bool(files), size_of(data), again,
                    (window.GetOutput() or "")[before:].strip()[:300])
    say("all")
    os._exit(0)


def run_writers():
    """What happened to each output and extension: a list, or None for the end of the program."""
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        while True:
            run = subprocess.run(
                [os.environ.get("RT_PVPYTHON", "pvpython"), os.path.abspath(__file__),
                 "--write", folder, json.dumps(sorted(results))],
                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
            lines = [json.loads(line) for line in run.stdout.decode().splitlines()
                     if line.startswith("[")]
            begun = None
            for kind, *rest in lines:
                if kind == "begin":
                    begun = rest[0]
                    results[begun] = None
                elif kind == "end":
                    results[rest[0]] = rest[1:]
                elif kind == "all":
                    return results
            if begun is None or results[begun] is not None:
                raise RuntimeError("the program that writes has ended without writing: %d"
                                   % run.returncode)


def matches(key, patterns):
    return any(fnmatch.fnmatchcase(key, pattern) for pattern in patterns)


class Writers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = run_writers()

    def test_every_filter(self):
        written = {key.split(".")[0].split(" ")[0] for key in self.results}
        filters = {re.sub(r"\W", "", proxy.label) for proxy in proxies()
                   if proxy.menu in ("filters", "sources")}
        self.assertEqual(written, filters)

    def test_nothing_ends_the_program(self):
        self.assertEqual([key for key, result in self.results.items() if result is None], [])

    def test_files(self):
        for key, result in self.results.items():
            with self.subTest(key):
                self.assertEqual(bool(result and result[0]), not matches(key, NOT_WRITTEN), result)

    def test_points(self):
        for key, result in self.results.items():
            if result and result[0] and result[2] is not None and not matches(key, NOT_COMPARED):
                with self.subTest(key):
                    self.assertEqual(result[2], result[1], result)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--write"]:
        write_all(sys.argv[2], json.loads(sys.argv[3]))
    main()

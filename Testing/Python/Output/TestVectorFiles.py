# SPDX-License-Identifier: BSD-3-Clause
"""Save Data to SVG and PDF: what librsvg and poppler draw of the files is what the data are."""
import glob
import os
import re
import shutil
import subprocess
import tempfile
import unittest
import zlib
from xml.etree import ElementTree

import numpy as np
from PIL import Image
from rt_testing import OUTPUT, SOURCE, load_plugin, main, need_display, output_of, producer
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

simple = load_plugin()
SVG, INKSCAPE = "{http://www.w3.org/2000/svg}", "{http://www.inkscape.org/namespaces/inkscape}"
RESOLUTION = 254  # dots per inch: 10 pixels are a millimetre
DRAW = {
    "svg": ("rsvg-convert", "-d", str(RESOLUTION), "-p", str(RESOLUTION), "-b", "white", "-o"),
    "pdf": ("pdftocairo", "-png", "-singlefile", "-r", str(RESOLUTION)),
}
HAVE_READERS = all(shutil.which(command[0]) for command in DRAW.values())


def photograph(name="raccoon.png"):
    return simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data", name)])


def layers(text):
    """The dots of an SVG's layers by their labels, in the order of the file: rows of x and y."""
    found = {}
    for group in ElementTree.fromstring(text):
        if group.get(INKSCAPE + "groupmode") == "layer":
            found[group.get(INKSCAPE + "label")] = np.array(
                [[float(dot.get("cx")), float(dot.get("cy"))] for dot in group.iter(SVG + "circle")])
    return found


def length_of(dots):
    return np.linalg.norm(np.diff(dots, axis=0), axis=1).sum()


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


class VectorFiles(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        load_plugin()
        self.folder = tempfile.mkdtemp(dir=OUTPUT)
        self.addCleanup(shutil.rmtree, self.folder)

    def save(self, source, extension, **properties):
        path = os.path.join(self.folder, "drawing." + extension)
        simple.SaveData(path, proxy=source, **properties)
        self.assertEqual(os.listdir(self.folder), ["drawing." + extension])
        return path

    def drawn(self, source, extension, **properties):
        """The picture of a file, as rows from the top of RGB."""
        path = self.save(source, extension, **properties)
        picture = os.path.join(self.folder, "picture.png")
        command = DRAW[extension]
        if extension == "svg":
            subprocess.run([*command, picture, path], check=True)
        else:
            subprocess.run([*command, path, picture[:-4]], check=True)
        with Image.open(picture) as image:
            pixels = np.asarray(image.convert("RGB")).astype(float)
        os.remove(path)
        os.remove(picture)
        return pixels

    def text(self, source, **properties):
        with open(self.save(source, "svg", **properties), encoding="utf-8") as file:
            return file.read()

    @unittest.skipUnless(HAVE_READERS, "needs librsvg2-bin and poppler-utils")
    def test_photograph(self):
        """20,000 dots, black and in the photograph's colours: as much ink in each block as the dots have."""
        sampler = simple.SampleDensity(photograph(), NumberOfParticles=20000, InvertDensity=1)
        data = output_of(sampler)
        points = points_of(data)[:, :2]
        radius = 2.5
        low, high = points.min(axis=0) - radius, points.max(axis=0) + radius
        unit = 1200 / (high - low)[0]  # pixels: the page is 120 mm wide
        block = 40
        at = (unit * (points - low) / block).astype(int)
        size = np.ceil(unit * (high - low) / block).astype(int)
        area = np.zeros(size[::-1])
        np.add.at(area, (at[:, 1], at[:, 0]), np.pi * (unit * radius) ** 2)
        expected = area / block ** 2
        colours = vtk_to_numpy(data.GetPointData().GetArray("PNGImage")).astype(float)
        for extension in DRAW:
            with self.subTest(extension):
                black = self.drawn(sampler, extension, Width=120, PointRadius=radius)
                self.assertAlmostEqual(black.shape[1], 1200, delta=1)
                self.assertAlmostEqual(black.shape[0], unit * (high - low)[1], delta=1.5)
                ink = 1 - black[::-1].mean(axis=2) / 255  # rows from the bottom
                rows, columns = (n // block for n in ink.shape)
                blocks = ink[:rows * block, :columns * block].reshape(
                    rows, block, columns, block).mean(axis=(1, 3))
                expect = expected[:rows, :columns]
                apart = blocks - expect
                free = expect < 0.6  # where dots do not overlap much
                self.assertGreater(free.mean(), 0.4)
                self.assertLess(np.abs(apart[free].mean()), 0.02)
                self.assertLess(np.abs(apart[free]).mean(), 0.05)
                coloured = self.drawn(sampler, extension, Width=120, PointRadius=radius,
                                      ColorArray=["POINTS", "PNGImage"])
                centre = (unit * (points - low)).astype(int)
                found = coloured[np.clip(coloured.shape[0] - 1 - centre[:, 1], 0, None),
                                 centre[:, 0]]
                alike = np.abs(found - colours).max(axis=1) < 12
                self.assertGreater(alike.mean(), 0.9)  # of others a later dot covers the centre

    def test_order_of_plotters(self):
        """The raccoon in 20,000 dots on 100 mm: the same dots along at most 12.5 m."""
        sampler = simple.SampleDensity(photograph(), NumberOfParticles=20000, InvertDensity=1)
        found = {}
        for order in ("File", "Path"):
            text = self.text(sampler, PointRadius=2.5, Order=order)
            found[order] = np.array(re.findall(r'cx="([^"]*)" cy="([^"]*)"', text)).astype(float)
            self.assertEqual(found[order].shape, (20000, 2))
        self.assertEqual(*[sorted(map(tuple, dots)) for dots in found.values()])
        length = {order: length_of(dots) for order, dots in found.items()}
        self.assertGreater(length["File"], 21e3)
        self.assertLess(length["Path"], 12.5e3)

    def pens(self):
        """3,000 dots with an array Pen: 1 where the photograph is light, to 3."""
        dots = simple.SampleDensity(photograph(), NumberOfParticles=3000, InvertDensity=1)
        return simple.Calculator(dots, ResultArrayName="Pen", Function="3 - min(2, floor("
                                 "(PNGImage_X + PNGImage_Y + PNGImage_Z) / 180))")

    def test_layers(self):
        """One layer a value, in order, each with its dots along a short path of its own; none is lost."""
        pens = self.pens()
        of_pen = vtk_to_numpy(output_of(pens).GetPointData().GetArray("Pen"))
        options = {"PointRadius": 2.5, "PageMargin": 5, "PageBounds": [0, 1023, 0, 767, 0, 0],
                   "LayerArray": ["POINTS", "Pen"]}
        plain = layers(self.text(pens, **options))
        short = layers(self.text(pens, Order="Path", **options))
        self.assertEqual(list(plain), ["Pen 1", "Pen 2", "Pen 3"])
        self.assertEqual(list(short), list(plain))
        for number, (label, dots) in enumerate(plain.items(), start=1):
            self.assertEqual(len(dots), (of_pen == number).sum())
            self.assertEqual(sorted(map(tuple, dots)), sorted(map(tuple, short[label])))
            self.assertLess(length_of(short[label]), 0.8 * length_of(dots))
        self.assertEqual(layers(self.text(pens)), {})

    def test_layers_of_blocks(self):
        """Cell arrays; what lacks the array lies below, in no layer."""
        plane = simple.Calculator(simple.Plane(XResolution=2), AttributeType="Cell Data",
                                  ResultArrayName="Ink", Function="7")
        group = simple.GroupDatasets(Input=[plane, simple.Line()])
        root = ElementTree.fromstring(self.text(group, LayerArray=["CELLS", "Ink"]))
        self.assertEqual([group.get(INKSCAPE + "label") for group in root], [None, "Ink 7"])
        self.assertEqual([len(list(root[i].iter(SVG + name))) for i, name in
                          enumerate(("polyline", "polygon"))], [1, 2])

    @unittest.skipUnless(HAVE_READERS, "needs librsvg2-bin and poppler-utils")
    def test_layers_of_pdf(self):
        """Optional content with the same labels, and the same picture as without layers."""
        pens = self.pens()
        options = {"PointRadius": 2.5, "ColorArray": ["POINTS", "PNGImage"]}
        path = self.save(pens, "pdf", LayerArray=["POINTS", "Pen"], **options)
        with open(path, "rb") as file:
            data = file.read()
        os.remove(path)
        names = [bytes.fromhex(name.decode()).decode() for name in
                 re.findall(rb"/Type /OCG /Name <([0-9A-F]*)>", data)]
        self.assertEqual(names, ["Pen 1", "Pen 2", "Pen 3"])
        content = b"".join(zlib.decompress(stream) for stream in re.findall(
            rb"/Length \d+ >>\nstream\n(.*?)\nendstream", data, re.DOTALL)).decode()
        self.assertEqual(len(re.findall(r"^/OC /Layer\d+ BDC$", content, re.MULTILINE)), 3)
        self.assertEqual(len(re.findall("^EMC$", content, re.MULTILINE)), 3)
        for extension in DRAW:
            layered = self.drawn(pens, extension, LayerArray=["POINTS", "Pen"], **options)
            plain = self.drawn(pens, extension, **options)
            self.assertLess(np.abs(layered - plain).mean(), 2)  # where dots overlap

    def test_layers_refused(self):
        pens = self.pens()
        path = os.path.join(self.folder, "drawing.svg")
        for name in ("Missing", "SeedId", "Mass", "PNGImage"):
            with self.subTest(name):
                simple.SaveData(path, proxy=pens, LayerArray=["POINTS", name])
                self.assertFalse(os.path.exists(path))

    def test_line_width(self):
        """0, the default: a quarter of the median edge, from 0.05 to 0.25 mm; points have none."""
        for resolution, width in ((10, "0.25"), (200, "0.125"), (1000, "0.05")):
            plane = simple.Plane(XResolution=resolution, YResolution=3)
            lines = simple.Line(Resolution=resolution)
            found = re.findall('stroke-width="([^"]*)"', self.text(lines))
            self.assertEqual(found, [width])
            self.assertEqual(len(re.findall('stroke-width="', self.text(plane))), 1)
        self.assertIn('stroke-width="0.25"', self.text(plane, LineWidth=0.25))  # scripts of before
        self.assertNotIn("stroke-width", self.text(simple.UniformSeeds(NumberOfPoints=50)))

    @unittest.skipUnless(HAVE_READERS, "needs librsvg2-bin and poppler-utils")
    def test_polygons_and_lines(self):
        """The silhouette of a sphere from triangles in their colours; paths; an outline in millimetres."""
        sphere = simple.Elevation(simple.Sphere(ThetaResolution=32, PhiResolution=32),
                                  LowPoint=[-0.5, 0, 0], HighPoint=[0.5, 0, 0])
        for extension in DRAW:
            with self.subTest(extension):
                filled = self.drawn(sphere, extension, ColorArray=["POINTS", "Elevation"])
                self.assertAlmostEqual(filled.shape[1], 1000, delta=1)
                inside = (filled < 250).any(axis=2).mean()
                self.assertAlmostEqual(inside, np.pi / 4, delta=0.02)
                self.assertGreater(filled[500, 20, 0], 200)   # from red
                self.assertGreater(filled[500, -20, 2], 200)  # to blue
                outlined = self.drawn(sphere, extension, LineWidth=0.1)
                self.assertGreater(outlined.mean(), 150)
                box = self.drawn(simple.Plane(), extension, LineWidth=10)
                self.assertLess(np.abs(np.array(box.shape[:2]) - 1000).max(), 2)
                dark = (box < 128).all(axis=2)
                self.assertAlmostEqual(dark[500].sum(), 200, delta=4)  # twice 10 mm
                self.assertTrue(dark[500, :98].all() and not dark[500, 102:898].any())

    @unittest.skipUnless(HAVE_READERS, "needs librsvg2-bin and poppler-utils")
    def test_no_seams(self):
        """Polygons of one colour are one area: between them the paper does not shine through."""
        plane = simple.Plane(XResolution=40, YResolution=40)
        turned = simple.Transform(Input=simple.Triangulate(Input=plane))
        turned.Transform.Rotate = [0, 0, 10]
        one = simple.Calculator(Input=turned, AttributeType="Cell Data", Function="3")
        for extension in DRAW:
            with self.subTest(extension):
                drawn = self.drawn(one, extension, ColorArray=["CELLS", "Result"])
                self.assertEqual(len(np.unique(drawn[300:700, 300:700].reshape(-1, 3), axis=0)), 1)

    @unittest.skipUnless(HAVE_READERS, "needs librsvg2-bin and poppler-utils")
    def test_page_bounds(self):
        """Half of a square in a frame: a page of this size, its margin empty, the rest cut off."""
        plane = simple.PointDatatoCellData(simple.Elevation(simple.Plane()))
        for extension in DRAW:
            with self.subTest(extension):
                drawn = self.drawn(plane, extension, PageMargin=10, PageBounds=[0, 1, -1, 1, 0, 0],
                                   ColorArray=["CELLS", "Elevation"])
                self.assertLess(np.abs(np.array(drawn.shape[:2]) - [1800, 1000]).max(), 2)
                rows, columns = np.nonzero((drawn < 250).any(axis=2))
                found = [columns.min(), columns.max(), rows.min(), rows.max()]
                self.assertLess(np.abs(np.array(found) - [100, 500, 500, 1300]).max(), 4, found)

    def test_view(self):
        """At first a file is as the active view shows the data: colours, and the radius of plain circles."""
        sampler = simple.SampleDensity(photograph(), NumberOfParticles=500)
        self.assertNotIn('fill="#', self.text(sampler).split("stroke=\"none\">")[1])
        view = simple.CreateRenderView()
        shown = simple.Show(sampler, view, "GeometryRepresentation")
        shown.SetRepresentationType("Point Gaussian")
        shown.ShaderPreset = "Plain circle"
        shown.GaussianRadius = 8
        simple.ColorBy(shown, ("POINTS", "SeedId"))
        text = self.text(sampler)
        self.assertGreater(len(set(re.findall(r' fill="#(\w{6})"/', text))), 100)
        size = float(re.search(r'width="100mm".* r="([\d.]+)"', text, re.DOTALL)[1])
        bounds = output_of(sampler).GetBounds()
        self.assertAlmostEqual(size, 8 * 100 / (bounds[1] - bounds[0] + 16), places=3)
        self.assertIn(' r="50"', self.text(sampler, PointRadius=1e9))  # what is given holds
        simple.Hide(sampler, view)
        self.assertNotIn('fill="#', self.text(sampler).split("stroke=\"none\">")[1])

    def test_blocks(self):
        """One page for what is grouped: outlines, and the sites on top."""
        seeds = simple.UniformSeeds(NumberOfPoints=12)
        cells = simple.EqualMassCells(seeds, Resolution=64)
        cells.UpdatePipeline()
        group = simple.GroupDatasets(Input=[simple.OutputPort(cells, 2), seeds])
        text = self.text(group)
        self.assertEqual(text.count("<circle"), 12)
        self.assertGreater(text.count("<poly"), 12)
        self.assertLess(text.rfind("<poly"), text.find("<circle"))

    def test_series(self):
        """A file for each time."""
        reader = photograph("ascent.png")
        small = simple.ExtractSubset(reader, VOI=[0, 31, 0, 31, 0, 0])
        other = simple.ExtractSubset(reader, VOI=[100, 131, 0, 31, 0, 0])
        morph = simple.MorphDensities(Input=small, Target=other, PublishTime=1, NumberOfTimeSteps=3)
        morph.UpdatePipeline()
        for extension in DRAW:
            path = os.path.join(self.folder, "step." + extension)
            simple.SaveData(path, proxy=simple.OutputPort(morph, 1), Writetimestepsasfileseries=1)
            files = sorted(glob.glob(os.path.join(self.folder, "step_*." + extension)))
            self.assertEqual([os.path.basename(file) for file in files],
                             ["step_%d.%s" % (i, extension) for i in range(3)])
            contents = set()
            for file in files:
                with open(file, "rb") as opened:
                    contents.add(opened.read())
            self.assertEqual(len(contents), 3)

    def test_nothing_to_draw(self):
        """No file of nothing, and no earlier one lost."""
        path = os.path.join(self.folder, "drawing.svg")
        with open(path, "w", encoding="utf-8") as file:
            file.write("earlier")
        simple.SaveData(path, proxy=producer(simple, vtkPolyData()))
        with open(path, encoding="utf-8") as file:
            self.assertEqual(file.read(), "earlier")


if __name__ == "__main__":
    need_display()
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Closed lines as the areas within them: the types Filled Outlines of a view, the first display of a
cartogram, and FillOutlines of SVG and PDF."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
from PIL import Image
from rt_testing import OUTPUT, SOURCE, load_plugin, main, need_display, producer
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

simple = load_plugin()
FILLED, EDGED = "Filled Outlines", "Filled Outlines With Edges"
SIDE = 200  # pixels of a picture, which shows the square from 0 to 10
RED, GREEN, BLUE, WHITE, BLACK = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255), (0, 0, 0)
GREY = (128, 128, 128)  # of edges


def square(low, high, turned=False):
    corners = [(low, low), (high, low), (high, high), (low, high), (low, low)]
    return corners[::-1] if turned else corners


# A region with a hole, in which is a second one with a lake, with an island of the first one; a part of
# the second apart from them; a line that does not close. Rings turn in any direction.
OUTER, HOLE, LAKE, ISLAND = square(1, 8), square(2, 7), square(3.8, 5.2), square(4.2, 4.8)
APART = [(8.5, 8.5), (9.5, 8.5), (9.5, 9.5), (8.5, 8.5)]
OPEN = [(0.2, 9), (3, 9)]
LINES = [(OUTER, 0), (HOLE, 0), (square(3, 6, True), 1), (LAKE, 1), (ISLAND, 0), (APART, 1), (OPEN, 2)]
# What there is at places of the square.
WITHIN = {(1.5, 5): RED, (7.5, 7.5): RED, (2.5, 5): WHITE, (3.5, 5): GREEN, (5.5, 5.5): GREEN, (4.5, 4.5): RED,
          (4, 4.5): WHITE, (9.2, 8.8): GREEN, (8.7, 9.3): WHITE, (0.5, 0.5): WHITE}


def outlines(lines=LINES, polygons=False):
    """With a colour (Colours) and a number (Region) a cell."""
    data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for corners, _ in lines:
        count = len(corners) - (1 if polygons else 0)
        cells.InsertNextCell(count)
        for corner in corners[:count]:
            cells.InsertCellPoint(points.InsertNextPoint(*corner, 0))
    data.SetPoints(points)
    data.SetPolys(cells) if polygons else data.SetLines(cells)
    regions = np.array([region for _, region in lines])
    for name, values in (("Region", regions), ("Colours", np.array([RED, GREEN, BLUE], "u1")[regions])):
        array = numpy_to_vtk(values, deep=1)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


def at(pixels, place):
    """The colour of the pixel at a place of the square."""
    scale = pixels.shape[0] / 10
    return tuple(pixels[pixels.shape[0] - 1 - int(place[1] * scale), int(place[0] * scale)])


def is_near(found, colour):
    return np.abs(np.array(found, float) - colour).max() < 40


class Places(unittest.TestCase):
    def assert_colours(self, pixels, places):
        for place, colour in places.items():
            self.assertTrue(is_near(at(pixels, place), colour),
                            "%s is %s, not %s" % (place, at(pixels, place), colour))

    def assert_line(self, pixels, first, last, colour):
        """A line through these two places is there in a colour, within a pixel."""
        shift = 10 / pixels.shape[0]
        for part in np.linspace(0.05, 0.95, 7):
            place = np.array(first) + part * (np.array(last) - first)
            near = [at(pixels, place + np.array(d)) for d in
                    ((0, 0), (shift, 0), (-shift, 0), (0, shift), (0, -shift))]
            self.assertTrue(any(is_near(found, colour) for found in near), "%s: %s" % (place, near))


class InAView(Places):
    def setUp(self):
        simple.ResetSession()
        load_plugin()
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [SIDE, SIDE]
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.view.OrientationAxesVisibility = 0

    def show(self, source, kind):
        shown = simple.Show(source, self.view)
        shown.Representation = kind
        simple.ColorBy(shown, ("CELLS", "Colours"))
        shown.MapScalars = 0
        shown.Ambient, shown.Diffuse = 1, 0
        shown.EdgeColor = [0.5, 0.5, 0.5]
        shown.LineWidth = 3
        return shown

    def pixels(self):
        self.view.CameraParallelProjection = 1
        self.view.CameraFocalPoint, self.view.CameraPosition = [5, 5, 0], [5, 5, 10]
        self.view.CameraViewUp = [0, 1, 0]
        self.view.CameraParallelScale = 5
        path = os.path.join(OUTPUT, "filled-outlines.png")
        simple.SaveScreenshot(path, self.view, ImageResolution=[SIDE, SIDE])
        with Image.open(path) as image:
            return np.asarray(image.convert("RGB"))

    def test_regions_are_filled(self):
        """Between their outlines, holes left out; lines that do not close stay lines."""
        for kind in (FILLED, EDGED):
            with self.subTest(kind):
                self.show(producer(simple, outlines()), kind)
                pixels = self.pixels()
                self.assert_colours(pixels, WITHIN)
                self.assert_line(pixels, OPEN[0], OPEN[1], BLUE if kind == FILLED else GREY)
                edge = GREY if kind == EDGED else RED
                self.assert_line(pixels, OUTER[0], OUTER[1], edge)
                self.assert_line(pixels, HOLE[2], HOLE[3], edge)

    def test_edges_follow_the_panel(self):
        """Their colour, the visibility and the place of the surface; Surface has no areas."""
        shown = self.show(producer(simple, outlines()), EDGED)
        shown.EdgeColor = [0, 0, 1]
        self.assert_line(self.pixels(), OUTER[0], OUTER[1], BLUE)
        # Called Position before ParaView 5.13.
        place = "Translation" if "Translation" in shown.ListProperties() else "Position"
        setattr(shown, place, [0, 0.5, 0])
        pixels = self.pixels()
        self.assert_line(pixels, (1, 1.5), (8, 1.5), BLUE)
        self.assert_colours(pixels, {(4.5, 1.75): RED, (4.5, 1.25): WHITE})
        setattr(shown, place, [0, 0, 0])
        shown.Visibility = 0
        self.assertTrue((self.pixels() == 255).all())
        shown.Visibility = 1
        shown.Representation = "Surface"
        self.assert_colours(self.pixels(), {(1.5, 5): WHITE})
        shown.Representation = EDGED
        self.assert_colours(self.pixels(), {(1.5, 5): RED})
        simple.Delete(simple.GetActiveSource())
        self.assertTrue((self.pixels() == 255).all())

    def test_polygons(self):
        """Are as in Surface; their edges are around them."""
        both = [(square(1, 4), 0), (square(5, 9), 1)]
        self.show(producer(simple, outlines(both, polygons=True)), EDGED)
        pixels = self.pixels()
        self.assert_colours(pixels, {(2, 3): RED, (8, 6): GREEN, (4.5, 4.5): WHITE, (2.5, 2.5): RED})
        self.assert_line(pixels, (1, 1), (4, 1), GREY)
        self.assert_line(pixels, (5, 9), (9, 9), GREY)

    def test_a_map_of_blocks(self):
        """GDAL Vector Reader gives a block a feature."""
        def feature(rings, region):
            return {"type": "Feature", "properties": {"region": region},
                    "geometry": {"type": "Polygon", "coordinates": rings}}

        features = [feature([square(1, 8), square(2, 7, True)], 1), feature([square(3, 6)], 2)]
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            path = os.path.join(folder, "map.geojson")
            with open(path, "w", encoding="utf-8") as file:
                json.dump({"type": "FeatureCollection", "features": features}, file)
            reader = simple.GDALVectorReader(FileName=path)
            shown = simple.Show(reader, self.view)
            shown.Representation = EDGED
            shown.ColorArrayName = [None, ""]
            shown.DiffuseColor = shown.AmbientColor = [1, 0, 0]
            shown.Ambient, shown.Diffuse = 1, 0
            self.assert_colours(self.pixels(), {(1.5, 5): RED, (2.5, 5): WHITE, (5, 4.5): RED})

    def test_states(self):
        mapped = self.states()
        self.assertEqual(simple.Show(mapped, self.view).Representation, EDGED)
        before = self.pixels()
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            simple.ResetSession()
            simple.LoadState(path)
        self.view = simple.GetViews()[0]
        shown = simple.GetRepresentation(simple.FindSource("People"), self.view)
        self.assertEqual(shown.Representation, EDGED)
        self.assertTrue((self.pixels() == before).all())

    @staticmethod
    def states(**properties):
        path = os.path.join(SOURCE, "Testing", "Data", "us-states.geojson")
        mapped = simple.Cartogram(simple.GDALVectorReader(FileName=path), registrationName="People",
                                  MassArray=["CELLS", "mass"], Resolution=256, Tolerance=0.05, **properties)
        mapped.UpdatePipeline()
        return mapped

    def test_cartogram_at_first(self):
        """Regions in the colours of their mass by their area, on a logarithmic scale where that spans
        more than a factor of ten, and a light graticule."""
        shown = simple.Show(self.states(), self.view)
        self.assertEqual(shown.Representation, EDGED)
        self.assertEqual(list(shown.ColorArrayName), ["CELLS", "MassPerArea"])
        table = simple.GetColorTransferFunction("MassPerArea")
        self.assertEqual(table.UseLogScale, 1)
        self.assertAlmostEqual(table.RGBPoints[0], 2.26, delta=0.1)
        self.assertAlmostEqual(table.RGBPoints[-4], 4000, delta=100)
        graticule = simple.Show(simple.OutputPort(simple.GetActiveSource(), 1), self.view)
        self.assertEqual(graticule.ColorArrayName[1], "")
        self.assertGreater(min(graticule.AmbientColor), 0.6)

    def test_linear_colours(self):
        """Of densities that differ little."""
        both = [(square(1, 5), 1), ([(5, 1), (9, 1), (9, 5), (5, 5), (5, 1)], 2)]
        mapped = simple.Cartogram(producer(simple, outlines(both)), MassArray=["CELLS", "Region"])
        shown = simple.Show(mapped, self.view)
        self.assertEqual(list(shown.ColorArrayName), ["CELLS", "MassPerArea"])
        table = simple.GetColorTransferFunction("MassPerArea")
        self.assertEqual(table.UseLogScale, 0)
        np.testing.assert_allclose([table.RGBPoints[0], table.RGBPoints[-4]], [1 / 16, 2 / 16])


@unittest.skipUnless(shutil.which("rsvg-convert") and shutil.which("pdftocairo"),
                     "needs librsvg2-bin and poppler-utils")
class OnAPage(Places):
    PAGE = dict(Width=20, PageBounds=[0, 10, 0, 10, 0, 0], LineWidth=0.2)

    def setUp(self):
        simple.ResetSession()
        load_plugin()

    def drawn(self, extension, **properties):
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            path, picture = (os.path.join(folder, "map." + end) for end in (extension, "png"))
            simple.SaveData(path, **{**self.PAGE, **properties})
            if extension == "svg":
                subprocess.run(["rsvg-convert", "-b", "white", "-w", str(SIDE), "-o", picture, path], check=True)
            else:
                subprocess.run(["pdftocairo", "-png", "-singlefile", "-scale-to", str(SIDE), path, picture[:-4]],
                               check=True)
            with Image.open(picture) as image:
                return np.asarray(image.convert("RGB"))

    def test_regions_are_filled(self):
        """In the colours of cells, with black outlines; without FillOutlines or colours there are lines."""
        source = producer(simple, outlines())
        for extension in ("svg", "pdf"):
            with self.subTest(extension):
                colours = dict(proxy=source, ColorArray=["CELLS", "Colours"])
                pixels = self.drawn(extension, FillOutlines=1, **colours)
                self.assert_colours(pixels, WITHIN)
                self.assert_line(pixels, OUTER[0], OUTER[1], BLACK)
                self.assert_line(pixels, OPEN[0], OPEN[1], BLUE)
                pixels = self.drawn(extension, FillOutlines=0, **colours)
                self.assert_colours(pixels, {(1.5, 5): WHITE, (3.5, 5): WHITE})
                self.assert_line(pixels, OUTER[0], OUTER[1], RED)
                pixels = self.drawn(extension, FillOutlines=1, proxy=source, ColorArray=["CELLS", ""])
                self.assert_colours(pixels, {(1.5, 5): WHITE})
                self.assert_line(pixels, OUTER[0], OUTER[1], BLACK)

    def test_as_in_the_view(self):
        """Save Data fills what the active view fills."""
        view = simple.CreateView("RenderView")
        source = producer(simple, outlines())
        shown = simple.Show(source, view)
        simple.ColorBy(shown, ("CELLS", "Colours"))
        for kind, colour in ((EDGED, RED), (FILLED, RED), ("Surface", WHITE)):
            with self.subTest(kind):
                shown.Representation = kind
                simple.Render(view)
                self.assert_colours(self.drawn("svg", proxy=source), {(1.5, 5): colour})


if __name__ == "__main__":
    need_display()
    main()

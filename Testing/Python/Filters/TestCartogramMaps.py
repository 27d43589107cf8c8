# SPDX-License-Identifier: BSD-3-Clause
"""Maps as other filters and files leave them: grids of polygons, rivers, outlines that cross, degrees, regions
on each other."""
import json
import os
import re
import unittest

import numpy as np
from rt_testing import OUTPUT, SOURCE, Listener, load_plugin, main, positions, producer
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (VTK_EMPTY_CELL, VTK_PIXEL, VTK_POLY_LINE, VTK_POLY_VERTEX,
                                           VTK_POLYGON, VTK_QUAD, VTK_TETRA, VTK_QUADRATIC_EDGE, VTK_VERTEX,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter

simple = load_plugin()
from rt_maps import (blocks_of, cartogram, cell_values, line_of, map_of, rectangle, ring_areas,  # noqa: E402
                     sixteen, square)

EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]


def grid_of(*data):
    append = vtkAppendFilter()
    for part in data:
        append.AddInputData(part)
    append.Update()
    return append.GetOutput()


def grid(places, cells, mass):
    """An unstructured grid of (type, point ids)."""
    made = vtkUnstructuredGrid()
    made.SetPoints(map_of([places]).GetPoints())
    made.Allocate(len(cells))
    for kind, ids in cells:
        made.InsertNextCell(kind, len(ids), ids)
    made.GetCellData().AddArray(map_of([square(0, 1)] * len(cells), mass).GetCellData().GetArray("Mass"))
    return made


def ran(proxy):
    """A filter of ParaView after it ran, and what it said."""
    algorithm = proxy.GetClientSideObject()
    listener = Listener(algorithm)
    proxy.UpdatePipeline()
    return algorithm, listener


class TestCartogramMaps(unittest.TestCase):
    def check_silent(self, listener):
        self.assertEqual(listener.errors + listener.warnings, [])

    def check_shares(self, areas, masses, tolerance=0.01):
        areas, masses = abs(np.array(areas)), np.array(masses, float)
        np.testing.assert_allclose(areas / areas.sum(), masses / masses.sum(), rtol=tolerance)

    def test_grids_of_regions(self):
        """Polygons and closed lines of an unstructured grid give the bits of those of a vtkPolyData."""
        for lines in (False, True):
            data = sixteen(lines=lines)
            expected = cartogram(data)[0].GetRegions()
            for other in (grid_of(data), blocks_of(grid_of(data))):
                algorithm, listener = cartogram(other)
                self.check_silent(listener)
                regions = algorithm.GetRegions()
                self.assertTrue(regions.IsA("vtkPolyData"))
                np.testing.assert_array_equal(positions(regions), positions(expected))
                np.testing.assert_array_equal(ring_areas(regions), ring_areas(expected))
                np.testing.assert_array_equal(cell_values(regions, "Mass"), cell_values(data, "Mass"))

    def test_what_filters_leave(self):
        masses = cell_values(sixteen(), "Mass")
        data = producer(simple, sixteen())
        thin = np.setdiff1d(np.arange(16), [5])
        for made, right in (
                (simple.Threshold(Input=data, Scalars=["CELLS", "Mass"], LowerThreshold=0, UpperThreshold=2), thin),
                (simple.AppendDatasets(Input=[data]), np.arange(16)),
                (simple.MergeBlocks(Input=producer(simple, blocks_of(sixteen()))), np.arange(16)),
                (simple.Connectivity(Input=simple.AppendDatasets(Input=[data])), np.arange(16))):
            algorithm, listener = ran(simple.Cartogram(Input=made, MassArray=["CELLS", "Mass"], Resolution=128))
            self.check_silent(listener)
            self.check_shares(ring_areas(algorithm.GetRegions()), masses[right])

    def test_cells_of_a_grid(self):
        """Vertices, lines, polygons, with the data of each; messages have the numbers of the grid."""
        places = [(0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (2, 1), (2, 2), (1, 2), (5, 5)]
        cells = [(VTK_QUAD, [0, 1, 2, 3]), (VTK_VERTEX, [8]), (VTK_PIXEL, [1, 4, 2, 5]),
                 (VTK_POLY_LINE, [2, 5, 6, 7, 2]), (VTK_EMPTY_CELL, []), (VTK_POLY_VERTEX, [0, 8]),
                 (VTK_POLYGON, [3, 2, 7])]
        masses = [1.0, np.nan, 2.0, 3.0, np.nan, np.nan, 1.5]
        algorithm, listener = cartogram(grid(places, cells, masses))
        self.check_silent(listener)
        regions = algorithm.GetRegions()
        self.assertEqual([regions.GetNumberOfVerts(), regions.GetNumberOfLines(), regions.GetNumberOfPolys()],
                         [3, 1, 3])
        np.testing.assert_array_equal(cell_values(regions, "Mass")[3:], [3, 1, 2, 1.5])
        self.check_shares(ring_areas(regions), [3, 1, 2, 1.5])
        np.testing.assert_array_equal(cell_values(regions, "TargetArea")[:3], 0)
        for kind, ids, text in (
                (VTK_POLYGON, [3, 2, 7],
                 "The mass of the region of cell 6 in 'Mass' is nan; masses must be at least 0 and finite"),
                (VTK_TETRA, [0, 1, 2, 3],
                 "Cell 6 of the input is a vtkTetra; regions must be polygons or closed lines, as Slice makes of "
                 "cells of a volume"),
                (VTK_QUADRATIC_EDGE, [0, 1, 2],
                 "Cell 6 of the input is a vtkQuadraticEdge; regions must be polygons or closed lines, as Generate "
                 "Ids, for the RegionArray, and then Extract Surface make of it")):
            _, listener = cartogram(grid(places, cells[:-1] + [(kind, ids)], masses[:-1] + [np.nan]))
            self.assertEqual([line_of(error) for error in listener.errors if "returned failure" not in error],
                             [text])

    def test_rivers(self):
        """Open lines move as an overlay, and nothing else does otherwise; a warning names the first."""
        course = [(0.0, 0.0), (1.0, 0.0), (1.5, 1.5), (3.2, 3.9)]
        river = map_of([course], [np.nan], lines="open")
        alone, _ = cartogram(sixteen(), map_of([course]))
        algorithm, listener = cartogram(grid_of(sixteen(), river))
        self.assertEqual([line_of(warning) for warning in listener.warnings],
                         ["1 of 1 lines of the input do not close (the first is cell 16); they move along and have "
                          "no share of the area, as the outline of a region ends at the point where it begins"])
        self.assertEqual(listener.errors, [])
        regions = algorithm.GetRegions()
        self.assertEqual([regions.GetNumberOfLines(), regions.GetNumberOfPolys()], [1, 16])
        np.testing.assert_array_equal(ring_areas(regions)[1:], ring_areas(alone.GetRegions()))
        self.assertEqual(cell_values(regions, "TargetArea")[0], 0)
        places = positions(regions)[vtk_to_numpy(regions.GetLines().GetConnectivityArray())]
        moved = positions(alone.GetOverlay())
        for corner in moved:
            self.assertLess(abs(places - corner).sum(axis=1).min(), 1e-9)
        np.testing.assert_allclose(places[[0, -1]], moved[[0, -1]], atol=1e-9)
        # Its long edges are divided, and where it runs along a border it stays on it.
        self.assertGreater(len(places), 100)
        border = {tuple(x) for x in positions(regions)[vtk_to_numpy(regions.GetPolys().GetConnectivityArray())]}
        self.assertTrue({tuple(x) for x in places[:15]} <= border)

    def test_names_of_rivers(self):
        """By the number in the block and the block, however few points they have."""
        closed = map_of([square(0, 4)], [1.0], lines=True)
        for line in ([(0, 0), (9, 9)], [(1, 1)], [(0, 0), (1, 1), (0, 0)]):
            both = grid_of(map_of([square(5, 9)], [2.0]))
            both = blocks_of(closed, both, map_of([line, line], [7.0, 7.0], lines="open"))
            algorithm, listener = cartogram(both)
            self.assertEqual(listener.errors, [])
            self.assertRegex(listener.warnings[0],
                             r"2 of 3 lines of the input do not close \(the first is cell 0 of block 3 of the input\)")
            self.check_shares(ring_areas(algorithm.GetRegions())[[0, 3]], [1.0, 2.0])
        empty = map_of([square(0, 4)], [1.0], lines=True)
        empty.GetLines().InsertNextCell(0)
        empty.GetCellData().GetArray("Mass").InsertNextValue(1.0)
        algorithm, listener = cartogram(empty)
        self.assertEqual(listener.errors, [])
        self.assertIn("1 of 2 lines of the input do not close (the first is cell 1)", listener.warnings[0])
        self.assertEqual(algorithm.GetRegions().GetLines().GetCellSize(1), 0)

    def test_figures_of_eight(self):
        """Their areas are those of the even-odd rule, before and after."""
        beside = rectangle(3, 0, 5, 2)
        for lines in (False, True):
            data = map_of([EIGHT, beside], [3.0, 2.0], lines=lines)
            algorithm, listener = cartogram(data)
            self.check_silent(listener)
            regions = algorithm.GetRegions()
            np.testing.assert_allclose(cell_values(regions, "MassPerArea"), [3 / 2, 2 / 4], rtol=1e-12)
            np.testing.assert_allclose(cell_values(regions, "TargetArea"), [3.6, 2.4], rtol=1e-12)
            ids = vtk_to_numpy((regions.GetLines() if lines else regions.GetPolys()).GetConnectivityArray())
            # The two loops meet in a point, where both edges are divided.
            outline = positions(regions)[ids[:regions.GetCell(0).GetNumberOfPoints()]]
            loops = [i for i, x in enumerate(outline) for y in outline[i + 2:] if abs(x - y).max() < 1e-9]
            crossing = outline[loops[-1]] if not lines else outline[loops[1]]
            at = [i for i, x in enumerate(outline) if abs(x - crossing).max() < 1e-9]
            self.assertEqual(len(at), 2)
            inner, outer = outline[at[0]:at[1]], np.r_[outline[at[1]:], outline[:at[0]]]
            total = sum(abs(self.area(loop)) for loop in (inner, outer))
            self.assertAlmostEqual(total / abs(ring_areas(regions)[1]), 1.5, delta=0.03)
        # With a square that another one of its region overlaps, and an island.
        rings = [square(0, 4), rectangle(3, 1, 6, 2), square(8, 9), square(10, 12)]
        algorithm, listener = cartogram(map_of(rings, [5.0, 5.0, 5.0, 3.0], name=["a", "a", "a", "b"]),
                                        regions="name")
        self.check_silent(listener)
        np.testing.assert_allclose(cell_values(algorithm.GetRegions(), "MassPerArea"), [5 / 18] * 3 + [3 / 4],
                                   rtol=1e-12)

    @staticmethod
    def area(loop):
        x, y, _ = (loop - loop[0]).T
        return 0.5 * (np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))

    def test_target_areas(self):
        """They are the areas that regions get, whatever the sea is."""
        rings = [rectangle(i, 0, i + 1, 1) for i in range(3)] + [rectangle(4, 2, 5, 4)]
        for cells, value in ((1, 0), (2, 0), (3, 0.5), (3, 50.0), (3, 0.0), (0, 0)):
            for masses in ([1.0, 2.0, 3.0, 1.0], [1.0, 20.0, 300.0, 40.0]):
                algorithm, listener = cartogram(map_of(rings, masses), EmptyCells=cells, EmptyValue=value,
                                                Resolution=256)
                self.check_silent(listener)
                regions = algorithm.GetRegions()
                np.testing.assert_allclose(ring_areas(regions) / cell_values(regions, "TargetArea"), 1, atol=0.02)
                if cells == 0:
                    self.assertAlmostEqual(cell_values(regions, "TargetArea").sum(), 36, delta=1e-4)

    def test_degrees(self):
        """Longitudes and latitudes to an equal-area projection, all outputs in it."""
        low, high = (45.0, 51.0, 57.0), (46.0, 53.0, 63.0)
        rings = [rectangle(x, y0, x + 2, y1) for y0, y1 in zip(low, high) for x in (3.0, 5.0)]
        masses = np.arange(1.0, 7)
        cities = map_of([[(4.0, 45.5), (7.0, 63.0)]])
        algorithm, listener = cartogram(map_of(rings, masses), cities, ProjectionToEqualArea=None)
        self.check_silent(listener)
        ground = np.repeat(6371.0 ** 2 * np.radians(2) * (np.sin(np.radians(high)) - np.sin(np.radians(low))), 2)
        regions = algorithm.GetRegions()
        np.testing.assert_allclose(cell_values(regions, "MassPerArea"), masses / ground, rtol=1e-9)
        self.check_shares(ring_areas(regions), masses)
        self.assertAlmostEqual(ring_areas(regions).sum() / ground.sum(), 1, delta=0.01)
        # Without a change of areas: at the mean latitude, in kilometres.
        algorithm, _ = cartogram(map_of(rings, ground), cities, ProjectionToEqualArea=None, Blend=0.0)
        cosine = np.cos(np.radians(54))
        x = 6371.0 * cosine * np.radians([4.0, 7.0])
        y = 6371.0 / cosine * np.sin(np.radians([45.5, 63.0]))
        np.testing.assert_allclose(positions(algorithm.GetOverlay()), np.c_[x, y, [0, 0]], rtol=1e-12)
        np.testing.assert_allclose(positions(algorithm.GetRegions())[:, 1].max(), y[1], rtol=1e-12)
        self.assertGreater(positions(algorithm.GetGraticule())[:, 1].max(), y[1])
        for data, overlay, text in (
                (map_of([square(0, 91)], [1.0]), None,
                 "Projection is EqualArea, and point 2 of the input is at (91, 91); points must be longitudes from "
                 "-360 to 360 and latitudes from -90 to 90, in degrees"),
                (map_of(rings, masses), map_of([[(4.0, 45.5), (5e5, 6e5)]]),
                 "Projection is EqualArea, and point 1 of the Overlay is at (500000, 600000); points must be "
                 "longitudes from -360 to 360 and latitudes from -90 to 90, in degrees")):
            _, listener = cartogram(data, overlay, Projection=1)
            self.assertEqual([line_of(error) for error in listener.errors if "returned failure" not in error],
                             [text])
        _, listener = cartogram(sixteen(), Projection=2)
        self.assertIn("Projection is 2; it must be 0 (None) or 1 (EqualArea)", listener.errors[0])

    def test_what_looks_like_degrees(self):
        """A map that is wide, or far from the equator on one side, and on the earth."""
        for bounds, does_look in (((0, 0, 4, 4), False), ((0, 0, 19, 19), False), ((5, 6, 9, 21), False),
                                  ((-5, -5, 16, 14), True), ((-9, 36, 3, 44), True), ((166, -47, 178, -34), True),
                                  ((0, 0, 181, 10), False), ((0, 80, 4, 91), False), ((30, 0, 34, 4), False)):
            _, listener = cartogram(map_of([rectangle(*bounds)], [1.0]), Resolution=16)
            self.assertEqual(listener.errors, [])
            self.assertEqual(["look like degrees" in warning for warning in listener.warnings],
                             [True] * does_look, bounds)

    @unittest.skipUnless(hasattr(simple, "GDALVectorReader"), "this ParaView has no GDAL Vector Reader")
    def test_map_in_degrees(self):
        """The page's recipe gives a map of a reader the areas of the sphere, and no warning is left; so does
        the projection."""
        with open(os.path.join(SOURCE, "Documentation", "Cartogram.md"), encoding="utf-8") as file:
            recipe = file.read().split("## A map in degrees")[1]
        expression = re.search(r"```\n(.*coordsX.*)\n```", recipe)[1]
        self.assertIn("Attribute Type** Point Data", recipe)
        rows = [(0, 30), (30, 60)]
        features = [{"type": "Feature", "properties": {"people": 1 + i}, "geometry": {
            "type": "Polygon", "coordinates": [[[x, y] for x, y in (
                (0, low), (40, low), (40, high), (0, high), (0, low))]]}} for i, (low, high) in enumerate(rows)]
        path = os.path.join(OUTPUT, "degrees.geojson")
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "features": features}, file)
        sines = np.sin(np.radians(rows))
        areas = 6371 ** 2 * np.radians(40) * (sines[:, 1] - sines[:, 0])
        reader = simple.GDALVectorReader(FileName=path)
        reader.UpdatePipeline()
        calculator = simple.Calculator(reader, CoordinateResults=1, Function=expression)
        calculator.AttributeType = "Point Data"
        for source, projection, tolerance in ((calculator, "None", 1e-5), (reader, "EqualArea", 1e-12)):
            algorithm, listener = ran(simple.Cartogram(source, MassArray=["CELLS", "people"],
                                                       Projection=projection))
            self.check_silent(listener)
            np.testing.assert_allclose(cell_values(algorithm.GetRegions(), "MassPerArea"), [1, 2] / areas,
                                       rtol=tolerance)

    def test_regions_on_each_other(self):
        """Few passes; what the warnings advise brings every area within Tolerance."""
        rings = [rectangle(0, 0, 2, 2), rectangle(2, 0, 4, 2), rectangle(0, 0, 2, 2)]
        data = map_of(rings, [1.0, 1.0, 4.0], name=["a", "b", "c"])
        algorithm, listener = cartogram(data)
        self.assertEqual(len(listener.warnings), 2, listener.warnings)
        self.assertIn("Regions overlap by 33 % of their area (most at the region 'a')", listener.warnings[0])
        self.assertIn("; regions on each other cannot all have their areas: leave one of them in each place, with "
                      "Threshold", listener.warnings[1])
        regions = algorithm.GetRegions()
        self.assertLessEqual(regions.GetFieldData().GetArray("AreaErrors").GetNumberOfTuples(), 3)
        areas = ring_areas(regions)
        self.assertAlmostEqual(areas[0], areas[2], delta=1e-12)
        self.assertAlmostEqual(areas[:2].sum(), 8, delta=0.1)  # land keeps its area
        left = simple.Threshold(Input=producer(simple, data), Scalars=["CELLS", "Mass"], LowerThreshold=0,
                                UpperThreshold=2)
        algorithm, listener = ran(simple.Cartogram(Input=left, MassArray=["CELLS", "Mass"], Resolution=128))
        self.check_silent(listener)
        self.check_shares(ring_areas(algorithm.GetRegions()), [1.0, 1.0])
        # A region that a map has twice: its areas are right.
        twice = sixteen()
        rings = [rectangle(x, y, x + 1, y + 1) for y in range(4) for x in range(4)]
        twice = map_of(rings + rings[5:6], [*cell_values(twice, "Mass"), 20.0])
        algorithm, listener = cartogram(twice)
        self.assertEqual(len(listener.warnings), 1, listener.warnings)
        self.check_shares(ring_areas(algorithm.GetRegions()), cell_values(twice, "Mass"))


main()

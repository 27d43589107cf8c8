# SPDX-License-Identifier: BSD-3-Clause
"""Cartograms: areas of regions from polygons, closed lines and map files; what moves along; bad input."""
import os
import unittest

import numpy as np
from rt_testing import SOURCE, Listener, load_plugin, main, positions, producer
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_ID_TYPE
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

simple = load_plugin()
from rectifiedtransport import vtkCartogram  # noqa: E402
from rt_maps import (blocks_of, cartogram, cell_values, line_of, map_of, pieces_of, rectangle, ring_areas,  # noqa: E402
                     sixteen, square)

STATES = os.path.join(SOURCE, "Testing", "Data", "us-states.geojson")




class TestCartogram(unittest.TestCase):
    def check_shares(self, areas, masses, tolerance=0.01):
        errors = areas / areas.sum() / (np.array(masses) / np.sum(masses)) - 1
        self.assertLess(abs(errors).max(), tolerance)
        return errors

    def test_polygons(self):
        data = sixteen(20.0)
        algorithm, listener = cartogram(data)
        self.assertEqual(listener.errors + listener.warnings, [])
        regions = algorithm.GetRegions()
        areas = ring_areas(regions)
        errors = self.check_shares(areas, cell_values(data, "Mass"))
        np.testing.assert_allclose(cell_values(regions, "AreaError"), errors, atol=1e-9)
        np.testing.assert_allclose(cell_values(regions, "TargetArea"),
                                   16 * cell_values(data, "Mass") / 35, rtol=1e-12)
        self.assertAlmostEqual(areas.sum(), 16, delta=0.1)
        passes = vtk_to_numpy(regions.GetFieldData().GetArray("AreaErrors"))
        self.assertAlmostEqual(passes[-1], abs(errors).max(), delta=1e-9)
        np.testing.assert_array_equal(cell_values(regions, "Mass"), cell_values(data, "Mass"))
        self.assertGreater(regions.GetNumberOfPoints(), data.GetNumberOfPoints())

    def test_lines_and_blocks_are_the_same(self):
        """And either direction of the rings."""
        expected = ring_areas(cartogram(sixteen())[0].GetRegions())
        lines = ring_areas(cartogram(sixteen(lines=True))[0].GetRegions())
        np.testing.assert_allclose(lines, expected, rtol=1e-9)
        turned = [rectangle(x, y, x + 1, y + 1)[::-1] for y in range(4) for x in range(4)]
        back = cartogram(map_of(turned, cell_values(sixteen(), "Mass")))[0].GetRegions()
        np.testing.assert_allclose(ring_areas(back), -expected, rtol=1e-9)
        single = [sixteen(numbers=[i], lines=i % 2 == 1) for i in range(16)]
        alone = ring_areas(cartogram(blocks_of(sixteen()))[0].GetRegions())
        np.testing.assert_array_equal(alone, expected)
        joined = cartogram(blocks_of(*single))[0].GetRegions()
        self.assertEqual(joined.GetNumberOfCells(), 16)
        np.testing.assert_allclose(np.sort(ring_areas(joined)), np.sort(expected), rtol=1e-6)

    def test_pieces_and_holes(self):
        """Cells of one value are a region, whose mass counts once; a ring in it is a hole."""
        rings = [square(0, 6), square(2, 4), square(2, 4), rectangle(6, 0, 8, 6), rectangle(9, 0, 10, 3)]
        for key in ([0, 0, 7, 3, 3], ["a", "a", "c", "b", "b"]):
            data = map_of(rings, [4.0, 4.0, 1.5, 2.0, 2.0], Country=key)
            for lines in (False, True):
                data = map_of(rings, [4.0, 4.0, 1.5, 2.0, 2.0], lines=lines, Country=key)
                algorithm, listener = cartogram(data, regions="Country")
                self.assertEqual(listener.errors + listener.warnings, [])
                a = ring_areas(algorithm.GetRegions())
                self.check_shares(np.array([a[0] - a[1], a[2], a[3] + a[4]]), [4.0, 1.5, 2.0])
                self.assertAlmostEqual(a[1], a[2], delta=1e-12)
        # The same as blocks.
        parts = [map_of(rings[:2], [4.0, 4.0], lines=True), map_of(rings[2:3], [1.5], lines=True),
                 map_of(rings[3:], [2.0, 2.0], lines=True)]
        b = ring_areas(cartogram(blocks_of(*parts))[0].GetRegions())
        np.testing.assert_allclose(b, a, rtol=1e-9)

    def test_pieces_of_a_data_set(self):
        """A partitioned data set is one, whose cells are regions; in blocks, it is one region."""
        halves = [sixteen(numbers=numbers) for numbers in (range(8), range(8, 16))]
        expected = ring_areas(cartogram(sixteen())[0].GetRegions())
        np.testing.assert_allclose(ring_areas(cartogram(pieces_of(*halves))[0].GetRegions()), expected,
                                   rtol=1e-9)
        west, middle, east = (map_of([rectangle(x, 0, x + 1, 4)], [mass])
                              for x, mass in ((0, 2.0), (1, 2.0), (2, 1.0)))
        regions = cartogram(blocks_of(pieces_of(west, middle), east))[0].GetRegions()
        areas = ring_areas(regions)
        self.check_shares(np.array([areas[0] + areas[1], areas[2]]), [2.0, 1.0])

    def test_strips(self):
        """A strip is one region, after the polygons, with its first triangle's direction."""
        data, polygons, strips = sixteen(20.0), vtkCellArray(), vtkCellArray()
        for cell in range(15):
            polygons.InsertNextCell(4, [4 * cell + i for i in range(4)])
        strips.InsertNextCell(4, [60, 61, 63, 62])
        data.SetPolys(polygons)
        data.SetStrips(strips)
        algorithm, listener = cartogram(data)
        self.assertEqual(listener.errors + listener.warnings, [])
        expected = ring_areas(cartogram(sixteen(20.0))[0].GetRegions())
        np.testing.assert_allclose(ring_areas(algorithm.GetRegions()), expected, rtol=1e-9)

    def test_the_only_mass(self):
        """Without a choice; vectors and colours cannot be masses, even if they are the active scalars."""
        expected = ring_areas(cartogram(sixteen(20.0))[0].GetRegions())
        for active in (None, "Colour"):
            data = sixteen(20.0)
            colours = numpy_to_vtk(np.full((16, 3), 9, np.uint8), deep=1)
            colours.SetName("Colour")
            data.GetCellData().AddArray(colours)
            data.GetCellData().SetActiveScalars(active)
            algorithm, listener = cartogram(data, mass=None)
            self.assertEqual(listener.errors + listener.warnings, [])
            np.testing.assert_array_equal(ring_areas(algorithm.GetRegions()), expected)

    def test_planes(self):
        """Any plane, far from the origin."""
        expected = ring_areas(cartogram(sixteen())[0].GetRegions())
        u, v = np.array([2.0, 1.0, 2.0]) / 3, np.array([-2.0, 2.0, 1.0]) / 3
        algorithm, listener = cartogram(sixteen(place=lambda x, y: 1000 + x * u + y * v))
        self.assertEqual(listener.errors + listener.warnings, [])
        regions = algorithm.GetRegions()
        flat = (positions(regions) - 1000) @ np.array([u, v]).T
        self.assertLess(abs((positions(regions) - 1000) @ np.cross(u, v)).max(), 1e-9)
        points = vtkPoints()
        points.SetDataTypeToDouble()
        points.SetData(numpy_to_vtk(np.c_[flat, np.zeros(len(flat))], deep=1))
        regions.SetPoints(points)
        np.testing.assert_allclose(abs(ring_areas(regions)), expected, rtol=5e-3)

    def test_overlay_and_graticule(self):
        data = sixteen(30.0)
        overlay = vtkPolyData()
        overlay.DeepCopy(data)
        overlay.GetPointData().AddArray(data.GetPoints().GetData())
        algorithm, listener = cartogram(data, overlay)
        self.assertEqual(listener.errors + listener.warnings, [])
        regions, moved = algorithm.GetRegions(), algorithm.GetOverlay()
        count = data.GetNumberOfPoints()
        np.testing.assert_allclose(positions(moved), positions(regions)[:count], atol=1e-12)
        self.assertEqual(moved.GetPointData().GetNumberOfArrays(), 1)
        self.assertEqual(moved.GetNumberOfCells(), 16)
        self.assertGreater(abs(positions(moved) - positions(data)).max(), 0.3)
        # Far away its places are kept.
        far = vtkPolyData()
        far.SetPoints(vtkPoints())
        far.GetPoints().SetData(numpy_to_vtk(np.array([[1.7e308, 0, 0], [0, -1.7e308, 0], [2, 2, 0]]), deep=1))
        places = positions(cartogram(sixteen(1.0), far)[0].GetOverlay())
        np.testing.assert_array_equal(places[:2], positions(far)[:2])
        np.testing.assert_allclose(places[2], [2, 2, 0], atol=1e-3)
        graticule = algorithm.GetGraticule()
        self.assertEqual(graticule.GetNumberOfLines(), 34)
        np.testing.assert_allclose(graticule.GetBounds(), (-0.4, 4.4, -0.4, 4.4, 0, 0), atol=1e-9)
        wide = map_of([rectangle(0, 0, 4, 4), rectangle(4, 0, 8, 4)], [1.0, 2.0])
        bounds = np.array(cartogram(wide)[0].GetGraticule().GetBounds())
        np.testing.assert_allclose(bounds[:2], (-0.8, 8.8), atol=1e-9)  # with the margin
        self.assertTrue((abs(bounds[2:4] - (-1, 5)) < 0.5).all(), bounds)  # not the whole square
        # Without a change of areas it is the regular grid.
        plain = positions(cartogram(sixteen(1.0))[0].GetGraticule())
        regular = 0.009375 * np.round((plain[:, 0] + 0.4) / 0.009375) - 0.4
        np.testing.assert_allclose(plain[:, 0], regular, atol=2e-3)
        self.assertGreater(abs(positions(graticule) - plain).max(), 0.3)

    def test_blend(self):
        data = sixteen()
        whole = positions(cartogram(data)[0].GetRegions())
        none = positions(cartogram(data, Blend=0.0)[0].GetRegions())
        half = positions(cartogram(data, Blend=0.5)[0].GetRegions())
        np.testing.assert_array_equal(none[:data.GetNumberOfPoints()], positions(data))
        np.testing.assert_allclose(half, 0.5 * (none + whole), atol=1e-12)
        self.assertAlmostEqual(ring_areas(cartogram(data, Blend=0.0)[0].GetRegions())[5], 1, delta=1e-12)

    def test_point_data(self):
        """Points that divide an edge lie between its ends; arrays that they have not do not matter."""
        data = sixteen()
        count = data.GetNumberOfPoints()
        ids = numpy_to_vtk(np.arange(count), deep=1, array_type=VTK_ID_TYPE)
        ghosts = numpy_to_vtk(np.zeros(count, np.uint8), deep=1)
        heights = numpy_to_vtk(positions(data) @ [2.0, 3.0, 0.0], deep=1)
        for array, name in ((ids, "Ids"), (ghosts, "vtkGhostType"), (heights, "Height")):
            array.SetName(name)
            data.GetPointData().AddArray(array)
        data.GetPointData().SetActiveGlobalIds("Ids")
        regions = cartogram(data, Blend=0.0)[0].GetRegions()
        self.assertGreater(regions.GetNumberOfPoints(), count)
        np.testing.assert_allclose(vtk_to_numpy(regions.GetPointData().GetArray("Height")),
                                   positions(regions) @ [2.0, 3.0, 0.0], atol=1e-9)

    def test_masses_change(self):
        """The map is kept; the result is that of a new filter."""
        data = sixteen(3.0)
        algorithm, _ = cartogram(data)
        before = positions(algorithm.GetRegions())
        changed = sixteen(40.0)
        algorithm.SetInputDataObject(0, changed)
        algorithm.Update()
        after = positions(algorithm.GetRegions())
        np.testing.assert_array_equal(after, positions(cartogram(changed)[0].GetRegions()))
        self.assertFalse(np.array_equal(before, after[:len(before)]))
        for name, value in (("Resolution", 64), ("Margin", 0.3)):
            getattr(algorithm, "Set" + name)(value)
            algorithm.Update()
            fresh = vtkCartogram()
            for key in ("Resolution", "Margin"):
                getattr(fresh, "Set" + key)(getattr(algorithm, "Get" + key)())
            fresh.SetInputDataObject(0, changed)
            fresh.SetInputArrayToProcess(0, 0, 0, 1, "Mass")
            fresh.Update()
            np.testing.assert_array_equal(positions(algorithm.GetRegions()), positions(fresh.GetRegions()))

    def test_default_mass(self):
        algorithm, listener = cartogram(sixteen(), mass=None)
        self.assertEqual(listener.errors, [])
        self.check_shares(ring_areas(algorithm.GetRegions()), cell_values(sixteen(), "Mass"))

    def test_empty_input(self):
        algorithm, listener = cartogram(vtkPolyData())
        self.assertEqual(listener.errors + listener.warnings, [])
        self.assertEqual(algorithm.GetRegions().GetNumberOfPoints(), 0)

    def test_warnings(self):
        zero = sixteen()
        zero.GetCellData().GetArray("Mass").SetValue(3, 0.0)
        _, listener = cartogram(zero)
        self.assertIn("1 of 16 regions (6.25 %) have no mass", listener.warnings[0])
        wide = sixteen(place=lambda x, y: (200 * x, y, 0.0))
        wide.GetCellData().GetArray("Mass").SetValue(3, 0.0)
        targets = cell_values(cartogram(wide)[0].GetRegions(), "TargetArea")
        self.assertAlmostEqual(targets[3], 1e-4 * 200, delta=1e-6)
        algorithm, listener = cartogram(sixteen(), MinimumShare=0.05)
        self.assertIn("15 of 16 regions (93.8 %) are enlarged to MinimumShare", listener.warnings[0])
        self.check_shares(ring_areas(algorithm.GetRegions()), [0.25 if i == 5 else 0.05 for i in range(16)])
        self.assertEqual(algorithm.GetRegions().GetFieldData().GetArray("EnlargedRegions").GetValue(0), 15)
        algorithm, listener = cartogram(sixteen(), MinimumShare=0.5)
        self.check_shares(ring_areas(algorithm.GetRegions()), [1.0] * 16)
        data = map_of([square(0, 4), rectangle(3, 0, 8, 4)], [1.0, 2.0])
        self.assertIn("Regions overlap by 11 % of their area", cartogram(data)[1].warnings[0])
        degrees = sixteen(place=lambda x, y: (10 * x, 40 + 10 * y, 0.0))
        self.assertIn("degrees of longitude and latitude", cartogram(degrees)[1].warnings[0])
        _, listener = cartogram(sixteen(), MaximumIterations=1, Tolerance=1e-6)
        self.assertIn("raise MaximumIterations", listener.warnings[0])
        lake = map_of([square(0, 10), square(5, 5.1), square(5, 5.1)], [1.0, 1.0, 1e-9],
                      name=["land", "land", "pond"])
        _, listener = cartogram(lake, regions="name", Resolution=32)
        self.assertEqual(listener.warnings, [])  # hardly any mass
        lake.GetCellData().GetArray("Mass").SetValue(2, 0.02)
        lake.Modified()
        algorithm, listener = cartogram(lake, regions="name", Resolution=16, MaximumIterations=1)
        self.assertEqual(algorithm.GetRegions().GetFieldData().GetArray("RegionsMissed").GetValue(0), 2)

    def test_errors(self):
        nan = sixteen()
        nan.GetCellData().GetArray("Mass").SetValue(7, np.nan)
        negative = sixteen(-2.0)
        empty = map_of([square(0, 1)], [0.0])
        flat = map_of([square(0, 4), [(5, 5), (6, 6), (7, 7)]], [1.0, 1.0])
        bent = sixteen(place=lambda x, y: (x, y, x * y))
        twice = map_of([square(0, 1), square(2, 3)], [1.0, 2.0], Land=[3, 3])
        open_line = map_of([square(0, 4)], [1.0], lines=True)
        open_line.GetLines().ReplaceCellAtId(0, 5, [0, 1, 2, 3, 1])
        twofold = map_of([square(0, 1) * 2, square(2, 3)], [1.0, 1.0])
        two = sixteen()
        two.GetCellData().AddArray(numpy_to_vtk(np.ones(16), deep=1))
        two.GetCellData().GetArray(1).SetName("Other")
        points = vtkPolyData()
        points.SetPoints(sixteen().GetPoints())
        infinite = sixteen()
        infinite.GetPoints().SetPoint(3, np.inf, 0, 0)
        for data, options, text in (
                (sixteen(), dict(mass="None such"), "MassArray 'None such' is no numeric cell array"),
                (two, dict(mass=None),
                 "MassArray is not set, and the input has 2 numeric cell arrays of one component"),
                (nan, {}, "The mass of the region of cell 7 in 'Mass' is nan"),
                (negative, {}, "The mass of the region of cell 5 in 'Mass' is -2"),
                (empty, {}, "The masses in 'Mass' sum to 0"),
                (flat, {}, "1 of 2 regions (50 %) have no area (the first is the region of cell 1)"),
                (bent, {}, "The regions are not in a plane"),
                (twice, dict(regions="Land"), "has cells of mass 1 and 2 in 'Mass'"),
                (open_line, {}, "1 of 1 lines of the input do not close (the first is cell 0)"),
                (points, {}, "The input has no regions"),
                (twofold, {}, "region"),
                (infinite, {}, "The input has 1 point that is NaN or infinite, the first at index 3"),
                (sixteen(), dict(regions="Nowhere"), "RegionArray 'Nowhere' is no cell array"),
                (sixteen(), dict(Tolerance=0.0), "Tolerance is 0; it must be above 0 and at most 1"),
                (sixteen(), dict(Tolerance=1.5), "Tolerance is 1.5"),
                (sixteen(), dict(Resolution=4), "Resolution is 4; it must be from 16 to 16384"),
                (sixteen(), dict(Margin=-1.0), "Margin is -1"),
                (sixteen(), dict(EmptyCells=7), "EmptyCells is 7"),
                (sixteen(), dict(EmptyValue=-1.0), "EmptyValue is -1"),
                (sixteen(), dict(MaximumIterations=0), "MaximumIterations is 0"),
                (sixteen(), dict(MinimumShare=1.5), "MinimumShare is 1.5; it must be from 0 to 1"),
                (sixteen(), dict(Blend=2.0), "Blend is 2")):
            with self.subTest(text=text):
                algorithm, listener = cartogram(data, **options)
                self.assertIn(text, "\n".join(listener.errors))
                self.assertEqual(algorithm.GetRegions().GetNumberOfPoints(), 0)
                self.assertEqual(algorithm.GetGraticule().GetNumberOfPoints(), 0)

    def test_bad_maps(self):
        """To the letter: what an error or the warnings say, and that it is all."""
        nan = sixteen()
        nan.GetCellData().GetArray("Mass").SetValue(7, np.nan)
        open_line = map_of([square(0, 4)], [1.0], lines=True)
        open_line.GetLines().ReplaceCellAtId(0, 5, [0, 1, 2, 3, 1])
        short = sixteen()
        short.GetCellData().GetArray("Mass").SetNumberOfTuples(15)
        nameless = sixteen()
        nameless.GetCellData().GetArray("Mass").SetName(None)
        nameless.GetCellData().SetScalars(nameless.GetCellData().GetArray(0))
        nameless.GetCellData().GetScalars().SetValue(7, -1)
        for data, options, text in (
                (sixteen(), dict(Tolerance=0.0), "Tolerance is 0; it must be above 0 and at most 1"),
                (sixteen(), dict(Tolerance=1.5), "Tolerance is 1.5; it must be above 0 and at most 1"),
                (sixteen(), dict(Tolerance=np.nan), "Tolerance is nan; it must be above 0 and at most 1"),
                (map_of([square(0, 4), [(5, 5), (6, 6), (7, 7)]], [1.0, 1.0], name=["a", "b"]), {},
                 "1 of 2 regions (50 %) have no area (the first is the region 'b'); remove them, with "
                 "Threshold"),
                (open_line, {}, "1 of 1 lines of the input do not close (the first is cell 0); the outline of a "
                                "region must end at the point where it begins"),
                (short, {}, "The cell array 'Mass' of the input has 15 tuples; it must have one for each of the "
                            "16 cells"),
                (nameless, dict(mass=None), "The mass of the region of cell 7 in the scalars, which have no name, is -1; "
                                            "masses must be at least 0 and finite"),
                (map_of([square(0, 4)]), dict(mass=None),
                 "MassArray is not set, and the input has 0 numeric cell arrays of one component; set it to the "
                 "one that has the mass of each region"),
                (sixteen(), dict(mass="None such"),
                 "MassArray 'None such' is no numeric cell array of the input; choose one that has the mass of "
                 "each region"),
                (nan, {}, "The mass of the region of cell 7 in 'Mass' is nan; masses must be at least 0 and finite"),
                (sixteen(np.inf), {},
                 "The mass of the region of cell 5 in 'Mass' is inf; masses must be at least 0 and finite"),
                (map_of([square(0, 1)] * 2, [0.0, 0.0]), {},
                 "The masses in 'Mass' sum to 0; they must sum to a number above 0"),
                (map_of([square(0, 1), square(2, 3)], [1.0, 2.0], Land=[3, 3]), dict(regions="Land"),
                 "The region '3' has cells of mass 1 and 2 in 'Mass'; all cells of a region must have its "
                 "mass, which counts once"),
                (blocks_of(sixteen(), map_of([square(5, 6)])), {},
                 "MassArray 'Mass' is no numeric cell array of all blocks of the input (the block 2 of the input "
                 "has none); choose one that has the mass of each region")):
            with self.subTest(text=text):
                algorithm, listener = cartogram(data, **options)
                self.assertEqual([line_of(error) for error in listener.errors
                                  if "returned failure" not in error], [text])
                self.assertEqual(listener.warnings, [])
                self.assertEqual(algorithm.GetRegions().GetNumberOfPoints(), 0)
        no_mass = map_of([rectangle(i, 0, i + 1, 1) for i in range(4)], [0.0, 5.0, 0.0, 1.0])
        for data, options, texts in (
                (map_of([square(0, 4)], [3.0]), {}, []),
                (sixteen(place=lambda x, y: (x, y, 2 * x - y)), {}, []),
                (map_of([square(0, 1), [(x + 300, y) for x, y in square(0, 1)]], [1.0, 3.0]), {}, []),
                (map_of([square(0, 4), rectangle(3, 0, 8, 4)], [1.0, 2.0]), {},
                 ["Regions overlap by 11 % of their area (most at the region of cell 0), which counts for each of "
                  "them; their areas there are not what their masses ask"]),
                (sixteen(place=lambda x, y: (10 * x, 40 + 10 * y, 0.0)), {},
                 ["The coordinates look like degrees of longitude and latitude, in which areas are wrong; set "
                  "Projection to EqualArea, or project the map with the Calculator or QGIS"]),
                (no_mass, dict(Tolerance=1.0, MinimumShare=0.01),
                 ["2 of 4 regions (50 %) have no mass (the first is the region of cell 0); they get a "
                  "ten-thousandth of the mean density, as no area can be shown",
                  "2 of 4 regions (50 %) are enlarged to MinimumShare"])):
            with self.subTest(texts=texts):
                algorithm, listener = cartogram(data, **options)
                self.assertEqual(listener.errors, [])
                self.assertEqual([line_of(warning) for warning in listener.warnings], texts)
                self.assertEqual(algorithm.GetRegions().GetNumberOfPolys(), data.GetNumberOfPolys())
        one, _ = cartogram(map_of([square(0, 4)], [3.0]))
        self.assertAlmostEqual(ring_areas(one.GetRegions())[0], 16, delta=0.01)

    def test_extremes(self):
        """All mass in one region; masses and coordinates near the ends of doubles."""
        one = map_of([rectangle(i, 0, i + 1, 1) for i in range(4)], [0.0, 5.0, 0.0, 0.0])
        algorithm, listener = cartogram(one)
        self.assertEqual(listener.errors, [])
        self.assertGreater(ring_areas(algorithm.GetRegions())[1], 3.9)
        expected = ring_areas(cartogram(sixteen())[0].GetRegions())
        for scale in (1e-250, 1e250):
            data = map_of([rectangle(x, y, x + 1, y + 1) for y in range(4) for x in range(4)],
                          cell_values(sixteen(), "Mass") * scale)
            np.testing.assert_allclose(ring_areas(cartogram(data)[0].GetRegions()), expected, rtol=1e-6)
        for scale in (1e-60, 1e60):
            data = sixteen(place=lambda x, y, s=scale: (s * x, s * y, 0.0))
            np.testing.assert_allclose(ring_areas(cartogram(data)[0].GetRegions()) / scale ** 2, expected,
                                       rtol=1e-6)

    def test_wide_sea(self):
        data = map_of([square(0, 1), [(x + 300, y) for x, y in square(0, 1)]], [1.0, 3.0])
        algorithm, listener = cartogram(data)
        self.assertEqual(listener.errors, [])
        areas = ring_areas(algorithm.GetRegions())
        self.assertGreater(areas[1], areas[0])

    @unittest.skipUnless(hasattr(simple, "GDALVectorReader"), "this ParaView has no GDAL Vector Reader")
    def test_map_file(self):
        """The United States with the people of 2020, from the file as ParaView reads it."""
        reader = simple.GDALVectorReader(FileName=STATES)
        proxy = simple.Cartogram(Input=reader, MassArray=["CELLS", "mass"])
        listener = Listener(proxy.GetClientSideObject())
        proxy.UpdatePipeline()
        self.assertEqual(listener.errors + listener.warnings, [])
        algorithm = proxy.GetClientSideObject()
        regions = algorithm.GetOutputDataObject(0)
        names = regions.GetCellData().GetAbstractArray("name")
        masses, areas = {}, {}
        for cell, area in enumerate(ring_areas(regions)):
            name = names.GetValue(cell)
            masses[name] = regions.GetCellData().GetArray("mass").GetTuple1(cell)
            areas[name] = areas.get(name, 0) + area
        self.assertEqual(len(masses), 49)
        errors = self.check_shares(np.array(list(areas.values())), list(masses.values()), 0.005)
        self.assertAlmostEqual(abs(errors).max(), abs(cell_values(regions, "AreaError")).max(), delta=1e-6)
        self.assertLessEqual(regions.GetFieldData().GetArray("AreaErrors").GetNumberOfTuples(), 4)

    def test_in_the_pipeline(self):
        proxy = simple.Cartogram(Input=producer(simple, sixteen()), MassArray=["CELLS", "Mass"], Resolution=64)
        self.assertEqual(proxy.SMProxy.GetNumberOfOutputPorts(), 3)
        proxy.UpdatePipeline()
        self.assertLess(proxy.CellData["AreaError"].GetRange()[1], 0.01)


main()

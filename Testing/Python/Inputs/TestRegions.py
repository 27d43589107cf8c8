# SPDX-License-Identifier: BSD-3-Clause
"""Polygons and closed lines as regions: holes, spikes, crossings, maps; their mass and where
particles lie in them."""
import json
import os
import tempfile
import unittest

import numpy as np
from rt_testing import Listener, load_plugin, main, output_of, positions
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_POLYGON, VTK_QUAD, vtkCellArray, vtkMultiBlockDataSet,
                                           vtkPolyData, vtkUnstructuredGrid)

simple = load_plugin()
from rectifiedtransport import vtkTransportMap, vtkTransportSampler  # noqa: E402

KEYHOLE = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]
SPIKED = [(0, 0), (4, 0), (4, 1), (5, 1), (4, 1), (1, 1), (1, 4), (0, 4)]
BESIDE = [(5, 0), (6, 0), (6, 4), (5, 4)]


def square(low, high):
    return [(low, low), (high, low), (high, high), (low, high)]


def area_of(ring):
    x, y = (np.array(ring) - np.mean(ring, axis=0)).T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def star(count, depth=0.3, seed=0):
    random = np.random.default_rng(seed)
    angles = np.sort(random.random(count)) * 2 * np.pi
    radius = 1 + depth * random.random(count)
    return np.c_[radius * np.cos(angles), radius * np.sin(angles)]


def oblique(points):
    """In a plane that is none of the coordinate planes, far from the origin."""
    u, v = np.array([2.0, 1.0, 2.0]) / 3, np.array([-2.0, 2.0, 1.0]) / 3
    return np.outer(points[:, 0], u) + np.outer(points[:, 1], v) + [1000, -500, 70]


def data_of(rings, values=None, lines=False, closed_by_id=True, place=None, name="pop"):
    """Polygons or closed lines, each of points of its own; with values on cells, or on points
    where these are a function."""
    points = np.concatenate([np.asarray(ring, float) for ring in rings])
    data = vtkPolyData()
    corners = vtkPoints()
    corners.SetDataTypeToDouble()
    cells = vtkCellArray()
    placed = np.c_[points, np.zeros(len(points))] if place is None else place(points)
    first = 0
    extra = []
    for ring in rings:
        ids = list(range(first, first + len(ring)))
        if lines and closed_by_id:
            ids.append(first)
        elif lines:
            ids.append(len(points) + len(extra))
            extra.append(placed[first])
        cells.InsertNextCell(len(ids))
        for i in ids:
            cells.InsertCellPoint(i)
        first += len(ring)
    if extra:
        placed = np.concatenate([placed, extra])
    corners.SetData(numpy_to_vtk(placed, deep=1))
    data.SetPoints(corners)
    (data.SetLines if lines else data.SetPolys)(cells)
    if callable(values):
        array = numpy_to_vtk(values(placed), deep=1)
        data.GetPointData().SetScalars(array)
    else:
        array = numpy_to_vtk(np.array(values or [1.0] * len(rings), float), deep=1)
        data.GetCellData().SetScalars(array)
    array.SetName(name)
    return data


def sample(data, number=500, **properties):
    """The particles, and what was said."""
    sampler = vtkTransportSampler()
    sampler.SetInputDataObject(data)
    sampler.SetNumberOfParticles(number)
    for name, value in properties.items():
        getattr(sampler, "Set" + name)(value)
    listener = Listener(sampler)
    sampler.Update()
    return sampler.GetOutput(), listener


def mass_of(particles):
    return particles.GetFieldData().GetArray("TotalMass").GetValue(0)


class Regions(unittest.TestCase):
    def check(self, data, mass, number=500, warnings=0, **properties):
        particles, listener = sample(data, number, **properties)
        self.assertEqual(listener.errors, [])
        self.assertEqual(len(listener.warnings), warnings, listener.warnings)
        self.assertAlmostEqual(mass_of(particles) / mass, 1, delta=1e-12)
        return particles, listener

    def test_holes_and_spikes(self):
        for ring, area in ((KEYHOLE, 12), (SPIKED, 7)):
            for turn in (1, -1):
                for shift in (0, 3):
                    for place in (None, oblique):
                        turned = np.roll(np.array(ring, float)[::turn], shift, axis=0)
                        with self.subTest(ring=ring[4], turn=turn, shift=shift, place=place):
                            self.check(data_of([turned, BESIDE], [2, 3], place=place),
                                       2 * area + 3 * 4)

    def test_crossings(self):
        angles = np.arange(5) * 4 * np.pi / 5
        pentagram = np.c_[np.cos(angles), np.sin(angles)]
        # The points of the star, without the pentagon that it winds around twice.
        inner = np.cos(np.pi * 2 / 5) / np.cos(np.pi / 5)
        star_area = 5 * inner * np.sin(np.pi / 5)
        pentagon = 2.5 * inner ** 2 * np.sin(2 * np.pi / 5)
        self.check(data_of([pentagram]), star_area - pentagon)
        self.check(data_of([[(0, 0), (2, 2), (2, 0), (0, 2)]]), 2)
        self.check(data_of([[(0, 0), (4, 0), (1, 1), (0, 4)]]), 4)

    def test_mass_of_one_crossing_region(self):
        """Its share of the mass is found after its outline was: once more by the even-odd rule."""
        bow = [(0, 0), (2, 2), (2, 0), (0, 2)]
        beside = [np.array(square(0, 1)) + [3 + i, 0] for i in range(30)]
        _, listener = sample(data_of([*beside, bow], [1.0] * 30 + [1e20]))
        self.assertEqual(len(listener.warnings), 1, listener.warnings)
        self.assertIn("1e+20", listener.warnings[0])

    def test_cells_of_grids(self):
        """A concave quadrilateral, where VTK may take the outer diagonal, and a keyhole."""
        grid = vtkUnstructuredGrid()
        grid.SetPoints(data_of([KEYHOLE, [(5, 0), (9, 0), (6, 1), (5, 4)]]).GetPoints())
        grid.InsertNextCell(VTK_POLYGON, 10, list(range(10)))
        grid.InsertNextCell(VTK_QUAD, 4, [10, 11, 12, 13])
        values = numpy_to_vtk(np.array([1.0, 10.0]), deep=1)
        values.SetName("v")
        grid.GetCellData().SetScalars(values)
        self.check(grid, 12 + 40)

    def test_point_values(self):
        """A linear function has the mass that it has at the centroid, divided by VTK or not."""
        def function(x):
            return 1 + x[:, 0] + 0.5 * x[:, 1]
        self.check(data_of([KEYHOLE], function), 12 * 4)
        self.check(data_of([square(0, 4)], function), 16 * 4)
        ring = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]
        self.check(data_of([ring], function), 12 * (1 + 1.5 * 20 / 12))
        many = star(3000)
        particles, _ = self.check(
            data_of([many], lambda x: np.full(len(x), 2.5)), 2.5 * area_of(many))
        self.assertEqual(particles.GetNumberOfPoints(), 500)

    def test_long_outlines(self):
        for count, seed in ((6000, 1), (20000, 2)):
            ring = star(count, seed=seed)
            self.check(data_of([ring]), area_of(ring), 50, DensityResolution=300)

    def test_threads_and_slabs(self):
        rings = [star(400, 0.9, i) + [3 * i, 0] for i in range(5)]
        found = []
        for threading in (0, 3):
            transport = vtkTransportMap()
            transport.SetThreading(threading)
            transport.SetInputDataObject(data_of(rings, [1, 2, 3, 4, 5]))
            transport.Update()
            found.append(vtk_to_numpy(transport.GetOutput().GetCellData().GetArray("pop")).copy())
        np.testing.assert_array_equal(found[0], found[1])

    def test_particles_are_inside(self):
        ring = star(2000, 0.6)
        keyhole = np.array(KEYHOLE, float) + [2, 2]
        data = data_of([ring, keyhole], [1, 2])
        particles, _ = sample(data, 4000, SampleArrays=True, DensityResolution=512)
        cells = vtk_to_numpy(particles.GetPointData().GetArray("pop"))
        x = positions(particles)
        self.assertTrue(np.all((cells == 1) == (x[:, 0] < 1.8)))
        in_hole = np.all((x[:, :2] > 3.02) & (x[:, :2] < 4.98), axis=1)
        self.assertEqual(in_hole.sum(), 0)

    def test_arrays_between_points(self):
        """A linear function is interpolated as it is, within keyholes and closed lines too."""
        def function(x):
            return 2 + x[:, 0] - 0.25 * x[:, 1]
        for data in (data_of([KEYHOLE], function),
                     data_of([square(0, 4), square(1, 3)], function, lines=True)):
            particles, _ = sample(data, 2000, SampleArrays=True)
            values = vtk_to_numpy(particles.GetPointData().GetArray("pop"))
            x = positions(particles)
            inside = np.all((x[:, :2] > 0) & (x[:, :2] < 4), axis=1) & ~np.all(
                (x[:, :2] > 1) & (x[:, :2] < 3), axis=1)
            self.assertGreater(inside.sum(), 1900)
            self.assertLess(abs(values - function(x))[inside].max(), 1e-12)

    def test_closed_lines(self):
        rings = [square(0, 4), square(1, 3), BESIDE]
        for closed_by_id in (True, False):
            for place in (None, oblique):
                data = data_of(rings, [3, 3, 5], True, closed_by_id, place)
                particles, _ = self.check(data, 56, SampleArrays=True)
                values = vtk_to_numpy(particles.GetPointData().GetArray("pop"))
                self.assertEqual(set(values), {3, 5})
        # An island in a hole, and a region that fills one.
        self.check(data_of([square(0, 8), square(1, 7), square(2, 5)], [3, 3, 7], True),
                   3 * (64 - 36) + 7 * 9)
        self.check(data_of([square(1, 3), square(0, 4), square(1, 3)], [5, 3, 3], True), 56)
        # Neighbours share an edge, and lines of one value cross.
        self.check(data_of([square(0, 4), [(4, 0), (6, 0), (6, 4), (4, 4)]], [1, 2], True), 32)
        self.check(data_of([square(0, 4), square(2, 6)], [1, 1], True), 24)

    def test_blocks_add_up(self):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, data_of([square(0, 4), square(1, 3)], [3, 3], True))
        blocks.SetBlock(1, data_of([square(2, 5)], [10], True))
        self.check(blocks, 36 + 90)

    def test_open_lines(self):
        data = data_of([square(0, 4), square(1, 3)], [3, 3], True)
        lines = data.GetLines()
        for ids in ((0, 5, 2), (1, 7)):
            lines.InsertNextCell(len(ids))
            for i in ids:
                lines.InsertCellPoint(i)
        values = numpy_to_vtk(np.array([3.0, 3.0, 100.0, 100.0]), deep=1)
        values.SetName("pop")
        data.GetCellData().SetScalars(values)
        _, listener = self.check(data, 36, warnings=1)
        self.assertIn("2 lines of the input are not closed (the first is cell 2) and carry no mass", listener.warnings[0])

    def test_lines_on_a_straight_line_stay_lines(self):
        self.check(data_of([[(0, 0), (1, 1), (3, 3)]], [2], True), 2 * 6 * 2 ** 0.5)
        _, listener = sample(data_of([[(0, 0), (1, 1), (3, 3.5)]], None, True, False))
        self.assertEqual(listener.errors, [])  # a closed triangle
        data = data_of([[(0, 0), (1, 1), (3, 3.5)]])
        data.SetLines(data.GetPolys())
        data.SetPolys(vtkCellArray())
        _, listener = sample(data)
        self.assertEqual(len(listener.errors), 1)
        self.assertIn("closed ones in a plane", listener.errors[0])

    def test_coordinates_that_are_not_finite(self):
        for bad in (np.inf, -np.inf, np.nan):
            for lines in (False, True):
                data = data_of([square(0, 4), BESIDE], [1, 1], lines)
                data.GetPoints().SetPoint(6, 5.0, bad, 0.0)
                blocks = vtkMultiBlockDataSet()
                blocks.SetBlock(0, data_of([square(0, 4)], [1], lines))
                blocks.SetBlock(1, data)
                for given, where in ((data, "the input"), (blocks, "the block 2 of the input")):
                    particles, listener = sample(given)
                    self.assertEqual(particles.GetNumberOfPoints(), 0)
                    self.assertEqual(len(listener.errors), 1, listener.errors)
                    self.assertIn("Point 6 of %s is at (5, " % where, listener.errors[0])
        # A point of no cell does not matter.
        data = data_of([square(0, 4)])
        data.GetPoints().InsertNextPoint(np.nan, 0, np.inf)
        self.check(data, 16)

    def test_map_of_the_vector_reader(self):
        """GeoJSON: a block a feature, the value on every ring."""
        if not hasattr(simple, "GDALVectorReader"):
            self.skipTest("This ParaView has no GDAL Vector Reader")
        def closed(ring):
            return [list(map(float, x)) for x in ring + ring[:1]]
        features = [(3.0, "Polygon", [closed(square(0, 4)), closed(square(1, 3)[::-1])]),
                    (5.0, "MultiPolygon", [[closed(BESIDE)], [closed(square(7, 9))]]),
                    (7.0, "Polygon", [closed(square(1, 3))])]
        text = {"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"pop": value},
             "geometry": {"type": kind, "coordinates": rings}} for value, kind, rings in features]}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "map.geojson")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(text, file)
            reader = simple.GDALVectorReader(FileName=path)
            sampler = simple.SampleDensity(reader, DensityArray=["CELLS", "pop"],
                                           NumberOfParticles=300)
            listener = Listener(sampler.GetClientSideObject())
            particles = output_of(sampler)
        self.assertEqual(listener.errors + listener.warnings, [])
        self.assertAlmostEqual(mass_of(particles), 3 * 12 + 5 * (4 + 4) + 7 * 4, delta=1e-9)


main()

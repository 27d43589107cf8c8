# SPDX-License-Identifier: BSD-3-Clause
"""Missing data are one thing: blanked cells, hidden points, NaN, values out of range and ground outside of
a mesh give the same bits, and empty cells count as EmptyCells has it."""
import hashlib
import math
import unittest

import numpy as np
import rectifiedtransport as rt
from rt_missing import (FILL, HIDDEN_CELL, HIDDEN_POINT, OF_INTEGERS, SHAPES, WAYS, below_range, blanked,
                        hide, hole, image_of, in_hole, mesh_without, refined_grids, values_of, with_nan)
from rt_testing import Listener, density_image, main, points_in, positions, set_property, size_of
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_POLY_LINE, vtkCellArray, vtkPolyData, vtkStructuredGrid

RULES = (dict(EmptyCells=0), dict(EmptyCells=1), dict(EmptyCells=2), dict(EmptyCells=3, EmptyValue=1.75))


def run(filter_, data, **properties):
    """A filter with a density; its messages and output."""
    filter_.SetInputData(filter_.GetNumberOfInputPorts() - 1 if filter_.IsA("vtkDensityEqualizingWarp")
                         else 0, data)
    for name, value in properties.items():
        set_property(filter_, name, value)
    reported = Listener(filter_)
    filter_.Update()
    return reported, filter_.GetOutputDataObject(0)


def hashed(array):
    return hashlib.sha256(array.tobytes()).hexdigest()[:16]


def bits(filter_, data, arrays, **properties):
    """Of the positions and some arrays of an output."""
    reported, output = run(filter_, data, **properties)
    assert not reported.errors, reported.errors
    assert size_of(output) > 0
    found = [hashed(positions(output) if output.IsA("vtkPointSet") else np.array(output.GetBounds()))]
    for name in arrays:
        owner = output.GetPointData() if output.GetPointData().HasArray(name) else output.GetCellData()
        found.append(hashed(vtk_to_numpy(owner.GetArray(name))))
    found += [output.GetFieldData().GetArray(name).GetTuple(0) for name in ("TotalMass",)
              if output.GetFieldData().HasArray(name)]
    return found


def sampled(data, **properties):
    sampler = rt.vtkTransportSampler()
    sampler.SetNumberOfParticles(200)
    return bits(sampler, data, ["Displacement", "Mass"], **properties)


def mapped(data, **properties):
    return bits(rt.vtkTransportMap(), data, ["Displacement", "JacobianDeterminant"], **properties)


def warper(box):
    """A warp of points in the box of a data set."""
    warp = rt.vtkDensityEqualizingWarp()
    warp.SetInputData(0, points_in(box, 60))
    return warp


def warped_in(box):
    """What makes the bits of such a warp."""
    def warped(data, **properties):
        return bits(warper(box), data, ["Displacement"], **properties)
    return warped


class OneThing(unittest.TestCase):
    def assert_same(self, ways, values, compute, **properties):
        expected = None
        for way in ways:
            data, own = way(values)
            found = compute(data, **{**properties, **own})
            expected = expected or found
            with self.subTest(way.__name__, shape=values.shape, type=values.dtype, **properties):
                self.assertEqual(found, expected)

    def each_values(self):
        for shape in SHAPES:
            for dtype, ways in ((np.float64, WAYS), (np.float32, WAYS), (np.int16, OF_INTEGERS),
                                (np.int64, OF_INTEGERS)):
                # AMR has no line of cells
                yield values_of(shape, dtype), [
                    way for way in ways if way is not refined_grids or len(shape) > 1]

    def test_particles(self):
        for values, ways in self.each_values():
            self.assert_same(ways, values, sampled)

    def test_maps(self):
        for values, ways in self.each_values():
            for rule in RULES if values.dtype in (np.float64, np.int16) else RULES[1:2]:
                self.assert_same(ways, values, mapped, Direction=1, **rule)

    def test_warps(self):
        for values, ways in self.each_values():
            for rule in ({}, *RULES) if values.dtype == np.float64 else ({},):
                of_points = warped_in(image_of(values))
                self.assert_same(ways, values, of_points, **rule)
                self.assert_same(ways, values, of_points, Margin=0.2, **rule)

    def test_tiles(self):
        values = values_of((60, 50))
        for rule in RULES:
            self.assert_same(WAYS, values, mapped, Tables=2, NumberOfSteps=32, **rule)
        self.assert_same(WAYS, values, warped_in(image_of(values)), Tables=2, NumberOfSteps=32,
                         Margin=0.1)

    def test_inverted(self):
        """White is found among valid values."""
        for values in (values_of((12, 10)), values_of((12, 10), np.int16)):
            ways = WAYS if values.dtype == float else OF_INTEGERS
            for rule in RULES:
                self.assert_same(ways, values, mapped, InvertDensity=1, **rule)

    def test_points(self):
        """Dual cells of hidden points, of NaN, and of values out of range."""
        values = values_of((12, 10))
        flags = HIDDEN_POINT * hole(values.shape).astype(np.uint8)
        ways = [lambda v: (hide(image_of(in_hole(v, FILL), False), flags, True), {}),
                lambda v: (image_of(in_hole(v, math.nan), False), dict(NaNValues=1)),
                lambda v: (image_of(in_hole(v, FILL), False), dict(ValidRange=(0, 1e299)))]
        for rule in RULES:
            self.assert_same(ways, values, mapped, **rule)

    def test_points_of_meshes(self):
        """The cells of a hidden point, or of one without a valid value, are empty."""
        values = values_of((9, 8))
        bent = vtkPoints()
        for j in range(8):
            for i in range(9):
                bent.InsertNextPoint(i + 0.1 * j * j, j + 0.05 * i, 0)

        def mesh(marked, flags=None):
            grid = vtkStructuredGrid()
            grid.SetDimensions(9, 8, 1)
            grid.SetPoints(bent)
            grid.GetPointData().SetScalars(image_of(marked, False).GetPointData().GetScalars())
            return grid if flags is None else hide(grid, flags, True)
        flags = HIDDEN_POINT * hole(values.shape).astype(np.uint8)
        ways = [lambda v: (mesh(in_hole(v, FILL), flags), {}),
                lambda v: (mesh(in_hole(v, math.nan)), dict(NaNValues=1)),
                lambda v: (mesh(in_hole(v, FILL)), dict(ValidRange=(0, 1e299)))]
        for rule in RULES:
            self.assert_same(ways, values, mapped, DensityResolution=24, **rule)

    def test_closed_lines(self):
        """Lines around regions; those without a valid value are not there."""
        def lines(marks):
            points, cells = vtkPoints(), vtkCellArray()
            for number, mark in enumerate(marks):
                if mark is None:
                    continue
                cells.InsertNextCell(5)
                for x, y in ((0, 0), (2, 0), (2, 2), (0, 2), (0, 0)):
                    cells.InsertCellPoint(points.InsertNextPoint(3 * number + x, y + number % 2, 0))
            data = vtkPolyData()
            data.SetPoints(points)
            data.SetLines(cells)
            self.assertEqual(data.GetCellType(0), VTK_POLY_LINE)
            array = numpy_to_vtk(np.array([m for m in marks if m is not None], float), deep=1)
            array.SetName("Density")
            data.GetCellData().SetScalars(array)
            return data
        marks = (2.0, "", 5.0, 1.0)
        ways = [lambda v: (lines([m if m else None for m in marks]), {}),
                lambda v: (lines([m or math.nan for m in marks]), dict(NaNValues=1)),
                lambda v: (lines([m or 1e20 for m in marks]), dict(ValidRange=(0, 10)))]
        for rule in RULES:
            self.assert_same(ways, np.zeros((1, 1)), mapped, DensityResolution=33, **rule)

    def test_colours(self):
        """A component without a valid value, but alpha by range; of a magnitude each component."""
        colours = values_of((12, 10, 4))
        colours[..., 3] = 40

        def image(marked, mark, component=1):
            array = marked.copy()
            array[hole((12, 10)), component] = mark
            data = density_image((12, 10), values=np.ascontiguousarray(
                array.transpose(1, 0, 2).reshape(-1, 4)))
            return data
        flags = HIDDEN_CELL * hole((12, 10)).astype(np.uint8)
        for component, highest in ((-2, 31), (-3, 40)):
            for invert in (0, 1):
                rules = dict(Component=component, EmptyCells=1, InvertDensity=invert)
                expected = mapped(hide(image(colours, 3), flags), **rules)
                for data, own in ((image(colours, math.nan), dict(NaNValues=1)),
                                  (image(colours, math.nan, 3), dict(NaNValues=1)),
                                  (image(colours, 1e20, 2), dict(ValidRange=(0, highest)))):
                    self.assertEqual(mapped(data, **rules, **own), expected)
        # One component is judged by itself.
        data = image(colours, math.nan)
        self.assertEqual(mapped(data, Component=0), mapped(image(colours, 3), Component=0))


class Empty(unittest.TestCase):
    """What empty cells count as."""

    def expected(self, values, rule):
        valid = values[~hole(values.shape)].astype(float)
        return {0: 0.0, 1: math.fsum(valid) / valid.size, 2: valid.min(), 3: rule.get("EmptyValue")}[
            rule["EmptyCells"]]

    def test_is_the_density_there(self):
        for shape in SHAPES:
            values = values_of(shape)
            for rule in RULES:
                with self.subTest(shape=shape, **rule):
                    filled = image_of(in_hole(values, self.expected(values, rule)))
                    data, _ = blanked(values)
                    self.assertEqual(mapped(data, **rule), mapped(filled))

    def test_outside_of_a_mesh(self):
        """A uniform density on a part of its box, no lattice: the mean makes it uniform everywhere."""
        for is_line in (False, True):
            data = vtkPolyData()
            points, cells = vtkPoints(), vtkCellArray()
            cells.InsertNextCell(41 if is_line else 40)
            for i in range(40):
                angle = 2 * math.pi * i / 40
                cells.InsertCellPoint(points.InsertNextPoint(3 * math.cos(angle), 2 * math.sin(angle), 0))
            if is_line:
                cells.InsertCellPoint(0)
            data.SetPoints(points)
            (data.SetLines if is_line else data.SetPolys)(cells)
            array = numpy_to_vtk(np.array([3.0]), deep=1)
            array.SetName("Density")
            data.GetCellData().SetScalars(array)
            with self.subTest(is_line=is_line):
                self.check_outside(data)

    def check_outside(self, data):
        """Of an ellipse of 40 points, with a density of 3."""
        _, output = run(rt.vtkTransportMap(), data, DensityResolution=50)
        uniform = density_image([n - 1 for n in output.GetDimensions()[:2]], values=np.full(
            output.GetNumberOfCells(), 3.0))
        uniform.SetOrigin(output.GetOrigin())
        uniform.SetSpacing(output.GetSpacing())
        moves = [vtk_to_numpy(run(warper(data), density, EmptyCells=rule, DensityResolution=50)[1]
                              .GetPointData().GetArray("Displacement"))
                 for density, rule in ((uniform, 0), (data, 0), (data, 1), (data, 2))]
        self.assertGreater(np.abs(moves[1] - moves[0]).max(), 0.1)
        for found in moves[2:]:
            self.assertLess(np.abs(found - moves[0]).max(), 1e-9)
        mass = {rule: run(rt.vtkTransportMap(), data, EmptyCells=rule, DensityResolution=50)[1]
                .GetFieldData().GetArray("TotalMass").GetValue(0) for rule in (0, 1)}
        self.assertAlmostEqual(mass[0], 3 * 20 * 6 * math.sin(2 * math.pi / 40), 5)
        self.assertAlmostEqual(mass[1], 3 * 6 * 4, 1)

    def test_margin(self):
        """Cells of the same size around the box, on every axis, also of a density without gaps."""
        for shape, around in (((12,), (3,)), ((12, 10), (10, 3))):
            values = values_of(shape)
            for gaps in (True, False):
                data = blanked(values)[0] if gaps else image_of(values)
                longest = max(n * s for n, s in zip(shape, data.GetSpacing()))
                self.assertEqual(around, tuple(math.ceil(0.25 * longest / space)
                                               for _, space in zip(shape, data.GetSpacing())))
                grown = np.full([n + 2 * cells for n, cells in zip(shape, around)], math.nan)
                inner = tuple(slice(cells, cells + n) for n, cells in zip(shape, around))
                grown[inner] = in_hole(values, math.nan) if gaps else values
                larger = image_of(grown)
                extent = list(larger.GetExtent())
                for axis, cells in enumerate(around):
                    extent[2 * axis] -= cells
                    extent[2 * axis + 1] -= cells
                larger.SetExtent(extent)
                for rule in RULES:
                    for tables in (1, 2) if len(shape) > 1 else (1,):
                        with self.subTest(shape=shape, gaps=gaps, tables=tables, **rule):
                            common = dict(Tables=tables, NumberOfSteps=32, **rule)
                            warped = warped_in(larger)
                            self.assertEqual(warped(data, Margin=0.25, **common),
                                             warped(larger, NaNValues=1, **common))

    def test_defaults(self):
        """The warp takes the mean, the map nothing."""
        values = values_of((12, 10))
        data, _ = blanked(values)
        warped = warped_in(data)
        self.assertEqual(warped(data), warped(data, EmptyCells=1))
        self.assertNotEqual(warped(data), warped(data, EmptyCells=0))
        self.assertEqual(mapped(data), mapped(data, EmptyCells=0))
        self.assertNotEqual(mapped(data), mapped(data, EmptyCells=1))

    def test_tables_are_made_again(self):
        """For each property, and not for those that change nothing."""
        data, _ = below_range(values_of((12, 10)))
        warp = warper(data)
        _, output = run(warp, data, ValidRange=(0, 1e299))
        for name, value in (("ValidRange", (1.5, 1e299)), ("EmptyCells", 2), ("EmptyCells", 3),
                            ("EmptyValue", 2.0), ("Margin", 0.1), ("Margin", 0.3), ("EmptyCells", 0),
                            ("ValidRange", (0, 20))):
            with self.subTest(**{name: value}):
                before, built = positions(output), warp.GetTableBuildTime()
                set_property(warp, name, value)
                warp.Update()
                self.assertGreater(warp.GetTableBuildTime(), built)
                self.assertFalse(np.array_equal(positions(output), before))
        built = warp.GetTableBuildTime()
        warp.SetEmptyValue(5)  # of no use with Zero
        warp.SetNaNValuesToEmpty()
        warp.SetNaNValuesToError()
        warp.Update()
        self.assertEqual(warp.GetTableBuildTime(), built)

    def test_threads(self):
        """What empty cells count as has the same bits on one thread and on several."""
        data, _ = blanked(values_of((400, 300)))
        for rule in RULES[1:3]:
            self.assertEqual(mapped(data, Threading=3, NumberOfSteps=4, **rule),
                             mapped(data, Threading=2, NumberOfSteps=4, **rule))

    def test_tables_are_shared(self):
        """Without empty cells, a warp and a map read one density, whatever empty cells count as."""
        data = image_of(values_of((12, 10)))
        warp, transport = warper(data), rt.vtkTransportMap()
        run(warp, data, EmptyCells=1)
        run(transport, data, EmptyCells=0)
        self.assertEqual(transport.GetTableBuildTime(), warp.GetTableBuildTime())
        run(warp, data, Margin=0.1)
        self.assertGreater(warp.GetTableBuildTime(), transport.GetTableBuildTime())

    def test_several_densities(self):
        """Of each input of a morph and a barycenter, and of the other filters' densities."""
        one, own = below_range(values_of((12, 10)))
        two, _ = below_range(values_of((12, 10), seed=7))
        hidden = [blanked(values_of((12, 10), seed=seed))[0] for seed in (0, 7)]
        found = []
        for (first, second), properties in (((one, two), own), (hidden, {})):
            morph = rt.vtkTransportInterpolator()
            morph.SetInputData(0, first)
            morph.SetInputData(1, second)
            mean = rt.vtkTransportBarycenter()
            mean.AddInputDataObject(0, first)
            mean.AddInputDataObject(0, second)
            quality = rt.vtkTransportQuality()
            relaxed = rt.vtkBlueNoiseRelaxation()
            cells = rt.vtkEqualMassCells()
            cells.SetMeasureToDensity()
            cells.SetResolution(30)
            for filter_ in (quality, relaxed, cells):
                filter_.SetInputData(0, points_in(one, 12))
                filter_.SetInputData(1, first)
            for filter_ in (morph, mean, quality, relaxed, cells):
                for name, value in properties.items():
                    set_property(filter_, name, value)
                reported = Listener(filter_)
                filter_.Update()
                self.assertEqual(reported.errors, [])
                output = filter_.GetOutputDataObject(0)
                self.assertGreater(size_of(output), 0)
                found.append([output.GetRow(0).GetValue(i).ToDouble() for i in
                              range(output.GetNumberOfColumns())] if output.IsA("vtkTable") else
                             [hashed(vtk_to_numpy(output.GetAttributes(owner).GetArray(i)))
                              for owner in (0, 1)
                              for i in range(output.GetAttributes(owner).GetNumberOfArrays())])
        self.assertEqual(found[:5], found[5:])


class Errors(unittest.TestCase):
    def assert_error(self, text, data=None, **properties):
        data = data or image_of(values_of((12, 10)))
        reported, output = run(warper(data), data, **properties)
        self.assertTrue(reported.errors)  # of the filter, and of VTK's executive
        self.assertIn(text, reported.errors[0])
        self.assertEqual(size_of(output), 0)

    def test_properties(self):
        for text, properties in (
                ("ValidRange is 5 to 1; it must be two numbers of which the first is at most the second",
                 dict(ValidRange=(5, 1))),
                ("ValidRange is nan to 1; it must", dict(ValidRange=(math.nan, 1))),
                ("ValidRange is 0 to nan; it must", dict(ValidRange=(0, math.nan))),
                ("NaNValues is 2; it must be 0 (Error) or 1 (Empty)", dict(NaNValues=2)),
                ("EmptyCells is 4; it must be 0 (Zero), 1 (Mean), 2 (Minimum) or 3 (Value)",
                 dict(EmptyCells=4)),
                ("EmptyValue is -1; it must be finite and at least 0", dict(EmptyValue=-1)),
                ("EmptyValue is inf; it must", dict(EmptyValue=math.inf)),
                ("Margin is -0.1; it must be from 0 to 10", dict(Margin=-0.1)),
                ("Margin is nan; it must", dict(Margin=math.nan))):
            with self.subTest(**properties):
                self.assert_error(text, **properties)

    def test_advice(self):
        """What a message says helps."""
        values = values_of((12, 10))
        data, own = with_nan(values)
        self.assert_error("has %d values that are NaN or infinite; NaNValues = Empty takes NaN as empty "
                          "cells (the first at index 26)" % hole(values.shape).sum(), data)
        self.assert_error("(the first at index 26)", data, Margin=0.5)
        run(warper(data), data, **own)
        data = image_of(in_hole(values, math.inf))
        self.assert_error("values that are infinite; finite ends of ValidRange take them as empty cells",
                          data, NaNValues=1)
        self.assertEqual(mapped(data, ValidRange=(0, 1e6)), mapped(blanked(values)[0]))

    def test_negative(self):
        """Valid values alone count."""
        data = image_of(in_hole(values_of((12, 10)), FILL))
        self.assert_error("has %d negative values" % hole((12, 10)).sum(), data)
        data.GetCellData().GetScalars().SetValue(0, -1)
        self.assert_error("has 1 negative value; NegativeValues = Clamp takes them as 0", data,
                          ValidRange=(-10, 1e299))

    def test_nothing_left(self):
        self.assert_error("has a total mass of zero (empty cells carry none); at least one value must",
                          ValidRange=(1000, 2000))
        mesh, _ = mesh_without(values_of((12, 10)))
        self.assert_error("has a total mass of zero", mesh, ValidRange=(1000, 2000))

    def test_open_ends(self):
        """An end of 1e299 is no bound: larger values are read."""
        data = image_of(values_of((12, 10)) * 1e300)
        self.assertEqual(len(mapped(data)), 4)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Errors that say what to do: each is provoked, and what it says is done with ParaView's filters as they are
put first. The filter then has a result."""
import unittest

import numpy as np
from rt_filters import of_kind
from rt_testing import Listener, density_image, load_plugin, main, output_of, producer, size_of

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkImageData,
                                           vtkMultiBlockDataSet, vtkPolyData)
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricMobius, vtkParametricTorus
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource

simple = load_plugin()


class Advice:
    """An input, the error of a filter on it, and what that says to do: follow(input, filter) returns
    the input to use instead, or changes the filter and returns None."""

    def __init__(self, filters, make, message, follow, **settings):
        self.filters = filters
        self.make = make
        self.message = message
        self.follow = follow
        self.settings = settings or {"Resolution": 32}


def polygons(points, cells):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    for point in points:
        data.GetPoints().InsertNextPoint(point)
    data.SetPolys(vtkCellArray())
    for cell in cells:
        data.GetPolys().InsertNextCell(len(cell), cell)
    return data


def parametric(function):
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(function)
    source.Update()
    return producer(simple, source.GetOutput())


def with_gap(mark):
    """A density with a mark in two cells."""
    values = 1 + np.arange(120.0) % 7
    values[40:42] = mark
    return producer(simple, density_image((12, 10), values=values))


def set_on(made, **properties):
    for name, value in properties.items():
        setattr(made, name, value)


def grid_in_block():
    blocks = vtkMultiBlockDataSet()
    image = vtkImageData()
    image.SetDimensions(5, 4, 1)
    blocks.SetBlock(0, image)
    return producer(simple, blocks)


def torus_with_a_window():
    """A torus without two of its triangles."""
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(vtkParametricTorus())
    source.GenerateTextureCoordinatesOff()
    source.Update()
    data = source.GetOutput()
    data.BuildLinks()
    for cell in 200, 201:
        data.DeleteCell(cell)
    data.RemoveDeletedCells()
    return producer(simple, data)


def clip(source, **properties):
    made = simple.Clip(Input=source)
    for name, value in properties.items():
        setattr(made.ClipType, name, value)
    return made


def outline_of_sphere():
    """The segments that a plane cuts out of a sphere, with an array of points."""
    cut = simple.Slice(Input=simple.Elevation(Input=simple.Sphere(), LowPoint=[-1, -1, -1]))
    cut.SliceType.Normal = [0, 0, 1]
    return cut


def move_apart(source, _filter):
    data = source.GetClientSideObject().GetOutputDataObject(0)
    moved = polygons([(i, i * i, 0) for i in range(data.GetNumberOfPoints())], [(0, 1, 2), (0, 2, 3)])
    return producer(simple, moved)


# Two squares that have a corner in common, and a way around it from one to the other.
TOUCHING = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 1, 0), (2, 2, 0), (1, 2, 0), (3, -1, 0),
            (4, 2, 0)]
TOUCHING_CELLS = [(0, 1, 2, 3), (2, 4, 5, 6), (1, 0, 7), (1, 7, 8, 4), (4, 8, 5)]

OF_DISKS = {filter_.name: filter_.of_disks for filter_, _ in of_kind("disk")}
SURFACES = tuple(OF_DISKS)

TABLE = [
    Advice(SURFACES, simple.Sphere, "cut it open, for example with Clip",
           lambda source, _: clip(source)),
    Advice(SURFACES, simple.Box, "cut it open, for example with Clip",
           lambda source, _: clip(source)),
    Advice(SURFACES, lambda: simple.Cylinder(Capping=0),
           "2 boundary loops; it must have one: cut it open between them, for example with Clip",
           lambda source, _: clip(source)),
    Advice(SURFACES, simple.Disk,
           "2 boundary loops; it must have one: cut it open between them, for example with Clip",
           lambda source, _: clip(source)),
    Advice(SURFACES, torus_with_a_window,
           "1 handle, as a torus has one; cut it open, for example with Clip, more than once where needed",
           lambda source, _: clip(clip(source), Normal=[0, 0, 1])),
    Advice(SURFACES, lambda: parametric(vtkParametricMobius()),
           "one side only, as a Moebius strip; cut it open, for example with Clip",
           lambda source, _: clip(source)),
    Advice(SURFACES, lambda: simple.AppendGeometry(Input=[simple.Plane(), simple.Plane(
        Origin=[2, 0, 0], Point1=[5, 0, 0], Point2=[2, 1, 0], XResolution=3)]),
           "2 components that no edges join; it must be one: extract the largest with Connectivity "
           "(Extraction Mode: Extract Largest Region)",
           lambda source, _: simple.Connectivity(
               Input=source, ExtractionMode="Extract Largest Region")),
    Advice(SURFACES, lambda: producer(simple, polygons(
        [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])),
           "3 points on its boundary; it must have at least 4, one for each corner of the square: "
           "Subdivide adds some",
           lambda source, _: simple.Subdivide(Input=source)),
    Advice(SURFACES, lambda: producer(simple, polygons(
        [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)], [(0, 1, 2), (0, 2, 3)])),
           "2 triangles without area, the first is triangle 0; move their points apart", move_apart),
    Advice(SURFACES, lambda: producer(simple, polygons(TOUCHING, TOUCHING_CELLS)),
           "1 point where parts of it touch that no edges join, the first is point 2; each part needs "
           "a point of its own there",
           lambda source, _: producer(simple, polygons(
               TOUCHING + [TOUCHING[2]], [TOUCHING_CELLS[0], (9, 4, 5, 6)] + TOUCHING_CELLS[2:]))),
    Advice(SURFACES, lambda: producer(simple, polygons(
        [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2, 3)])),
           "polygons must be simple: edges must not cross",
           lambda source, _: producer(simple, polygons(
               [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)], [(0, 2, 1, 3)]))),
    Advice(SURFACES, grid_in_block,
           "it must be a vtkPolyData or a grid, or what Extract Surface makes of it",
           lambda source, _: simple.ExtractSurface(Input=source)),
    Advice(("SampleDensity",), outline_of_sphere,
           "closed ones in a plane, around regions (Triangle Strips joins the segments of a slice)",
           lambda source, _: simple.TriangleStrips(Input=source),
           DensityArray=["POINTS", "Elevation"]),
    Advice(("SampleDensity", "TransportMap"), lambda: with_gap(np.nan),
           "NaN or infinite; NaNValues = Empty takes NaN as empty cells",
           lambda _, made: set_on(made, NaNValues="Empty"), DensityArray=["CELLS", "Density"]),
    Advice(("SampleDensity", "TransportMap"), lambda: with_gap(-np.inf),
           "NaN or infinite; NaNValues = Empty takes NaN as empty cells",
           lambda _, made: set_on(made, NaNValues="Empty", ValidRange=[0, 1e9]),
           DensityArray=["CELLS", "Density"]),
    Advice(("SampleDensity", "TransportMap"), lambda: with_gap(-9999),
           "NegativeValues = Clamp takes them as 0, ValidRange as missing",
           lambda _, made: set_on(made, ValidRange=[0, 1e299]), DensityArray=["CELLS", "Density"]),
]


class FollowingAdvice(unittest.TestCase):
    def test_table(self):
        for advice in TABLE:
            for name in advice.filters:
                with self.subTest(filter=name, message=advice.message):
                    source = advice.make()
                    source.UpdatePipeline()
                    made = getattr(simple, name)(
                        Input=source, **OF_DISKS.get(name, {}), **advice.settings)
                    reported = Listener(made.GetClientSideObject())
                    self.assertEqual(size_of(output_of(made)), 0)
                    self.assertIn(advice.message, reported.errors[0])
                    instead = advice.follow(source, made)
                    if instead is not None:
                        made.Input = instead
                    reported = Listener(made.GetClientSideObject())
                    self.assertGreater(size_of(output_of(made)), 0, reported.errors)
                    self.assertEqual(reported.errors, [])


    def test_steps(self):
        """A density of one high cell, which Euler does not resolve, nor Multistep in tiles."""
        image = density_image((128, 128), values=np.ones(128 ** 2))
        image.GetCellData().GetScalars().SetValue(64 * 128 + 42, 1e5)
        source = producer(simple, image)
        flat = simple.Calculator(Input=source, AttributeType="Cell Data", Function="Density + 100",
                                 ResultArrayName="Density")
        cases = (({"Integrator": "Euler", "AreaTolerance": 0.05},
                  "(Integrator Multistep needs fewer)", {"Integrator": "Multistep"}),
                 ({"Tables": "Tiled", "AreaTolerance": 0.01},
                  "a part of the mean added with Calculator", {"Input": flat}))
        for settings, words, cure in cases:
            with self.subTest(**settings):
                made = simple.TransportMap(Input=source, DensityArray=["CELLS", "Density"],
                                           Direction="DensityToUniform", **settings)
                reported = Listener(made.GetClientSideObject())
                steps = output_of(made).GetFieldData().GetArray("StepsTaken").GetValue(0)
                warned = [line for line in reported.warnings if "AreaTolerance" in line]
                self.assertEqual((steps, len(warned)), (4096, 1), reported.warnings)
                self.assertIn("is not reached: with 4096 steps", warned[0])
                self.assertIn(words, warned[0])
                for name, value in cure.items():
                    setattr(made, name, value)
                reported = Listener(made.GetClientSideObject())
                found = output_of(made).GetFieldData().GetArray("AreaErrorEstimate").GetValue(0)
                self.assertLessEqual(found, settings["AreaTolerance"])
                self.assertEqual([line for line in reported.warnings if "AreaTolerance" in line], [])


if __name__ == "__main__":
    main()

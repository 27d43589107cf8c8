# SPDX-License-Identifier: BSD-3-Clause
"""What the cases share: their list, small inputs, and what a filter makes of them."""
import numpy as np
from rt_testing import Listener, load_plugin, producer
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkImageData, vtkMultiBlockDataSet,
                                           vtkPolyData, vtkUnstructuredGrid)

CASES = {}
simple = load_plugin()


def case(number):
    """Adds a function to the cases. It gets a unittest.TestCase to check with."""
    def add(function):
        assert number not in CASES, number
        CASES[number] = function
        return function
    return add


class Result:
    """What a filter made of its inputs: its outputs, its own errors and its warnings."""

    def __init__(self, filter_):
        algorithm = filter_.GetClientSideObject()
        listener = Listener(algorithm)
        try:
            filter_.UpdatePipeline()
        except RuntimeError:
            pass  # newer versions of ParaView raise what the listener has got
        self.errors = [text for text in listener.errors if "returned failure" not in text]
        self.warnings = listener.warnings
        self.data = algorithm.GetOutputDataObject(0)
        self.algorithm = algorithm

    def field(self, name):
        array = self.data.GetFieldData().GetArray(name)
        return array.GetTuple1(0) if array else float("nan")

    def places(self):
        if not self.data.GetNumberOfPoints():
            return np.zeros((0, 3))
        return vtk_to_numpy(self.data.GetPoints().GetData()).astype(float)

    def values(self, name, cells=False):
        data = self.data.GetCellData() if cells else self.data.GetPointData()
        return vtk_to_numpy(data.GetArray(name))


def source(data):
    """A source of ParaView of a data object."""
    return data if hasattr(data, "SMProxy") else producer(simple, data)


def sample(data, array="v", cells=True, count=1000, **properties):
    """Sample Density of an array of some data."""
    return Result(simple.SampleDensity(
        source(data), DensityArray=["CELLS" if cells else "POINTS", array],
        NumberOfParticles=count, **properties))


def expect_mass(check, data, mass, tolerance=1e-9, **options):
    """The mass of a density, whose particles share it; the result."""
    result = sample(data, **options)
    check.assertEqual(result.errors, [])
    check.assertLess(abs(result.field("TotalMass") / mass - 1), tolerance,
                     f"TotalMass {result.field('TotalMass')!r}, right {mass!r}")
    check.assertAlmostEqual(result.values("Mass").sum() / result.field("TotalMass"), 1, 9)
    return result


def expect_error(check, result, *parts):
    """One error with all parts in it, and nothing in the output."""
    check.assertEqual(len(result.errors), 1, result.errors)
    for part in parts:
        check.assertIn(part, result.errors[0])
    check.assertEqual(result.data.GetNumberOfPoints(), 0)


def named(values, name="v"):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
    array.SetName(name)
    return array


def image(values, cells=True, spacing=(1, 1, 1), origin=(0, 0, 0), direction=None, name="v"):
    """An image of an array [z, y, x] or [y, x], whose last axis may be components."""
    values = np.asarray(values)
    components = values.shape[3] if values.ndim == 4 else 1
    flat = values.ndim == 2
    shape = ((1,) + values.shape if flat else values.shape)[:3]
    grown = [1 if cells and not (flat and axis == 0) else 0 for axis in range(3)]
    data = vtkImageData()
    data.SetDimensions(*[count + more for count, more in zip(shape, grown)][::-1])
    data.SetSpacing(*spacing)
    data.SetOrigin(*origin)
    if direction is not None:
        data.SetDirectionMatrix(*np.asarray(direction, float).ravel())
    array = named(values.reshape(-1, components) if components > 1 else values.ravel(), name)
    (data.GetCellData() if cells else data.GetPointData()).SetScalars(array)
    return data


def point_list(places):
    places = np.asarray(places)
    if places.shape[1] == 2:
        places = np.c_[places, np.zeros(len(places), places.dtype)]
    if places.dtype != np.float32:
        places = places.astype(float)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places), deep=1))
    return points


def cell_list(cells):
    array = vtkCellArray()
    for cell in cells:
        array.InsertNextCell(len(cell))
        for point in cell:
            array.InsertCellPoint(int(point))
    return array


def polygons(places, cells, values=None, lines=False):
    """A vtkPolyData of polygons, or lines, with values on cells."""
    data = vtkPolyData()
    data.SetPoints(point_list(places))
    (data.SetLines if lines else data.SetPolys)(cell_list(cells))
    if values is not None:
        data.GetCellData().SetScalars(named(np.asarray(values, float)))
    return data


def rings(*outlines, values=None):
    """One polygon an outline, each with points of its own."""
    starts = np.cumsum([0] + [len(outline) for outline in outlines])
    cells = [range(a, b) for a, b in zip(starts, starts[1:])]
    return polygons(np.concatenate([np.asarray(outline, float) for outline in outlines]), cells,
                    np.ones(len(outlines)) if values is None else values)


def mesh(places, cells, values):
    """A vtkUnstructuredGrid of (type, point ids) with values on cells."""
    data = vtkUnstructuredGrid()
    data.SetPoints(point_list(places))
    data.Allocate(len(cells))
    for kind, ids in cells:
        data.InsertNextCell(kind, len(ids), list(ids))
    data.GetCellData().SetScalars(named(np.asarray(values, float)))
    return data


def blocks(*data):
    result = vtkMultiBlockDataSet()
    for i, block in enumerate(data):
        result.SetBlock(i, block)
    return result


def cloud(places, **arrays):
    """A vtkPolyData of points alone, with arrays."""
    data = vtkPolyData()
    data.SetPoints(point_list(places))
    for name, values in arrays.items():
        data.GetPointData().AddArray(named(values, name))
    return data


BOX_FACES = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2],
                      [1, 3, 7, 5]])


def box_points(low, high):
    """The corners of a box, x fastest: the faces in BOX_FACES turn outwards."""
    return np.array([[(low, high)[i & 1][0], (low, high)[i >> 1 & 1][1], (low, high)[i >> 2][2]]
                     for i in range(8)], float)


def triangles_of(faces):
    """Two triangles for each quadrangle."""
    faces = np.asarray(faces)
    return np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])

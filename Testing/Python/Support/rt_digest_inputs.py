# SPDX-License-Identifier: BSD-3-Clause
"""Inputs of the runs of TestDigests.py: of integers, alike on every machine."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData

TURN = (0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1)


def values(shape, seed):
    """A landscape of integers with empty places, alike on every machine."""
    i = np.indices(shape[::-1]).reshape(len(shape), -1).astype(np.int64) + seed
    waves = sum((index * index * (3 + seed + axis)) % 97 for axis, index in enumerate(i))
    return np.where(waves % 11 == 0, 0, waves)


def image(shape=(61, 47), seed=0, cells=True, spacing=(0.5, 0.75, 1.25), origin=(1, 2, 3),
          dtype=np.float64, direction=None, array=None):
    data = vtkImageData()
    data.SetDimensions([n + 1 if cells else n for n in shape] + [1] * (3 - len(shape)))
    data.SetSpacing(spacing)
    data.SetOrigin(origin)
    if direction:
        data.SetDirectionMatrix(*direction)
    numbers = values(shape, seed).astype(dtype) if array is None else array
    scalars = numpy_to_vtk(np.ascontiguousarray(numbers), deep=1)
    scalars.SetName("Values")
    (data.GetCellData() if cells else data.GetPointData()).SetScalars(scalars)
    return data


def colours(components, shape=(40, 30), dtype=np.uint8):
    parts = [values(shape, seed) * 2 for seed in range(components)]
    return image(shape, array=np.stack(parts, axis=1).astype(dtype), cells=False)


def with_ghosts(data, cells=True):
    count = data.GetNumberOfCells() if cells else data.GetNumberOfPoints()
    flags = np.where(np.arange(count) % 7 == 3, 1, 0).astype(np.uint8)
    ghosts = numpy_to_vtk(flags, deep=1)
    ghosts.SetName("vtkGhostType")
    (data.GetCellData() if cells else data.GetPointData()).AddArray(ghosts)
    return data


def points_in(data, count=500, seed=3, dtype=np.float64):
    low, high = np.array(data.GetBounds()).reshape(3, 2).T
    i = np.arange(1, count + 1)[:, None]
    unit = (i * np.array([[7919, 104729, 1299709]]) * (seed + 1) % 65536) / 65536
    points = vtkPoints()
    points.SetData(numpy_to_vtk((low + (high - low) * (1.1 * unit - 0.05)).astype(dtype), deep=1))
    found = vtkPolyData()
    found.SetPoints(points)
    masses = numpy_to_vtk((1 + i[:, 0] % 5).astype(np.float32), deep=1)
    masses.SetName("Mass")
    found.GetPointData().AddArray(masses)
    return found


def box_of_triangles(turned=False):
    corners = np.array([[x, y, z] for z in (0, 1.5) for y in (0, 1) for x in (0, 2.25)])
    faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7),
             (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
    if turned:  # some of them are to be turned back
        faces = [face[::-1] if k % 3 == 0 else face for k, face in enumerate(faces)]
    points = vtkPoints()
    points.SetData(numpy_to_vtk(corners @ np.array([[0.96, 0.28, 0], [-0.28, 0.96, 0], [0, 0.6, 1]]),
                                deep=1))
    polygons = vtkCellArray()
    for face in faces:
        polygons.InsertNextCell(3)
        for corner in face:
            polygons.InsertCellPoint(corner)
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    return surface


def sheet(columns=24, rows=17, quads=False):
    """Hills over a rectangle, as triangles or as polygons of four points."""
    x, y = np.meshgrid(np.arange(columns + 1), np.arange(rows + 1))
    heights = ((3 * x * x + 5 * y * y + x * y) % 37) / 32 + (x - 10) * (y - 8) / 64
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.stack([x, y, heights], axis=-1).reshape(-1, 3), deep=1))
    polygons = vtkCellArray()
    for j in range(rows):
        for i in range(columns):
            a, b = i + j * (columns + 1), i + (j + 1) * (columns + 1)
            for face in [(a, a + 1, b + 1, b)] if quads else [(a, a + 1, b + 1), (a, b + 1, b)]:
                polygons.InsertNextCell(len(face))
                for corner in face:
                    polygons.InsertCellPoint(corner)
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(polygons)
    return surface

# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of numpy as VTK's images and points, and back, without copies where VTK needs none."""
from typing import Sequence, Union

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_SIGNED_CHAR
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkDataSetAttributes, vtkImageData,
                                           vtkPolyData)

from ._numbers import all_numbers, numbers_and_gaps

Numbers = Union[float, Sequence[float]]  # one for all axes, or one for each of x, y(, z)


def vtk_array(array, name):
    """The vtkDataArray on the memory of an array of numbers or of rows."""
    made = numpy_to_vtk(array, array_type=VTK_SIGNED_CHAR if array.dtype == np.int8 else None)
    made.SetName(name)
    return made


def along_axes(values, name, axes, positive=False):
    """A number for each of x, y and z; one alone is that of all."""
    numbers = np.asarray(None if np.ma.is_masked(values) else values)
    if numbers.dtype.kind not in "iuf" or numbers.shape not in ((), (axes,)):
        raise ValueError("%s is %r; it must be a number, or %d in the order %s"
                         % (name, values, axes, ", ".join("xyz"[:axes])))
    if not np.isfinite(numbers).all() or (positive and (numbers <= 0).any()):
        raise ValueError("%s is %r; it must be finite%s"
                         % (name, values, " and above 0" if positive else ""))
    made = np.full(3, 1.0 if positive else 0.0)
    made[:axes] = numbers
    return made


def image_of(values, name, spacing=1.0, origin=0.0, colours=False, grown_to=None):
    """The vtkImageData whose points have the values; those of missing ones are hidden. Returns the
    image and the shape of its axes, grown by zeros to the one that is given."""
    array, gaps = numbers_and_gaps(values, name)
    if grown_to not in (None, array.shape):
        ends = [(0, end - own) for own, end in zip(array.shape, grown_to)]
        array, gaps = np.pad(array, ends), None if gaps is None else np.pad(gaps, ends)
    shape, rows = array.shape, array.reshape(-1)
    if colours and array.ndim == 3:
        shape, rows = array.shape[:2], array.reshape(-1, array.shape[2] or 1)
        gaps = None if gaps is None else gaps.any(axis=2)
    if array.ndim not in (2, 3):
        raise ValueError("%s has the shape %s; it must have two axes, [y, x], or three, [z, y, x]"
                         % (name, array.shape))
    if array.size == 0:
        raise ValueError("%s has no values: its shape is %s" % (name, array.shape))
    image = vtkImageData()
    image.SetDimensions(*shape[::-1], *[1] * (3 - len(shape)))
    image.SetSpacing(*along_axes(spacing, "spacing", len(shape), positive=True))
    image.SetOrigin(*along_axes(origin, "origin", len(shape)))
    image.GetPointData().SetScalars(vtk_array(rows, name))
    if gaps is not None:
        hidden = np.where(gaps.reshape(-1), vtkDataSetAttributes.HIDDENPOINT, 0).astype(np.uint8)
        image.GetPointData().AddArray(vtk_array(hidden, vtkDataSetAttributes.GhostArrayName()))
    return image, shape


def point_set(points, name, axes, why="as the density has %d axes"):
    """The vtkPolyData of points given as rows of x and y or of x, y and z."""
    array = all_numbers(points, name)
    if array.ndim != 2 or array.shape[1] != axes:
        raise ValueError("%s has the shape %s; it must be (number of points, %d), %s"
                         % (name, array.shape, axes, why.replace("%d", str(axes))))
    if array.dtype.kind != "f" or axes < 3:
        rows = np.zeros((len(array), 3))
        rows[:, :axes] = array
        array = rows
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(vtk_array(array, name))
    return data


def surface_of(points, triangles):
    """The vtkPolyData of triangles, given as rows of three numbers of points."""
    data = point_set(points, "points", 3, "rows of x, y and z")
    rows = all_numbers(triangles, "triangles")
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise ValueError("triangles has the shape %s; it must be (number of triangles, 3), rows of "
                         "numbers of points" % (rows.shape,))
    if rows.dtype.kind not in "iu":
        raise TypeError("triangles has values of type %s; they must be integers, the numbers of points"
                        % rows.dtype)
    wrong = np.argwhere((rows < 0) | (rows >= data.GetNumberOfPoints()))
    if len(wrong):
        raise ValueError("triangles[%d, %d] is %d; there are %d points, numbered from 0"
                         % (*wrong[0], rows[tuple(wrong[0])], data.GetNumberOfPoints()))
    cells = vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(ids.astype(np.int64), deep=1)
                    for ids in (np.arange(0, rows.size + 1, 3), rows.reshape(-1))))
    data.SetPolys(cells)
    return data


def positions_of(data, axes):
    """The points of a vtkPointSet as rows of as many coordinates as axes; not a copy."""
    return vtk_to_numpy(data.GetPoints().GetData())[:, :axes]


def point_values_of(image, name, axes):
    """An array of an image's points, on [y, x] or [z, y, x]; vectors are along the last axis. Not a
    copy."""
    values = vtk_to_numpy(image.GetPointData().GetArray(name))
    shape = image.GetDimensions()[axes - 1::-1]
    return values.reshape(shape) if values.ndim == 1 else values.reshape(*shape, -1)[..., :axes]


def cell_values_of(image, name, axes):
    """An array of an image's cells, on [y, x] or [z, y, x]; not a copy."""
    shape = [max(number - 1, 1) for number in image.GetDimensions()[axes - 1::-1]]
    return vtk_to_numpy(image.GetCellData().GetArray(name)).reshape(shape)


def fields_of(data):
    """The field data that are numbers: a number alone as such, several as an array."""
    fields = data.GetFieldData()
    arrays = {fields.GetArrayName(i): fields.GetArray(i) for i in range(fields.GetNumberOfArrays())
              if fields.GetArray(i)}
    values = {name: vtk_to_numpy(array) for name, array in arrays.items()}
    return {name: value.item() if value.size == 1 else value for name, value in values.items()}

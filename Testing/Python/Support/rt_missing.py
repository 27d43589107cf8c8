# SPDX-License-Identifier: BSD-3-Clause
"""One density with missing data in many ways: each gives a data object and the properties that read it."""
import math

import numpy as np
from rt_testing import density_image
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import (vtkAMRBox, vtkDataSetAttributes, vtkImageData,
                                           vtkMultiBlockDataSet, vtkOverlappingAMR, vtkUniformGrid)
from vtkmodules.vtkFiltersCore import vtkThreshold

HIDDEN_CELL, HIDDEN_POINT = vtkDataSetAttributes.HIDDENCELL, vtkDataSetAttributes.HIDDENPOINT
SHAPES = ((12,), (12, 10), (8, 7, 6))
FILL = -9999


def hidden_points(shape):
    """Of an image of cells: some inside, in the numbers of the axes."""
    return [tuple(3 + step for _ in shape) for step in (0, 1)]


def hole(shape):
    """The cells around these points."""
    empty = np.zeros(shape, bool)
    for point in hidden_points(shape):
        empty[tuple(slice(i - 1, i + 1) for i in point)] = True
    return empty


def values_of(shape, dtype=float, seed=0):
    values = 1 + 30 * np.random.default_rng(seed).random(shape)
    return np.ceil(values).astype(dtype) if np.issubdtype(dtype, np.integer) else values.astype(dtype)


def flat(array):
    return np.ascontiguousarray(array.ravel(order="F"))


def image_of(values, cells=True):
    return density_image(values.shape, cells, values=flat(values))


def hide(data, flags, points=False):
    # The product of an enumerator and bytes is int64 with numpy 2, and no flags.
    array = numpy_to_vtk(flat(flags).astype(np.uint8), deep=1)
    array.SetName("vtkGhostType")
    (data.GetPointData() if points else data.GetCellData()).AddArray(array)
    return data


def in_hole(values, mark):
    marked = values.copy()
    marked[hole(values.shape)] = mark
    return marked


def blanked(values):
    return hide(image_of(in_hole(values, FILL)), HIDDEN_CELL * hole(values.shape).astype(np.uint8)), {}


def with_hidden_points(values):
    flags = np.zeros([n + 1 for n in values.shape], np.uint8)
    for point in hidden_points(values.shape):
        flags[point] = HIDDEN_POINT
    return hide(image_of(in_hole(values, FILL)), flags, True), {}


def with_nan(values):
    return image_of(in_hole(values, math.nan)), dict(NaNValues=1)


def below_range(values):
    return image_of(in_hole(values, FILL)), dict(ValidRange=(0, 1e299))


def above_range(values):
    return image_of(in_hole(values, 9999)), dict(ValidRange=(-1e299, 31))


def mesh_without(values):
    threshold = vtkThreshold()
    threshold.SetInputData(image_of(in_hole(values, FILL)))
    threshold.SetInputArrayToProcess(0, 0, 0, 1, "Density")
    threshold.SetThresholdFunction(vtkThreshold.THRESHOLD_UPPER)
    threshold.SetUpperThreshold(0.5)
    threshold.Update()
    return threshold.GetOutput(), {}


def mesh_of(marked, properties):
    """All cells as a mesh, with a mark in the hole."""
    threshold = vtkThreshold()
    threshold.SetInputData(image_of(marked))
    threshold.SetInputArrayToProcess(0, 0, 0, 1, "Density")
    threshold.SetThresholdFunction(vtkThreshold.THRESHOLD_UPPER)
    threshold.SetUpperThreshold(-1e9)
    threshold.SetInvert(False)
    threshold.Update()
    return threshold.GetOutput(), properties


def mesh_below_range(values):
    return mesh_of(in_hole(values, FILL), dict(ValidRange=(0, 1e299)))


def mesh_above_range(values):
    return mesh_of(in_hole(values, 9999), dict(ValidRange=(-1e299, 31)))


def uniform_grid(values):
    grid = vtkUniformGrid()
    grid.ShallowCopy(image_of(in_hole(values, FILL)))
    for cell in np.flatnonzero(flat(hole(values.shape))):
        grid.BlankCell(int(cell))
    return grid, {}


def two_blocks(values):
    """Of one lattice, NaN in the hole."""
    image, properties = with_nan(values)
    extent = list(image.GetExtent())
    blocks = vtkMultiBlockDataSet()
    for number, (low, high) in enumerate(((0, 3), (3, extent[1]))):
        part = vtkImageData()
        part.DeepCopy(image)
        part.Crop([low, high] + extent[2:])
        blocks.SetBlock(number, part)
    return blocks, properties


def refined_grids(values):
    """One grid of the coarsest level, with values out of range."""
    image, properties = below_range(values)
    amr = vtkOverlappingAMR()
    amr.Initialize(1, [1])
    amr.SetOrigin(image.GetOrigin())
    amr.SetGridDescription({1: 1, 2: 5, 3: 8}[len(values.shape)])
    amr.SetSpacing(0, image.GetSpacing())
    last = [n - 2 for n in image.GetDimensions()]
    amr.SetAMRBox(0, 0, vtkAMRBox([0, 0, 0], last))
    grid = vtkUniformGrid()
    grid.ShallowCopy(image)
    amr.SetDataSet(0, 0, grid)
    return amr, properties


WAYS = (blanked, with_hidden_points, with_nan, below_range, above_range, mesh_without, mesh_below_range,
        mesh_above_range, uniform_grid, two_blocks, refined_grids)
OF_INTEGERS = tuple(way for way in WAYS if way not in (with_nan, two_blocks))

# SPDX-License-Identifier: BSD-3-Clause
"""Small maps, and cartograms of them."""
import numpy as np
from rectifiedtransport import vtkCartogram
from rt_testing import Listener, positions
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkMultiBlockDataSet, vtkMultiPieceDataSet,
                                           vtkPolyData)


def square(low, high):
    return [(low, low), (high, low), (high, high), (low, high)]


def rectangle(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def map_of(rings, mass=None, lines=False, place=None, **arrays):
    """Regions of one ring each, each with points of its own. `lines`: whether they are closed lines, or "open"."""
    data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    for ring in rings:
        ids = [points.InsertNextPoint(*(place(*x) if place else (*x, 0.0))) for x in ring]
        ids += ids[:1] if lines and lines != "open" else []
        cells.InsertNextCell(len(ids))
        for i in ids:
            cells.InsertCellPoint(i)
    data.SetPoints(points)
    (data.SetLines if lines else data.SetPolys)(cells)
    if mass is not None:
        arrays = {"Mass": np.array(mass, float), **arrays}
    for name, values in arrays.items():
        if isinstance(values[0], str):
            array = vtkStringArray()
            for value in values:
                array.InsertNextValue(value)
        else:
            array = numpy_to_vtk(np.asarray(values), deep=1)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


def sixteen(heavy=20.0, numbers=range(16), **options):
    """Unit squares in four rows, or those with some numbers; number 5 is heavy."""
    rings = [rectangle(i % 4, i // 4, i % 4 + 1, i // 4 + 1) for i in numbers]
    return map_of(rings, [heavy if i == 5 else 1.0 for i in numbers], **options)


def blocks_of(*parts):
    blocks = vtkMultiBlockDataSet()
    for i, part in enumerate(parts):
        blocks.SetBlock(i, part)
    return blocks


def pieces_of(*parts):
    """One data set in pieces. As a block VTK 9.1 takes no other kind of partitioned data set."""
    whole = vtkMultiPieceDataSet()
    for i, part in enumerate(parts):
        whole.SetPartition(i, part)
    return whole


def ring_areas(data):
    """Of lines and polygons, in the order of the cells, signed in the plane of x and y."""
    places = positions(data)
    areas = []
    for cells in (data.GetLines(), data.GetPolys()):
        offsets = vtk_to_numpy(cells.GetOffsetsArray())
        ids = vtk_to_numpy(cells.GetConnectivityArray())
        for first, end in zip(offsets, offsets[1:]):
            x, y, _ = (places[ids[first:end]] - places[ids[first]]).T
            areas.append(0.5 * (np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))
    return np.array(areas)


def cartogram(data, overlay=None, regions=None, mass="Mass", **properties):
    algorithm = vtkCartogram()
    algorithm.SetInputDataObject(0, data)
    if overlay:
        algorithm.SetOverlayData(overlay)
    if mass:
        algorithm.SetInputArrayToProcess(0, 0, 0, 1, mass)
    if regions:
        algorithm.SetInputArrayToProcess(1, 0, 0, 1, regions)
    algorithm.SetResolution(128)
    for name, value in properties.items():
        getattr(algorithm, "Set" + name)(*([] if value is None else [value]))
    listener = Listener(algorithm)
    algorithm.Update()
    return algorithm, listener


def line_of(message):
    """What a filter says, without VTK's place and address."""
    return message.split("): ", 1)[1].strip()


def cell_values(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))

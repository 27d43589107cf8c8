# SPDX-License-Identifier: BSD-3-Clause
"""What a rank has of the outputs of filters: a digest of each element, by its place."""
import zlib

import numpy as np
from paraview import simple
from rt_testing import reads_appended_data
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkParallelCore import vtkMultiProcessController

GHOSTS = "vtkGhostType"
RANK = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
gathered = {}


REDISTRIBUTES = reads_appended_data()


def redistributed(Input):
    """On other ranks, where ParaView's own filter works; else where they are."""
    return simple.RedistributeDataSet(Input=Input) if REDISTRIBUTES else Input


def digests(data, owner):
    """Of each point or cell that is no ghost, by its first point and number of points."""
    attributes = data.GetAttributes(owner)
    arrays = [attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())]
    ghosts = [array for array in arrays if array.GetName() == GHOSTS]
    arrays = sorted((array for array in arrays if array.GetName() != GHOSTS),
                    key=lambda array: array.GetName())
    found = []
    if owner == vtkDataObject.CELL and not arrays:
        return found, []
    for i in range(data.GetNumberOfElements(owner)):
        if ghosts and vtk_to_numpy(ghosts[0])[i] & 1:
            continue
        places = [i] if owner == vtkDataObject.POINT else [
            data.GetCell(i).GetPointId(k) for k in range(data.GetCell(i).GetNumberOfPoints())]
        place = b"".join(np.array(data.GetPoint(k)).tobytes() for k in places)
        values = b"".join(np.array(array.GetTuple(i)).tobytes() for array in arrays)
        found.append((place, zlib.crc32(values)))
    return found, [(array.GetName(), array.GetNumberOfComponents()) for array in arrays]


def give(name, proxy, port=0, time=None):
    proxy.UpdatePipeline(*([] if time is None else [time]))
    data = proxy.GetClientSideObject().GetOutputDataObject(port)
    fields = {array.GetName(): array.GetTuple(0) for array in (
        data.GetFieldData().GetArray(i) for i in range(data.GetFieldData().GetNumberOfArrays()))}
    gathered[name] = {"fields": fields, "points": digests(data, vtkDataObject.POINT),
                      "cells": digests(data, vtkDataObject.CELL)}


def give_row(name, proxy):
    """Of a table of one row, as one point."""
    proxy.UpdatePipeline()
    table = proxy.GetClientSideObject().GetOutputDataObject(0)
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    row = {column.GetName(): column.GetTuple(0) for column in columns if table.GetNumberOfRows()}
    values = b"".join(np.array(row[column]).tobytes() for column in sorted(row))
    gathered[name] = {"fields": row, "points": ([(b"row", zlib.crc32(values))] if row else [], []),
                      "cells": ([], [])}


def give_both(name, proxy):
    give(name, proxy)
    give(name + " particles", proxy, 1)

# SPDX-License-Identifier: BSD-3-Clause
"""What a rank has of the outputs of filters: a digest of each element, by its place."""
import zlib

import numpy as np
from paraview import simple
from rt_testing import reads_appended_data
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (vtkAMRBox, vtkDataObject, vtkImageData,
                                           vtkMultiBlockDataSet, vtkOverlappingAMR, vtkUniformGrid)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController

GHOSTS = "vtkGhostType"
RANK = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
RANKS = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
gathered = {}


REDISTRIBUTES = reads_appended_data()


def with_ghosts(source, levels):
    """A source with levels of ghost cells, by the name that ParaView has for the filter."""
    made = simple.GhostCells if hasattr(simple, "GhostCells") else simple.GhostCellsGenerator
    return made(Input=source, BuildIfRequired=0, MinimumNumberOfGhosts=levels)


def redistributed(Input):
    """On other ranks, where ParaView's own filter works; else where they are."""
    return simple.RedistributeDataSet(Input=Input) if REDISTRIBUTES else Input


def given_here(data, whole=None):
    """A source of what this rank has, of an image with the whole extent."""
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    if whole:
        producer.GetClientSideObject().SetWholeExtent(whole)
    return producer


def turned(Input):
    """The image with a direction matrix: x to y, y to z, z to x, and y mirrored."""
    Input.UpdatePipeline()
    image = Input.GetClientSideObject().GetOutputDataObject(0)
    copy = image.NewInstance()
    copy.ShallowCopy(image)
    copy.SetDirectionMatrix(0, 0, 1, 1, 0, 0, 0, -1, 0)
    pipeline = Input.GetClientSideObject().GetOutputInformation(0)
    whole = pipeline.Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT())
    return given_here(copy, list(whole))


def tiles():
    """Blocks that tile an image of cells, four along x, each on one rank."""
    blocks = vtkMultiBlockDataSet()
    blocks.SetNumberOfBlocks(4)
    for i in range(4):
        if i % RANKS != RANK:
            continue
        image = vtkImageData()
        image.SetExtent(3 * i, 3 * i + 3, 0, 5, 0, 4)
        image.SetSpacing(0.5, 1, 2)
        x, y, z = np.meshgrid(range(3 * i, 3 * i + 3), range(5), range(4), indexing="ij")
        values = numpy_to_vtk((1.0 + (x + 2 * y + 3 * z) % 7).ravel(order="F"), deep=1)
        values.SetName("Density")
        image.GetCellData().SetScalars(values)
        blocks.SetBlock(i, image)
    return given_here(blocks)


def refined(flat):
    """Grids of two levels, each on one rank; as after a reader, with flags that know of no other rank."""
    counts = [2, 3]
    grids = vtkOverlappingAMR()
    grids.Initialize(2, counts)
    grids.SetOrigin([0, 0, 0])
    grids.SetGridDescription(5 if flat else 8)  # XY plane, volume
    depth = [0, -1] if flat else [0, 3]
    blocks = [(0, (0, 3), (0, 3)), (0, (4, 7), (0, 3)), (1, (4, 9), (2, 5)), (1, (10, 11), (0, 3)),
              (1, (0, 1), (6, 7))]
    for number, (level, x, y) in enumerate(blocks):
        step = 1.0 / (level + 1)
        grids.SetSpacing(level, [step] * 3)
        index = number - (0 if level == 0 else counts[0])
        grids.SetAMRBox(level, index, vtkAMRBox([x[0], y[0], depth[0]], [x[1], y[1], depth[1]]))
        if number % RANKS != RANK:
            continue
        grid = vtkUniformGrid()
        grid.SetOrigin(x[0] * step, y[0] * step, 0)
        grid.SetSpacing(step, step, step)
        grid.SetDimensions(x[1] - x[0] + 2, y[1] - y[0] + 2, depth[1] + 2)
        cells = grid.GetNumberOfCells()
        values = numpy_to_vtk(1.0 + np.arange(cells) % 7 + 3 * level, deep=1)
        values.SetName("Density")
        grid.GetCellData().SetScalars(values)
        flags = numpy_to_vtk(np.zeros(cells, np.uint8), deep=1)
        flags.SetName(GHOSTS)
        grid.GetCellData().AddArray(flags)
        grids.SetDataSet(level, index, grid)
    return given_here(grids)


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
        data.GetFieldData().GetArray(i) for i in range(data.GetFieldData().GetNumberOfArrays()))
        if array}  # text has no tuples
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


def give_tables(name, proxy):
    """Of tables of any rows, all of a port as one point."""
    proxy.UpdatePipeline()
    digests = []
    for port in range(proxy.GetNumberOfOutputPorts()):
        table = proxy.GetClientSideObject().GetOutputDataObject(port)
        columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
        values = b"".join(column.GetName().encode() + vtk_to_numpy(column).tobytes()
                          for column in columns if column.IsNumeric())
        if table.GetNumberOfRows():
            digests.append((b"table %d" % port, zlib.crc32(values)))
    gathered[name] = {"fields": {}, "points": (digests, []), "cells": ([], [])}


def give_both(name, proxy):
    give(name, proxy)
    give(name + " particles", proxy, 1)

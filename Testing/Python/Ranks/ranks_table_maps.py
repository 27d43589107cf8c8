# SPDX-License-Identifier: BSD-3-Clause
"""Rows of TestRanksTable.py: a map of which each rank has some regions."""
from paraview import simple
from ranks_rows import RANK, RANKS, give, given_here
from rt_testing import region_map
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def regions_here():
    """Those of this rank, in their order. Each has points of its own, as after a reader of maps."""
    whole = region_map()
    part = vtkPolyData()
    part.SetPoints(vtkPoints())
    part.SetPolys(vtkCellArray())
    part.GetCellData().CopyAllocate(whole.GetCellData())
    count = whole.GetNumberOfCells()
    for i in range(count * RANK // RANKS, count * (RANK + 1) // RANKS):
        corners = whole.GetCell(i).GetPoints()
        part.GetPolys().InsertNextCell(corners.GetNumberOfPoints())
        for corner in range(corners.GetNumberOfPoints()):
            part.GetPolys().InsertCellPoint(part.GetPoints().InsertNextPoint(corners.GetPoint(corner)))
        part.GetCellData().CopyData(whole.GetCellData(), i, part.GetNumberOfCells() - 1)
    return part


def give_rows(inputs):
    regions = given_here(regions_here())
    cartogram = simple.Cartogram(Input=regions, Resolution=64, Overlay=simple.UniformSeeds(
        NumberOfPoints=60, Bounds=[-0.5, 0.5, -0.5, 0.5, 0, 0]))
    for port, name in enumerate(("regions", "graticule", "overlay")):
        give("cartogram " + name, cartogram, port)

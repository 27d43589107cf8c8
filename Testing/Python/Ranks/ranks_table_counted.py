# SPDX-License-Identifier: BSD-3-Clause
"""Rows of TestRanksTable.py: what several ranks have, or one alone."""
from paraview import simple
from ranks_rows import give, with_ghosts

# Points x + 1, more than its part of the image on the first rank, or all that there is of it.
PIECES = """
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkParallelCore import vtkMultiProcessController
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
data = self.GetImageDataOutput()
size = 9 if rank == 0 else %d
data.SetExtent(0, size - 1, 0, 7, 0, 7)
values = numpy_to_vtk(%s, deep=1)
values.SetName("X")
data.GetPointData().SetScalars(values)
"""
WHOLE = """
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
information = self.GetOutputInformation(0)
information.Set(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(), (0, 8, 0, 7, 0, 7), 6)
information.Set(vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
"""
# Two points at each place, on different ranks, as one cell of all points.
CLOUD = """
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
points = vtkPoints()
for i in range(controller.GetLocalProcessId(), 100, controller.GetNumberOfProcesses()):
    place = 7 if i == 99 else i // 2  # not the same points on two ranks, which would count once
    points.InsertNextPoint(place % 10, place // 10, 0)
cell = vtkCellArray()
cell.InsertNextCell(points.GetNumberOfPoints())
for i in range(points.GetNumberOfPoints()):
    cell.InsertCellPoint(i)
data = self.GetPolyDataOutput()
data.SetPoints(points)
data.SetVerts(cell)
"""
# Sites of which the first rank alone has hidden ones, and copies of another rank's. Others have no flags.
# Their keys need 64 bits.
SITES = """
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
first, last = 24 * rank // ranks, 24 * (rank + 1) // ranks
chosen = [(i, 2 if i in (2, 5) else 0) for i in range(first, last)]
if rank == 0 and ranks > 1:
    chosen += [(last, 1), (last + 1, 1)]
points = vtkPoints()
for i, _ in chosen:
    points.InsertNextPoint(0.5 + i * 7 % 12, 0.2 + i * 5 % 7, 0)
data = self.GetPolyDataOutput()
data.SetPoints(points)
keys = numpy_to_vtkIdTypeArray(numpy.array([2**40 + i for i, _ in chosen], numpy.int64), deep=1)
keys.SetName("Key")
data.GetPointData().AddArray(keys)
if rank == 0:
    flags = numpy_to_vtk(numpy.array([flag for _, flag in chosen], numpy.uint8), deep=1)
    flags.SetName("vtkGhostType")
    data.GetPointData().AddArray(flags)
"""


def pieces(others, values):
    return simple.ProgrammableSource(OutputDataSetType="vtkImageData",
                                     Script=PIECES % (others, values),
                                     ScriptRequestInformation=WHOLE)


def give_rows(inputs):
    """What several ranks have, or one alone: it counts once."""
    image = inputs["points"]
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    counts = dict(Kernel="NearestCell", DivideByVolume=0)
    nodes = simple.Threshold(Input=image, Scalars=["POINTS", "RTData"], LowerThreshold=-1000,
                             UpperThreshold=1000)
    give("splat of ghosts", simple.SplatMass(Input=with_ghosts(nodes, 1),
                                            Dimensions=[5, 6, 7], **counts))
    give("splat of a cloud", simple.SplatMass(Input=simple.ProgrammableSource(
        OutputDataSetType="vtkPolyData", Script=CLOUD), Dimensions=[5, 5, 1], **counts))
    for layer in (3, 10):
        give("splat cells of layer %d" % layer, simple.ExtractSubset(Input=simple.SplatMass(
            Input=nodes, Reference=image, Association="Cells", **counts),
            VOI=[-4, 8, 0, 7, layer, layer]))
    drum = simple.Cylinder(Resolution=24)  # whole on each rank
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    give("seeds whole", simple.SampleDensity(Input=image, Seeds=drum, **usual))
    give("seeds of a mesh", simple.SampleDensity(Input=image, Seeds=shell, **usual))
    give("sites of a mesh", simple.EqualMassCells(Input=shell, Domain=simple.ExtractSubset(
        Input=image, VOI=[-4, 8, 0, 7, 3, 3]), Resolution=32), 1)
    sites = simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=SITES)
    give("hidden sites", simple.EqualMassCells(Input=sites, Resolution=32), 1)
    overlaps = pieces(5, "1.0 + numpy.tile(numpy.arange(size), 64)")
    first = pieces(0, "numpy.tile(numpy.arange(size), 64) - 50.0")
    for tables in ("Whole", "Tiled"):
        tiled = dict(Tables=tables, NumberOfParticles=500, NumberOfSteps=32)
        give("sample overlaps " + tables, simple.SampleDensity(Input=overlaps, **tiled))
        give("sample inverted " + tables, simple.SampleDensity(
            Input=first, InvertDensity=1, **tiled))

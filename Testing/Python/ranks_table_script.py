# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksTable.py runs on each rank: filters on distributed images. Each rank writes what it
has of the outputs: a digest of each element, by its place."""
import pickle
import sys
import zlib

import numpy as np
from paraview import servermanager, simple
from rt_testing import load_plugin, reads_appended_data
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


def give_tiled():
    """Of several tiles, and of a density that is empty in most places."""
    image = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[200, 10, 10],
                           StandardDeviation=2)
    sparse = simple.Calculator(Input=image, Function="(RTData > 270) * RTData",
                               ResultArrayName="Ink")
    tiled = dict(Tables="Tiled", NegativeValues="Clamp")
    wide = simple.ExtractSubset(Input=simple.Wavelet(WholeExtent=[0, 2100, 0, 900, 0, 1]),
                                VOI=[0, 2100, 0, 900, 0, 0])
    for name, density in (("long", image), ("sparse", sparse), ("wide", wide)):
        for maps in ("On", "Off"):
            give("%s maps %s" % (name, maps), simple.SampleDensity(
                Input=density, NumberOfParticles=3000, FlowMaps=maps, **tiled))
        give(name + " map", simple.TransportMap(
            Input=density, SampleDimensions=[40, 6, 7 if name != "wide" else 1], **tiled))
        give(name + " back", simple.TransportMap(
            Input=density, SampleDimensions=[40, 6, 7 if name != "wide" else 1], Direction="DensityToUniform", **tiled))
    give("long warp", simple.DensityEqualizingWarp(Input=simple.Contour(
        Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[260.0], ComputeNormals=0),
        Density=image, **tiled))


# In single precision, with global ids in place of SeedId.
SINGLE = """
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkPoints
source = self.GetInputDataObject(0, 0)
data = self.GetOutputDataObject(0)
data.ShallowCopy(source)
points = vtkPoints()
points.SetDataType(VTK_FLOAT)
points.SetNumberOfPoints(source.GetNumberOfPoints())
for i in range(source.GetNumberOfPoints()):
    points.SetPoint(i, source.GetPoint(i))
data.SetPoints(points)
ids = source.GetPointData().GetArray("SeedId")
data.GetPointData().RemoveArray("SeedId")
if ids:
    numbers = ids.NewInstance()
    numbers.DeepCopy(ids)
    numbers.SetName("Number")
    data.GetPointData().SetGlobalIds(numbers)
"""
# The same points on each rank, or on some alone.
SPREAD = """
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
data = self.GetPolyDataOutput()
points = vtkPoints()
masses = vtkDoubleArray()
masses.SetName("Weight")
for i in range(20000 if %s else 0):
    points.InsertNextPoint(i * 13 %% 101 / 10.0, i * 29 %% 97 / 12.0, i * 7 %% 89 / 9.0)
    masses.InsertNextValue(0.1 + i %% 7 / 3.0)
data.SetPoints(points)
data.GetPointData().AddArray(masses)
"""

# As many at each time, in another box, on all ranks.
MOVING = """
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
time = self.GetOutputInformation(0).Get(Pipeline.UPDATE_TIME_STEP()) or 0
points = vtkPoints()
for i in range(controller.GetLocalProcessId(), 400, controller.GetNumberOfProcesses()):
    points.InsertNextPoint((1 + time) * (i % 10), i % 7, i * 7 % 13)
self.GetPolyDataOutput().SetPoints(points)
"""
TIMES = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
information = self.GetOutputInformation(0)
for key in (Pipeline.TIME_STEPS(), Pipeline.TIME_RANGE()):
    information.Remove(key)
    for time in (0.0, 1.0):
        information.Append(key, time)
"""


def spread(where):
    return simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=SPREAD % where)


def weighed(particles):
    return simple.Calculator(Input=particles, ResultArrayName="Weight",
                             Function="0.1 + coordsX * coordsX + 0.01 * SeedId")


def give_splats(image, flat, ghosts):
    """Of particles that lie on ranks in another order than on one."""
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    particles = weighed(simple.SampleDensity(Input=image, NumberOfParticles=10000, **usual))
    weight = dict(MassArray=["POINTS", "Weight"])
    small = dict(Dimensions=[19, 14, 11])
    reference = simple.Wavelet(WholeExtent=[-2, 5, 1, 6, 2, 8])
    for kernel in ("CloudInCell", "NearestCell", "TriangularShapedCloud", "Gaussian"):
        for on in ("Points", "Cells"):
            options = dict(Input=particles, Kernel=kernel, Association=on, **weight)
            give("splat %s %s" % (kernel, on), simple.SplatMass(**small, **options))
            give("splat %s %s reference" % (kernel, on), simple.SplatMass(
                Reference=image if on == "Points" else ghosts, **options))
            give("splat %s %s drop" % (kernel, on), simple.SplatMass(
                Reference=reference, Boundary="Drop", **options))
            give("splat %s %s outside" % (kernel, on), simple.SplatMass(
                Reference=reference, **options))
    give("splat ones", simple.SplatMass(Input=particles, DivideByVolume=0, **small))
    large = simple.Wavelet(WholeExtent=[0, 40, 0, 30, 0, 25], Center=[20, 20, 20])
    # Some of many chunks of cells are dropped.
    give("splat large drop", simple.SplatMass(
        Input=particles, Reference=large, Boundary="Drop", **weight))
    single = simple.ProgrammableFilter(Input=particles, Script=SINGLE)
    give("splat single", simple.SplatMass(Input=single, Association="Cells", **small, **weight))
    plane = weighed(simple.SampleDensity(Input=flat, NumberOfParticles=3000, **usual))
    for on in ("Points", "Cells"):
        give("splat flat " + on, simple.SplatMass(
            Input=plane, Dimensions=[30, 20, 25], Association=on, **weight))
        give("splat flat reference " + on, simple.SplatMass(
            Input=plane, Reference=flat, Association=on, **weight))
    line = simple.ExtractSubset(Input=image, VOI=[-4, 8, 3, 3, 4, 4])
    on_line = simple.SampleDensity(Input=line, NumberOfParticles=300, **usual)
    give("splat line", simple.SplatMass(Input=on_line, Dimensions=[30, 20, 25]))
    give("splat layer", simple.SplatMass(Input=particles, Dimensions=[12, 9, 1], **weight))
    give("splat whole", simple.SplatMass(Input=spread("True"), **small, **weight))
    give("splat first", simple.SplatMass(Input=spread("rank == 0"), **small, **weight))
    give("splat last", simple.SplatMass(
        Input=spread("rank == ranks - 1"), Reference=image, **weight))
    # Whole numbers for any order of the points.
    counts = dict(Kernel="NearestCell", DivideByVolume=0, **small)
    # An image whose place changes with time.
    moving, early = (simple.SplatMass(Input=simple.ProgrammableSource(
        OutputDataSetType="vtkPolyData", Script=MOVING, ScriptRequestInformation=times), **counts)
        for times in (TIMES, ""))
    part = simple.ExtractSubset(Input=moving, VOI=[2, 13, 1, 9, 3, 8])
    steps = dict(usual, NumberOfSteps=32)
    for name, proxy in (
            ("splat", part), ("splat map", simple.TransportMap(Input=part, **steps)),
            ("splat tiled", simple.TransportMap(Input=moving, Tables="Tiled", **steps)),
            ("splat morph", simple.MorphDensities(Input=moving, Target=early, **steps)),
            ("splat labels", simple.EqualMassCells(
                Input=simple.UniformSeeds(NumberOfPoints=40, Bounds=[0, 9, 0, 6, 0, 0]),
                Domain=simple.ExtractSubset(Input=moving, VOI=[0, 18, 0, 13, 0, 0]),
                Resolution=32))):
        for time in (0.0, 1.0):
            give("%s at %g" % (name, time), proxy, time=time)
    # Meshes, of whose points some are on several ranks.
    mesh = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                          ComputeNormals=0)
    give("splat mesh", simple.SplatMass(Input=mesh, **counts))
    give("splat grid", simple.SplatMass(
        Input=simple.Transform(Input=image), Reference=large, **counts))
    field = simple.SplatMass(Input=particles, **small, **weight)
    give("splat contour", simple.Contour(Input=field, ContourBy=["POINTS", "Density"],
                                         Isosurfaces=[10.0], ComputeNormals=0))
    give("splat threshold", simple.Threshold(
        Input=field, Scalars=["POINTS", "Density"], LowerThreshold=5, UpperThreshold=1000))
    give("splat slice", simple.Slice(Input=field))
    give("splat subset", simple.ExtractSubset(Input=field, VOI=[3, 12, 2, 9, 1, 8]))
    # Behind an image of one layer less than the Dimensions have.
    flat_field = simple.SplatMass(Input=plane, Dimensions=[30, 20, 25], **weight)
    give("splat flat subset", simple.ExtractSubset(Input=flat_field, VOI=[3, 12, 0, 0, 1, 8]))
    give("splat map", simple.TransportMap(Input=flat_field, **usual))
    give("splat again", simple.SplatMass(Input=simple.SampleDensity(
        Input=field, NumberOfParticles=2000, **usual), Dimensions=[8, 8, 8]))


def give_qualities(inputs):
    clamp = dict(NegativeValues="Clamp")
    particles = {name: simple.SampleDensity(Input=image, NumberOfParticles=4000, NumberOfSteps=8,
                                            **clamp) for name, image in inputs.items()}
    for name, image in inputs.items():
        give_row("quality " + name, simple.TransportQuality(
            Input=particles[name], Density=image, **clamp))
    points, image = particles["points"], inputs["points"]
    give_row("quality blocks", simple.TransportQuality(
        Input=points, Density=image, BlockSize=2, **clamp))
    masses = simple.Calculator(Input=points, ResultArrayName="Mass",
                               Function="0.1 + coordsX * coordsX + 0.01 * SeedId")
    give_row("quality masses", simple.TransportQuality(Input=masses, Density=image, **clamp))
    # Where others are, and not all inside.
    moved = simple.Transform(Input=redistributed(Input=masses))
    moved.Transform.Translate = [1.5, -0.7, 0.2]
    give_row("quality moved", simple.TransportQuality(Input=moved, Density=image, **clamp))
    give_row("quality whole", simple.TransportQuality(
        Input=spread("True"), Density=image, **clamp))
    give_row("quality last", simple.TransportQuality(
        Input=spread("rank == ranks - 1"), Density=image, **clamp))
    field = simple.SplatMass(Input=points, Dimensions=[10, 8, 9])
    give_row("quality of a splat", simple.TransportQuality(Input=points, Density=field))
    give_row("quality plane", simple.TransportQuality(
        Input=particles["flat"], Density=simple.SplatMass(
            Input=particles["flat"], Dimensions=[10, 8, 9], Association="Cells")))


def give_data():
    """Seeds in pieces; densities that are no images; filters that gather their inputs."""
    for pattern in ("BlueNoise", "Lattice", "Jittered", "LowDiscrepancy", "Random"):
        give("uniform " + pattern, simple.UniformSeeds(
            NumberOfPoints=700, Dimension=3 if pattern == "Random" else 2, Pattern=pattern))
    image = simple.Wavelet(WholeExtent=[-4, 8, 0, 7, 0, 10])
    cells = simple.PointDatatoCellData(Input=image, ProcessAllArrays=1)
    meshes = {
        "structured": simple.ImageDatatoPointSet(Input=image),
        "structured cells": simple.ImageDatatoPointSet(Input=cells),
        "mesh": simple.Threshold(Input=cells, Scalars=["CELLS", "RTData"],
                                 LowerThreshold=0, UpperThreshold=1000),
        "ghost mesh": simple.GhostCellsGenerator(Input=simple.Threshold(
            Input=cells, Scalars=["CELLS", "RTData"], LowerThreshold=0, UpperThreshold=1000),
            BuildIfRequired=0, MinimumNumberOfGhosts=1),
        "block": simple.GroupDatasets(Input=[simple.ImageDatatoPointSet(Input=cells)]),
    }
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8, DensityResolution=12)
    for name, density in meshes.items():
        give("sample " + name, simple.SampleDensity(
            Input=density, NumberOfParticles=400, **usual))
        give("map " + name, simple.TransportMap(Input=density, **usual))
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    give("warp mesh", simple.DensityEqualizingWarp(Input=shell, Density=meshes["mesh"], **usual))
    drum = simple.Cylinder(Resolution=24)  # whole on each rank
    hill = simple.Contour(Input=simple.Wavelet(WholeExtent=[-7, 7] * 3), ComputeNormals=0,
                          ContourBy=["POINTS", "RTData"], Isosurfaces=[220.0])
    for name, surface in (("drum", drum), ("hill", hill),
                          ("hill apart", simple.ExtractSurface(
                              Input=redistributed(Input=hill))),
                          ("ball", simple.Sphere(ThetaResolution=24))):
        for association in ("Points", "Cells"):
            give("solid %s %s" % (name, association), simple.SolidDensity(
                Input=surface, Resolution=14, Association=association))
    give("solid slice", simple.Slice(Input=simple.SolidDensity(Input=drum, Resolution=14)))
    sites = simple.UniformSeeds(NumberOfPoints=40)
    relaxed = simple.UniformSeeds(NumberOfPoints=90, Dimension=3, Bounds=[-4, 8, 0, 7, 0, 10])
    give("relaxed", simple.RelaxBlueNoise(
        Input=relaxed, Density=image, MaximumIterations=3, NegativeValues="Clamp"))
    give("relaxed by mesh", simple.RelaxBlueNoise(
        Input=relaxed, Density=meshes["block"], MaximumIterations=3, NegativeValues="Clamp",
        DensityResolution=12))
    flat = simple.ExtractSubset(Input=image, VOI=[-4, 8, 0, 7, 3, 3])
    for name, options in (("", {}), (" on", dict(Domain=flat)),
                          (" by mass", dict(Domain=flat, Measure="Density",
                                            NegativeValues="Clamp")),
                          (" by power", dict(Domain=flat, Shape="Power"))):
        divided = simple.EqualMassCells(Input=sites, Resolution=40, **options)
        for port, output in enumerate(("labels", "sites", "outlines")):
            give(output + name, divided, port)
    give("few labels", simple.EqualMassCells(
        Input=simple.UniformSeeds(NumberOfPoints=2), Resolution=3))
    plane = simple.Plane(XResolution=9, YResolution=7)
    give("surface", simple.SampleSurface(Input=plane, Resolution=24, NumberOfParticles=200))
    give("parameterization", simple.AreaPreservingParameterization(Input=plane, Resolution=24))
    cut = simple.ExtractSurface(Input=redistributed(Input=plane))
    give("surface apart", simple.SampleSurface(Input=cut, Resolution=24, NumberOfParticles=200))
    give("parameterization apart", simple.AreaPreservingParameterization(Input=cut, Resolution=24))


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
    points.InsertNextPoint(i * 7 % 50 % 10, i * 7 % 50 // 10, 0)
cell = vtkCellArray()
cell.InsertNextCell(points.GetNumberOfPoints())
for i in range(points.GetNumberOfPoints()):
    cell.InsertCellPoint(i)
data = self.GetPolyDataOutput()
data.SetPoints(points)
data.SetVerts(cell)
"""


def pieces(others, values):
    return simple.ProgrammableSource(OutputDataSetType="vtkImageData",
                                     Script=PIECES % (others, values),
                                     ScriptRequestInformation=WHOLE)


def give_counted(image):
    """What several ranks have, or one alone: it counts once."""
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    counts = dict(Kernel="NearestCell", DivideByVolume=0)
    nodes = simple.Threshold(Input=image, Scalars=["POINTS", "RTData"], LowerThreshold=-1000,
                             UpperThreshold=1000)
    give("splat of ghosts", simple.SplatMass(Input=simple.GhostCellsGenerator(
        Input=nodes, BuildIfRequired=0, MinimumNumberOfGhosts=1), Dimensions=[5, 6, 7], **counts))
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
    overlaps = pieces(5, "1.0 + numpy.tile(numpy.arange(size), 64)")
    first = pieces(0, "numpy.tile(numpy.arange(size), 64) - 50.0")
    for tables in ("Whole", "Tiled"):
        tiled = dict(Tables=tables, NumberOfParticles=500, NumberOfSteps=32)
        give("sample overlaps " + tables, simple.SampleDensity(Input=overlaps, **tiled))
        give("sample inverted " + tables, simple.SampleDensity(
            Input=first, InvertDensity=1, **tiled))


def give_both(name, proxy):
    give(name, proxy)
    give(name + " particles", proxy, 1)


def morph(**properties):
    simple.SetActiveSource(None)  # whose arrays would be the defaults of a new filter
    return simple.MorphDensities(**properties)


def barycenter(**properties):
    simple.SetActiveSource(None)
    return simple.DensityBarycenter(**properties)


def give_blends():
    """Of densities on points and cells, of one geometry and of several."""
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    whole = [-4, 8, 0, 7, 0, 10]
    image = simple.Wavelet(WholeExtent=whole)
    other = simple.Wavelet(WholeExtent=whole, StandardDeviation=0.2, XFreq=20, Center=[4, 1, 2])
    cells, other_cells = (simple.PointDatatoCellData(Input=density, ProcessAllArrays=1)
                          for density in (image, other))
    flat, other_flat = (simple.ExtractSubset(Input=density, VOI=[-4, 8, 3, 3, 0, 10])
                        for density in (image, other))
    long = simple.Wavelet(WholeExtent=[-2, 3, -2, 3, 0, 21], StandardDeviation=0.3)
    # A source that is asked for two pieces.
    wider = simple.GhostCellsGenerator(Input=other, BuildIfRequired=0, MinimumNumberOfGhosts=2)
    inputs = {"points": (image, other), "cells": (cells, other_cells),
              "flat": (flat, other_flat), "geometries": (image, long), "mixed": (cells, long),
              "twice": (image, image), "wider": (other, wider), "wider first": (wider, other)}
    for name, (source, target) in inputs.items():
        give_both("morph " + name, morph(Input=source, Target=target, Parameter=0.3, **usual))
    for count in (2, 3, 4, 8):
        give_both("morph of %d" % count, morph(
            Input=image, Target=long, ParticlesPerCell=count, **usual))
    for mode in ("Geometric", "Source", "Normalize"):
        give_both("morph " + mode, morph(Input=image, Target=other, MassMode=mode, **usual))
    for tables in ("Tiled", "Whole"):
        for count in (1, 3):
            give_both("morph %s %d" % (tables, count), morph(
                Input=cells, Target=long, Tables=tables, ParticlesPerCell=count,
                NegativeValues="Clamp", NumberOfSteps=32))
    far = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[200, 10, 10],
                         StandardDeviation=2)
    near = simple.Wavelet(WholeExtent=[0, 400, 0, 28, 0, 31], Center=[100, 10, 10])
    for maps in ("On", "Off"):
        give_both("morph tiles maps " + maps, morph(
            Input=far, Target=near, Tables="Tiled", FlowMaps=maps, Dimensions=[60, 6, 7],
            ParticlesPerCell=2, NegativeValues="Clamp"))
    sparse = simple.Calculator(Input=other, Function="(RTData > 150) * RTData",
                               ResultArrayName="RTData")
    give_both("morph sparse", morph(
        Input=image, Target=sparse, NegativeValues="Clamp", NumberOfSteps=2, Integrator="Euler"))
    give_both("morph coarse", morph(
        Input=image, Target=other, Dimensions=[5, 4, 3], Kernel="Gaussian", **usual))
    series = morph(Input=image, Target=long, PublishTime=1, NumberOfTimeSteps=4, **usual)
    for time in (0.0, 1 / 3, 1.0):
        series.UpdatePipeline(time)
        give_both("morph at %.2f" % time, series)
    mean = barycenter(Input=[image, other, long], Weights=[1, 2, 0.5], **usual)
    give_both("barycenter", mean)
    mean.Weights = [0, 2, 1]
    give_both("barycenter again", mean)
    give_both("barycenter blocks", barycenter(
        Input=simple.GroupDatasets(Input=[image, other, long]), ParticlesPerCell=2, **usual))
    behind = morph(Input=image, Target=other, **usual)
    give("morph contour", simple.Contour(Input=behind, ContourBy=["POINTS", "Density"],
                                         Isosurfaces=[120.0], ComputeNormals=0))
    give("morph slice", simple.Slice(Input=behind))
    give("morph threshold", simple.Threshold(
        Input=servermanager.OutputPort(behind, 1), Scalars=["POINTS", "SourcePosition"],
        LowerThreshold=1, UpperThreshold=1000))


def main(path):
    load_plugin()
    image = simple.Wavelet(WholeExtent=[-4, 8, 0, 7, 0, 10])
    cells = simple.PointDatatoCellData(Input=image, ProcessAllArrays=1)
    flat = simple.ExtractSubset(Input=image, VOI=[-4, 8, 3, 3, 0, 10])
    ghosts = simple.GhostCellsGenerator(Input=image, BuildIfRequired=0,
                                        MinimumNumberOfGhosts=2)
    inputs = {"points": image, "cells": cells, "flat": flat, "ghosts": ghosts}
    usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
    seeds = simple.UniformSeeds(NumberOfPoints=300, Dimension=3, Pattern="Jittered")
    for name, density in inputs.items():
        give("sample " + name, simple.SampleDensity(
            Input=density, NumberOfParticles=500, **usual))
        give("map " + name, simple.TransportMap(Input=density, **usual))
    give("tiled", simple.SampleDensity(Input=image, NumberOfParticles=500, Tables="Tiled",
                                       NegativeValues="Clamp", NumberOfSteps=32))
    give("few", simple.SampleDensity(Input=image, NumberOfParticles=2, **usual))
    give("paths", simple.SampleDensity(
        Input=cells, NumberOfParticles=60, OutputPaths=1, SampleArrays=0, **usual))
    give("early", simple.SampleDensity(Input=image, NumberOfParticles=300, FlowTime=0.5, **usual))
    give("cell grid", simple.SampleDensity(
        Input=cells, SamplesPerCell=1, SeedPattern="Jittered", **usual))
    give("seeds", simple.SampleDensity(Input=image, Seeds=seeds, **usual))
    give("map back", simple.TransportMap(Input=image, Direction="DensityToUniform", **usual))
    give("map coarse", simple.TransportMap(Input=cells, SampleDimensions=[5, 7, 3], **usual))
    give("map tiled", simple.TransportMap(Input=image, Tables="Tiled", NegativeValues="Clamp",
                                          NumberOfSteps=32))
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    give("warp", simple.DensityEqualizingWarp(Input=shell, Density=image, **usual))
    give("warp cells", simple.DensityEqualizingWarp(Input=shell, Density=cells, **usual))
    give("seeds apart", simple.SampleDensity(
        Input=image, Seeds=redistributed(Input=seeds), **usual))
    field = simple.TransportMap(Input=image, **usual)
    give("contour", simple.Contour(Input=field, ContourBy=["POINTS", "Divergence"],
                                   Isosurfaces=[0.0], ComputeNormals=0))
    give("slice", simple.Slice(Input=field))
    give("threshold", simple.Threshold(Input=simple.SampleDensity(
        Input=image, NumberOfParticles=400, **usual), Scalars=["POINTS", "RTData"],
        LowerThreshold=150, UpperThreshold=1000))
    give_tiled()
    give_splats(image, flat, ghosts)
    give_qualities(inputs)
    give_data()
    give_counted(image)
    give_blends()
    with open("%s.%d" % (path, RANK), "wb") as file:
        pickle.dump(gathered, file)
    print("WROTE", RANK, flush=True)


if __name__ == "__main__":
    main(sys.argv[1])

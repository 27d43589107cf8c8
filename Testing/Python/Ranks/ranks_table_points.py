# SPDX-License-Identifier: BSD-3-Clause
"""Rows of TestRanksTable.py: filters that take particles, or fill closed surfaces with them."""
from paraview import simple
from ranks_rows import give, give_row, redistributed

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


def give_rows(inputs):
    images = {name: inputs[name] for name in ("points", "cells", "flat", "ghosts")}
    give_splats(images["points"], images["flat"], images["ghosts"])
    give_qualities(images)
    give_solids()


def give_solids():
    """Inside a closed surface in pieces: where it is new, and where another filter has updated it."""
    usual = dict(DensityResolution=12, NumberOfSteps=8)
    ball = simple.Sphere(ThetaResolution=24)
    apart = simple.ExtractSurface(Input=redistributed(Input=simple.Sphere(ThetaResolution=24)))
    other = simple.Sphere(Center=[0.5, 0, 0], Radius=0.4)
    for name, surface in (("ball", ball), ("ball apart", apart)):
        give("morph of a new " + name, simple.MorphDensities(surface, Target=other, **usual))
        give("inside a " + name, simple.SampleDensity(surface, NumberOfParticles=300, **usual))
        give("map of a " + name, simple.TransportMap(surface, **usual))
        give("morph of a " + name, simple.MorphDensities(surface, Target=other, **usual))


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
        for tables in ("Whole", "Tiled"):
            give_row("quality %s %s" % (name, tables), simple.TransportQuality(
                Input=particles[name], Density=image, Tables=tables, **clamp))
    points, image = particles["points"], inputs["points"]
    give_row("quality blocks", simple.TransportQuality(
        Input=points, Density=image, BlockSize=2, **clamp))
    masses = simple.Calculator(Input=points, ResultArrayName="Mass",
                               Function="0.1 + coordsX * coordsX + 0.01 * SeedId")
    give_row("quality masses", simple.TransportQuality(Input=masses, Density=image, **clamp))
    # Where others are, and not all inside.
    moved = simple.Transform(Input=redistributed(Input=masses))
    moved.Transform.Translate = [1.5, -0.7, 0.2]
    for tables in ("Whole", "Tiled"):
        give_row("quality moved " + tables, simple.TransportQuality(
            Input=moved, Density=image, Tables=tables, **clamp))
    give_row("quality whole", simple.TransportQuality(
        Input=spread("True"), Density=image, **clamp))
    give_row("quality last", simple.TransportQuality(
        Input=spread("rank == ranks - 1"), Density=image, Tables="Tiled", **clamp))
    field = simple.SplatMass(Input=points, Dimensions=[10, 8, 9])
    give_row("quality of a splat", simple.TransportQuality(Input=points, Density=field))
    give_row("quality plane", simple.TransportQuality(
        Input=particles["flat"], Density=simple.SplatMass(
            Input=particles["flat"], Dimensions=[10, 8, 9], Association="Cells")))

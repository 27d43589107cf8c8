# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksErrors.py runs on each of three ranks: images with a fault on one of them. Each rank
writes the messages of the filter and how much it has of the output."""
import json
import sys

import numpy as np
from rectifiedtransport import (vtkAreaPreservingParameterization, vtkBlueNoiseRelaxation,
                                vtkEqualMassCells, vtkMassSplatter, vtkSolidDensity,
                                vtkTransportBarycenter, vtkTransportInterpolator,
                                vtkTransportMap, vtkTransportQuality, vtkTransportSampler)
from ranks_errors_above import report_above
from ranks_errors_short import short
from rt_testing import Listener
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkImageData, vtkMultiBlockDataSet, vtkPolyData,
                                           vtkRectilinearGrid)
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController

RANKS = vtkMultiProcessController.GetGlobalController()
RANK = RANKS.GetLocalProcessId()
WHOLE = [0, 6, 0, 5, 0, 12]
FAULTY = 1
results = {}  # of each case: the number of points, the errors


def piece(low=None, high=None, spacing=1.0, values=None, name="Density", dtype=float, cells=True):
    """The layers of points from low to high of the whole image; by default this rank's."""
    low = 4 * RANK if low is None else low
    high = 4 * RANK + 4 if high is None else high
    image = vtkImageData()
    image.SetExtent(0, 6, 0, 5, low, high)
    image.SetSpacing(1.0, 1.0, spacing)
    count = image.GetNumberOfCells() if cells else image.GetNumberOfPoints()
    given = 1.0 + np.arange(count) % 7 if values is None else np.full(count, values)
    array = numpy_to_vtk(given.astype(dtype), deep=1)
    array.SetName(name)
    (image.GetCellData() if cells else image.GetPointData()).SetScalars(array)
    return image


def with_value(value):
    image = piece()
    if RANK == FAULTY:
        image.GetCellData().GetArray(0).SetTuple1(8, value)
    return image


def on(rank, wanted, otherwise):
    return wanted() if RANK == rank else otherwise()


IMAGES = {
    "right": piece,
    "spacing": lambda: on(FAULTY, lambda: piece(spacing=2.0), piece),
    "array": lambda: on(FAULTY, lambda: piece(name="Other"), piece),
    "nameless": lambda: piece(name=None),
    "association": lambda: on(FAULTY, lambda: piece(cells=False), piece),
    "type": lambda: on(FAULTY, lambda: piece(dtype=np.float32), piece),
    "not a number": lambda: with_value(np.nan),
    "negative": lambda: with_value(-1.0),
    "no mass": lambda: piece(values=0.0),
    "mass on one": lambda: on(FAULTY, piece, lambda: piece(values=0.0)),
    "gap": lambda: on(FAULTY, vtkImageData, piece),
    "one has none": lambda: on(FAULTY, vtkImageData, lambda: piece(
        0 if RANK == 0 else 6, 6 if RANK == 0 else 12)),
    "first has none": lambda: on(0, vtkImageData, lambda: piece(6 * RANK - 6, 6 * RANK)),
    "one has all": lambda: on(FAULTY, lambda: piece(0, 12), vtkImageData),
    "all have all": lambda: piece(0, 12),
    "none has any": vtkImageData,
    "overlap": lambda: piece(max(0, 4 * RANK - 1), min(12, 4 * RANK + 6)),
}
# Overlapping pieces have the values of the whole image.
for wide in ("one has none", "first has none", "one has all", "all have all", "overlap"):
    def with_own_values(make=IMAGES[wide]):
        image = make()
        array = image.GetCellData().GetArray(0)
        if array:
            first = image.GetExtent()[4] * 30
            for i in range(array.GetNumberOfTuples()):
                array.SetTuple1(i, 1.0 + (first + i) % 7 + (first + i) // 30)
        return image
    IMAGES[wide] = with_own_values


def report(name, algorithm, source):
    errors = Listener(algorithm).errors
    algorithm.SetInputConnection(source.GetOutputPort())
    algorithm.SetNumberOfSteps(8)
    finish(name, algorithm, errors)


def update(algorithm, errors):
    """Returns the messages."""
    algorithm.UpdatePiece(RANK, RANKS.GetNumberOfProcesses(), 0)
    own = [error.splitlines() for error in errors if "returned failure for request" not in error]
    return [" ".join(lines) for lines in own]


def finish(name, algorithm, errors):
    messages = update(algorithm, errors)
    output = algorithm.GetOutputDataObject(0)
    mass = output.GetFieldData().GetArray("TotalMass")
    results[name] = [output.GetNumberOfPoints(), messages, mass.GetValue(0) if mass else 0.0]
    RANKS.Barrier()


def produce(data):
    source = vtkTrivialProducer()
    source.SetOutput(data)
    if data.IsA("vtkImageData"):
        source.SetWholeExtent(WHOLE)
    return source


def report_blend(name, algorithm):
    """Of the particles; the cells of the density, too."""
    errors = Listener(algorithm).errors
    algorithm.SetNumberOfSteps(8)
    messages = update(algorithm, errors)
    results[name] = [algorithm.GetParticles().GetNumberOfPoints(), messages,
                     algorithm.GetDensity().GetNumberOfCells()]
    RANKS.Barrier()


def morph(source, target):
    algorithm = vtkTransportInterpolator()
    for port, producer in enumerate((produce(source), produce(target))):
        algorithm.SetInputConnection(port, producer.GetOutputPort())
    return algorithm


def barycenter(*inputs):
    algorithm = vtkTransportBarycenter()
    for producer in [produce(data) for data in inputs]:
        algorithm.AddInputConnection(0, producer.GetOutputPort())
    return algorithm


def blocks(*inputs):
    made = vtkMultiBlockDataSet()
    for i, data in enumerate(inputs):
        made.SetBlock(i, data)
    return made


def turned():
    image = piece()
    if RANK == FAULTY:
        image.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    return image


def report_blends():
    for name, make in IMAGES.items():
        report_blend("morph " + name, morph(piece(), make()))
    report_blend("morph direction", morph(piece(), turned()))
    whole = IMAGES["all have all"]
    report_blend("barycenter right", barycenter(piece(), piece(), whole()))
    report_blend("barycenter number", barycenter(piece(), *([] if RANK == FAULTY else [piece()])))
    report_blend("barycenter kind", barycenter(
        piece(), on(FAULTY, lambda: rectilinear(piece()), piece)))
    report_blend("barycenter nothing on one", barycenter(
        piece(), on(FAULTY, vtkRectilinearGrid, IMAGES["one has none"])))
    report_blend("blocks right", barycenter(blocks(whole(), piece(0, 12))))
    report_blend("blocks in pieces", barycenter(blocks(piece(), piece())))

    algorithm = morph(piece(), whole())
    algorithm.SetParameter(on(FAULTY, lambda: 2.0, lambda: 0.5))
    report_blend("morph wrong on one", algorithm)
    algorithm.SetParameter(0.5)
    algorithm.Modified()  # on all, as the extents are empty after an error
    report_blend("morph put right", algorithm)
    # The others have maps.
    algorithm = on(FAULTY, lambda: morph(piece(), whole()), lambda: algorithm)
    algorithm.SetParameter(0.25)
    report_blend("morph without maps on one", algorithm)
    observer = None
    if RANK == FAULTY:
        observer = algorithm.AddObserver(
            "ProgressEvent", lambda caller, _event: caller.SetAbortExecute(1))
    algorithm.SetMassModeToSource()
    report_blend("morph abort", algorithm)
    if observer:
        algorithm.RemoveObserver(observer)
        algorithm.SetAbortExecute(0)
    algorithm.Modified()
    report_blend("morph after an abort", algorithm)


for name, make in IMAGES.items():
    for kind in (vtkTransportSampler, vtkTransportMap):
        source = vtkTrivialProducer()
        source.SetOutput(make())
        source.SetWholeExtent(WHOLE)
        algorithm = kind()
        if kind is vtkTransportSampler:
            algorithm.SetNumberOfParticles(60)
        report("%s %s" % ("sample" if kind is vtkTransportSampler else "map", name), algorithm,
               source)

report_above(report, finish, produce)

# One rank has given up the tables that the others keep.
for kind in (vtkTransportSampler, vtkTransportMap):
    first, second = kind(), kind()
    if kind is vtkTransportSampler:
        first.SetNumberOfParticles(60)
        second.SetNumberOfParticles(60)
    name = "sample " if kind is vtkTransportSampler else "map "
    report(name + "before", first, produce(piece()))
    if RANK == FAULTY:
        first = None
    report(name + "kept by others", second, produce(piece()))

for name, wrong in (("wrong property", lambda: -1), ("wrong on one", lambda: on(
        FAULTY, lambda: -1, lambda: 60))):
    source = vtkTrivialProducer()
    source.SetOutput(piece())
    source.SetWholeExtent(WHOLE)
    algorithm = vtkTransportSampler()
    algorithm.SetNumberOfParticles(wrong())
    report(name, algorithm, source)

def rectilinear(image):
    """The same cells as no image."""
    grid = vtkRectilinearGrid()
    grid.SetExtent(image.GetExtent())
    low = image.GetExtent()[::2]
    for axis, count in enumerate(image.GetDimensions()):
        coordinates = numpy_to_vtk(np.arange(low[axis], low[axis] + count, dtype=float), deep=1)
        getattr(grid, "Set%sCoordinates" % "XYZ"[axis])(coordinates)
    grid.GetCellData().ShallowCopy(image.GetCellData())
    return grid


def nothing():
    return vtkRectilinearGrid()


MESHES = {
    "right": lambda: rectilinear(piece()),
    "whole": lambda: rectilinear(whole()),
    "on first": lambda: on(0, lambda: rectilinear(whole()), nothing),
    "on one": lambda: on(FAULTY, lambda: rectilinear(whole()), nothing),
    "none has any": nothing,
    "not a number": lambda: rectilinear(with_value(np.nan)),
    "nameless": lambda: rectilinear(piece(name=None)),
    "array": lambda: on(FAULTY, lambda: rectilinear(piece(name="Other")),
                        lambda: rectilinear(piece())),
    "type": lambda: on(FAULTY, piece, lambda: rectilinear(piece())),
}


def whole():
    """What the ranks' pieces are together."""
    image = piece(0, 12)
    array = image.GetCellData().GetArray(0)
    for i in range(array.GetNumberOfTuples()):
        array.SetTuple1(i, 1.0 + i % 120 % 7)
    return image


def producer(data):
    source = vtkTrivialProducer()
    source.SetOutput(data)
    source.SetWholeExtent(WHOLE)
    return source


for name, make in MESHES.items():
    for kind in (vtkTransportSampler, vtkTransportMap):
        algorithm = kind()
        algorithm.SetDensityResolution(12)
        if kind is vtkTransportSampler:
            algorithm.SetNumberOfParticles(60)
        report("%s mesh %s" % ("sample" if kind is vtkTransportSampler else "map", name), algorithm,
               producer(make()))


def points(count, value=None):
    """Of each rank others."""
    made = vtkPoints()
    for i in range(count):
        made.InsertNextPoint(0.5 + RANK + 0.1 * i, 0.3 * i, 0.0)
    if value is not None:
        made.SetPoint(0, value, 0.0, 0.0)
    cloud = vtkPolyData()
    cloud.SetPoints(made)
    return cloud


def gather(name, algorithm, *data):
    errors = Listener(algorithm).errors
    producers = [producer(given) for given in data]
    for port, source in enumerate(producers):
        algorithm.SetInputConnection(port, source.GetOutputPort())
    finish(name, algorithm, errors)


def disk():
    algorithm = vtkAreaPreservingParameterization()
    algorithm.SetSeamsToNone()
    return algorithm


def cells():
    algorithm = vtkEqualMassCells()
    algorithm.SetResolution(20)
    return algorithm


def solid():
    algorithm = vtkSolidDensity()
    algorithm.SetResolution(10)
    return algorithm


def relaxation():
    algorithm = vtkBlueNoiseRelaxation()
    algorithm.SetMaximumIterations(2)
    return algorithm


def sphere(phi=180.0):
    source = vtkSphereSource()
    source.SetThetaResolution(12)
    source.SetEndPhi(phi)
    source.Update()
    return source.GetOutput()


def plane():
    source = vtkPlaneSource()
    source.SetResolution(4, 4)
    source.SetCenter(0.5 + RANK, 0.0, 0.0)
    source.Update()
    return source.GetOutput()


gather("cells right", cells(), points(4))
gather("cells not finite", cells(), on(FAULTY, lambda: points(4, np.nan), lambda: points(4)))
gather("cells on one", cells(), on(FAULTY, lambda: points(4), vtkPolyData))
gather("cells none has any", cells(), vtkPolyData())
gather("cells mass", cells(), points(4), piece())
gather("relaxation right", relaxation(), points(4), piece())
gather("relaxation mesh", relaxation(), points(4), rectilinear(piece()))
gather("relaxation not a number", relaxation(), points(4), with_value(np.nan))
gather("solid on one", solid(), on(FAULTY, sphere, vtkPolyData))
gather("solid whole", solid(), sphere())
gather("solid open", solid(), on(FAULTY, lambda: sphere(120.0), vtkPolyData))
gather("solid none has any", solid(), vtkPolyData())
gather("disk right", disk(), plane())
gather("disk apart", disk(), on(FAULTY, vtkPolyData, plane))
gather("disk short", disk(), short(plane(), "Cell"))
gather("cells short", cells(), short(points(4)))
gather("relaxation short", relaxation(), short(points(4)), short(piece(), "Cell"))
gather("solid short", solid(), on(FAULTY, lambda: short(sphere()), vtkPolyData))
report("map short", vtkTransportMap(), producer(short(piece(), "Cell")))
report("map mesh short", vtkTransportMap(), producer(short(rectilinear(piece()), "Cell")))

source = vtkTrivialProducer()
source.SetOutput(piece())
source.SetWholeExtent(WHOLE)
algorithm = vtkTransportSampler()
algorithm.SetNumberOfParticles(60)
algorithm.SetRandomSeed(RANK)
report("different seeds", algorithm, source)

# An abort on one rank.
algorithm = vtkTransportSampler()
algorithm.SetNumberOfParticles(60)
if RANK == FAULTY:
    algorithm.AddObserver("ProgressEvent", lambda caller, _event: caller.SetAbortExecute(1))
report("abort", algorithm, produce(piece()))

report_blends()

# A rank that does not come; afterwards all do.
algorithm = vtkTransportSampler()
algorithm.SetNumberOfParticles(60)
if RANK == FAULTY:
    results["missing"] = [0, []]
    RANKS.Barrier()
else:
    report("missing", algorithm, source)
algorithm = vtkTransportSampler()
algorithm.SetNumberOfParticles(60)
report("afterwards", algorithm, source)


def points(count=40, last=None, **arrays):
    """Of this rank, in the whole image; the last one elsewhere."""
    data = vtkPolyData()
    places = vtkPoints()
    for i in range(count):
        places.InsertNextPoint(i % 7 * 0.9, i % 5, 4 * RANK + i % 11 * 0.4)
    if last:
        places.SetPoint(count - 1, last)
    data.SetPoints(places)
    for name, values in arrays.items():
        array = numpy_to_vtk(np.array(values, dtype=float), deep=1)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def weights(value=1.0):
    return points(Mass=[1.0] * 39 + [value])


NONE = points(0)
POINTS = {
    "right": points,
    "weighed": weights,
    "one has none": lambda: on(FAULTY, lambda: NONE, points),
    "first has none": lambda: on(0, lambda: NONE, points),
    "one has all": lambda: on(FAULTY, points, lambda: NONE),
    "none has any": lambda: NONE,
    "not finite": lambda: on(FAULTY, lambda: points(last=(np.nan, 0, 0)), points),
    "not a number": lambda: on(FAULTY, lambda: weights(np.nan), weights),
    "array": lambda: on(FAULTY, points, weights),
    "outside": lambda: points(last=(-9, 0, 0)),
    "too much": lambda: weights(1e308),
}


def report_points(name, algorithm, data, other=None):
    """Of a filter with points, and an image or none: also its warnings and a number of the result."""
    heard = Listener(algorithm)
    algorithm.SetInputData(data)
    if other:
        image = vtkTrivialProducer()
        image.SetOutput(other)
        image.SetWholeExtent(WHOLE)
        algorithm.SetInputConnection(1, image.GetOutputPort())
    algorithm.UpdatePiece(RANK, RANKS.GetNumberOfProcesses(), 0)
    output = algorithm.GetOutput()
    own = [error.splitlines() for error in heard.errors
           if "returned failure for request" not in error]
    image = output.IsA("vtkImageData")
    field = output.GetFieldData().GetArray("TotalMass") if image else None
    results[name] = [output.GetNumberOfCells() if image else output.GetNumberOfRows(),
                     [" ".join(lines) for lines in own],
                     [line for text in heard.warnings for line in text.splitlines() if "of" in line],
                     field.GetValue(0) if field else 0,
                     output.GetFieldData().GetArray("OutsidePoints").GetValue(0) if field else 0]
    RANKS.Barrier()


def splatter(data):
    algorithm = vtkMassSplatter()
    algorithm.SetDimensions(6, 5, 12)
    algorithm.SetAssociationToCells()
    if data.GetPointData().GetArray("Mass") or name == "array":
        algorithm.SetInputArrayToProcess(0, 0, 0, 0, "Mass")
    return algorithm


for name, make in POINTS.items():
    report_points("splat " + name, splatter(make()), make())
    report_points("reference " + name, splatter(make()), make(), piece())
    report_points("quality " + name, vtkTransportQuality(), make(), piece())
# One point outside of as many on all ranks.
for name, count in (("one of 1000", 1000), ("one of 1001", 1001)):
    given = points(count // 3 + (RANK < count % 3), (-9, 0, 0) if RANK == FAULTY else None)
    report_points("reference " + name, splatter(given), given, piece())
for name, image in (("spacing", IMAGES["spacing"]), ("gap", IMAGES["gap"])):
    report_points("reference " + name, splatter(points()), points(), image())
for name, wrong in (("splat wrong property", lambda: -1), ("splat wrong on one", lambda: on(
        FAULTY, lambda: -1, lambda: 5))):
    algorithm = splatter(points())
    algorithm.SetDimensions(5, 5, wrong())
    report_points(name, algorithm, points())
for name, kind in (("splat abort", vtkMassSplatter), ("quality abort", vtkTransportQuality)):
    algorithm = kind()
    if RANK == FAULTY:
        algorithm.AddObserver("ProgressEvent", lambda caller, _event: caller.SetAbortExecute(1))
    report_points(name, algorithm, points(), piece())
if RANK == FAULTY:
    results["splat missing"] = [0, [], [], 0]
    RANKS.Barrier()
else:
    report_points("splat missing", splatter(points()), points())
report_points("splat afterwards", splatter(points()), points())
# One rank alone, as with an image: the others do not come.
if RANK == 0:
    algorithm = splatter(points())
    algorithm.SetInputData(points())
    algorithm.Update()
    results["splat alone"] = [algorithm.GetOutput().GetNumberOfCells(), [], [], 0]
RANKS.Barrier()
with open("%s.%d" % (sys.argv[1], RANK), "w", encoding="utf-8") as file:
    json.dump(results, file)
print("WROTE", RANK, flush=True)

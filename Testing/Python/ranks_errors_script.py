# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksErrors.py runs on each of three ranks: images with a fault on one of them. Each rank
writes the messages of the filter and how much it has of the output."""
import json
import sys

import numpy as np
from rectifiedtransport import (vtkTransportBarycenter, vtkTransportInterpolator, vtkTransportMap,
                                vtkTransportSampler)
from rt_testing import Listener
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
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


def update(algorithm):
    """Returns the messages."""
    errors = Listener(algorithm).errors
    algorithm.SetNumberOfSteps(8)
    algorithm.UpdatePiece(RANK, RANKS.GetNumberOfProcesses(), 0)
    own = [error.splitlines() for error in errors if "returned failure for request" not in error]
    return [" ".join(lines) for lines in own]


def report(name, algorithm, source):
    algorithm.SetInputConnection(source.GetOutputPort())
    messages = update(algorithm)
    results[name] = [algorithm.GetOutput().GetNumberOfPoints(), messages]
    RANKS.Barrier()


def produce(data):
    source = vtkTrivialProducer()
    source.SetOutput(data)
    if data.IsA("vtkImageData"):
        source.SetWholeExtent(WHOLE)
    return source


def report_blend(name, algorithm):
    """Of the particles; the cells of the density, too."""
    messages = update(algorithm)
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
        piece(), on(FAULTY, vtkPolyData, piece)))
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

for name, wrong in (("wrong property", lambda: -1), ("wrong on one", lambda: on(
        FAULTY, lambda: -1, lambda: 60))):
    source = vtkTrivialProducer()
    source.SetOutput(piece())
    source.SetWholeExtent(WHOLE)
    algorithm = vtkTransportSampler()
    algorithm.SetNumberOfParticles(wrong())
    report(name, algorithm, source)

# An abort on one rank.
source = vtkTrivialProducer()
source.SetOutput(piece())
source.SetWholeExtent(WHOLE)
algorithm = vtkTransportSampler()
algorithm.SetNumberOfParticles(60)
if RANK == FAULTY:
    algorithm.AddObserver("ProgressEvent", lambda caller, _event: caller.SetAbortExecute(1))
report("abort", algorithm, source)

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
with open("%s.%d" % (sys.argv[1], RANK), "w", encoding="utf-8") as file:
    json.dump(results, file)
print("WROTE", RANK, flush=True)

# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksDevice.py runs on each rank: filters with a device, with none, and with none on the
last rank. Each rank writes its warnings and how much it has."""
import json
import os
import sys

from vtkmodules.vtkParallelCore import vtkMultiProcessController

RANKS = vtkMultiProcessController.GetGlobalController()
RANK, COUNT = RANKS.GetLocalProcessId(), RANKS.GetNumberOfProcesses()
KIND = sys.argv[2]
if KIND == "none" or (KIND == "last has none" and RANK == COUNT - 1):
    os.environ["OCL_ICD_VENDORS"] = "/nonexistent"  # before the driver is loaded

import numpy as np
import rectifiedtransport
from rt_filters import with_property
from rt_testing import Listener, digest, points_in, set_property
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer


def density(seed):
    """This rank's slab of an image."""
    low, high = 8 * RANK // COUNT, 8 * (RANK + 1) // COUNT
    image = vtkImageData()
    image.SetExtent(0, 6, 0, 5, low, high)
    values = 0.1 + np.random.default_rng(seed).random((8, 30))
    array = numpy_to_vtk(values[low:high].ravel(), deep=1)
    array.SetName("Density")
    image.GetCellData().SetScalars(array)
    source = vtkTrivialProducer()
    source.SetOutput(image)
    source.SetWholeExtent([0, 6, 0, 5, 0, 8])
    return source


one, other = density(1), density(2)
points = vtkTrivialProducer()
box = vtkImageData()
box.SetDimensions(7, 6, 9)
points.SetOutput(points_in(box))
SOURCES = {"density": [one], "densities": [one, other], "Target": [other], "mesh": [points]}

filters = {}  # all at once, so that devices stay open
for filter_ in with_property("Device"):
    algorithm = filters[filter_.name] = getattr(rectifiedtransport, filter_.class_name)()
    for port, (name, kind) in enumerate(filter_.inputs.items()):
        for source in SOURCES.get(name) or SOURCES[kind]:
            algorithm.AddInputConnection(port, source.GetOutputPort())
    for name, value in {**filter_.quick, "NumberOfSteps": 8}.items():
        set_property(algorithm, name, value)

results = {}
for name, algorithm in filters.items():
    messages = Listener(algorithm)
    given = results[name] = {}
    for device in (0, 1):
        algorithm.SetDevice(device)
        messages.warnings.clear()
        algorithm.UpdatePiece(RANK, COUNT, 0)
        given["OpenCL" if device else "CPU"] = {
            "digests": [digest(algorithm.GetOutputDataObject(port))
                        for port in range(algorithm.GetNumberOfOutputPorts())],
            "warnings": [" ".join(warning.split()) for warning in messages.warnings],
            "errors": messages.errors}
        RANKS.Barrier()
names = algorithm.GetDeviceNames()  # with OpenCL
results["devices"] = names.GetNumberOfValues() - 1
with open("%s.%d" % (sys.argv[1], RANK), "w", encoding="utf-8") as file:
    json.dump(results, file)
print("WROTE", flush=True)

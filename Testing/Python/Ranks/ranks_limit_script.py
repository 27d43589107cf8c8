# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksErrors.py runs on each of two ranks: the second has no memory for a surface that the
first one has. Each rank prints how many cells it has, and its messages."""
import json
import resource

from rectifiedtransport import vtkSolidDensity
from rt_testing import Listener
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkSphereSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController

RANKS = vtkMultiProcessController.GetGlobalController()
RANK = RANKS.GetLocalProcessId()
SPARE = 24 << 20  # bytes; the surface has about 40 million


def run(surface):
    solid = vtkSolidDensity()
    heard = Listener(solid)
    solid.SetResolution(8)
    solid.SetInputData(surface)
    solid.UpdatePiece(RANK, RANKS.GetNumberOfProcesses(), 0)
    return [solid.GetOutput().GetNumberOfCells(),
            [error for error in heard.errors if "returned failure for request" not in error]]


cylinder = vtkCylinderSource()
cylinder.Update()
run(cylinder.GetOutput())  # loads what it needs
sphere = vtkSphereSource()
sphere.SetThetaResolution(900)
sphere.SetPhiResolution(900)
if RANK == 0:
    sphere.Update()
else:
    with open("/proc/self/statm", encoding="ascii") as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + SPARE, used + SPARE))
given = run(sphere.GetOutput() if RANK == 0 else vtkPolyData())
print("GIVEN " + json.dumps([RANK, *given]) + "\n", end="", flush=True)

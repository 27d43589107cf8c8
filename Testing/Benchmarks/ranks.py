# SPDX-License-Identifier: BSD-3-Clause
"""Time and memory of a filter on several ranks, without threads:

    mpirun -np 2 pvbatch --sym ranks.py PLUGIN map 256      # Transport Map, a sample a cell of 256^3
    mpirun -np 2 pvbatch --sym ranks.py PLUGIN 2000000 256  # Sample Density, so many particles
    mpirun -np 2 pvbatch --sym ranks.py PLUGIN quality 256  # Transport Quality of 4 million points

Each rank prints its peak of memory less that of an idle rank, one that has loaded the plugin and
run the filter on a small image."""
import sys
import time

from paraview import simple
from vtkmodules.vtkParallelCore import vtkMultiProcessController

PLUGIN, WHAT, SIZE = sys.argv[1], sys.argv[2], int(sys.argv[3])
RANKS = vtkMultiProcessController.GetGlobalController()


def peak():
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024


def filter_on(image):
    settings = dict(Input=image, Tables="Tiled", Threading="Serial", NegativeValues="Clamp")
    if WHAT == "map":
        return simple.TransportMap(**settings)
    if WHAT == "quality":
        last = SIZE - 1
        settings["Density"] = settings.pop("Input")
        return simple.TransportQuality(Input=simple.UniformSeeds(
            Pattern="Jittered", NumberOfPoints=4000000, Bounds=[0, last] * 3), **settings)
    return simple.SampleDensity(NumberOfParticles=int(WHAT), SampleArrays=0, **settings)


simple.LoadPlugin(PLUGIN, remote=False, ns=vars(simple))
last = SIZE - 1
simple.SampleDensity(Input=simple.Wavelet(), NumberOfParticles=100,
                     NegativeValues="Clamp").UpdatePipeline()
idle = peak()
# Mass about the middle: as many particles come to lie on each rank.
source = simple.Wavelet(WholeExtent=[0, last, 0, last, 0, last], Center=[last / 2] * 3)
source.UpdatePipeline()
RANKS.Barrier()
start = time.perf_counter()
filter_on(source).UpdatePipeline()
RANKS.Barrier()
print("rank %d of %d: %.0f MB, %.1f s" % (
    RANKS.GetLocalProcessId(), RANKS.GetNumberOfProcesses(), peak() - idle,
    time.perf_counter() - start), flush=True)

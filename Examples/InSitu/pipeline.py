# SPDX-License-Identifier: BSD-3-Clause
"""What Catalyst runs on each rank of simulation.py, on the rows of cells that the rank has: Sample
Density, with the same seeds each time, so that SeedId i is one particle through all of them.

Writes, into the current folder, the particles of three moments, each rank its own, and the
trajectories of some of them. PARTICLES in the environment is their number.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import numpy as np
import rectified_example as example
from mpi4py import MPI
from paraview import catalyst, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

PARTICLES = int(os.environ.get("PARTICLES", 4000))
FOLLOWED = 64  # one particle of so many has its trajectory kept
WRITTEN = (0, 640, 1280)  # steps
RANKS = MPI.COMM_WORLD

options = catalyst.Options()
example.load_plugin()
ink = simple.TrivialProducer(registrationName="ink")
particles = simple.SampleDensity(ink, NumberOfParticles=PARTICLES)
particles.DensityArray = ["CELLS", "Ink"]
followed = []  # of each moment: SeedId, time and position of those that are here
here = np.empty(0, int)


def check(seeds, step):
    """Every particle is on one rank."""
    found = RANKS.allreduce(np.bincount(seeds, minlength=PARTICLES))
    if not (found == 1).all():
        print("Step %d: %d particles are missing, %d are there more than once"
              % (step, (found == 0).sum(), (found > 1).sum()), file=sys.stderr, flush=True)
        RANKS.Abort(1)


def catalyst_execute(info):
    global here
    particles.UpdatePipeline(info.time)
    data = particles.GetClientSideObject().GetOutputDataObject(0)
    seeds = vtk_to_numpy(data.GetPointData().GetArray("SeedId")) if data.GetNumberOfPoints() \
        else np.empty(0, int)
    check(seeds, info.timestep)
    if len(seeds):
        kept = seeds % FOLLOWED == 0
        positions = vtk_to_numpy(data.GetPoints().GetData())[kept]
        times = np.full(len(positions), info.time)
        followed.append(np.column_stack([seeds[kept], times, positions]))

    come = len(np.setdiff1d(seeds, here)) if info.timestep > 0 else 0
    here = seeds.copy()
    counts = RANKS.gather((len(seeds), come))
    if info.timestep in WRITTEN:
        simple.SaveData("particles-%04d.pvtp" % info.timestep, proxy=particles, DataMode="Binary")
        if RANKS.rank == 0:
            print("%.1f s  %d  %s  %d" % (
                info.time, sum(count for count, _ in counts),
                " + ".join("%d" % count for count, _ in counts), sum(come for _, come in counts)),
                flush=True)


def catalyst_finalize():
    """The first rank joins the trajectories, which went from rank to rank, and writes them."""
    parts = RANKS.gather(np.concatenate(followed) if followed else np.empty((0, 5)))
    if RANKS.rank == 0:
        rows = np.concatenate(parts)
        write_trajectories(rows[np.lexsort((rows[:, 1], rows[:, 0]))])


def write_trajectories(rows):
    """Lines through the positions of a particle, one line a SeedId."""
    lines = vtkPolyData()
    lines.SetPoints(vtkPoints())
    lines.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(rows[:, 2:]), deep=1))
    lines.SetLines(vtkCellArray())
    ends = np.flatnonzero(np.append(np.diff(rows[:, 0]), 1)) + 1
    for first, last in zip([0, *ends], ends):
        lines.GetLines().InsertNextCell(last - first, range(first, last))
    for name, column in (("SeedId", rows[:, 0].astype(int)), ("Time", rows[:, 1])):
        array = numpy_to_vtk(np.ascontiguousarray(column), deep=1)
        array.SetName(name)
        lines.GetPointData().AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName("trajectories.vtp")
    writer.SetDataModeToBinary()
    writer.SetInputData(lines)
    writer.Write()

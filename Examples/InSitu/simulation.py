# SPDX-License-Identifier: BSD-3-Clause
"""Ink that two gyres stir and diffusion spreads, on the ranks of MPI, sampled in situ:

    mpirun -np 2 python3 simulation.py

Each rank has some rows of the cells, and a row of each neighbour for the fluxes between them. After
every so many steps ParaView Catalyst runs pipeline.py on the rows where they are; they are never
written. Cells do not depend on the number of ranks, to the last bit.
"""
import os

import numpy as np
from mpi4py import MPI
from paraview.catalyst import bridge
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

CELLS = (256, 128)  # along x and y, of a box of 2 x 1
SPACING = 1 / 128
SPEED, SWAY, PERIOD = 0.1, 0.3, 4.0  # of the gyres, and of the wall between them
DIFFUSION = 5e-5
STEP = 0.005  # a cell's width takes at least three steps
STEPS, STEPS_OF_A_PICTURE = 1280, 32


class Rows:
    """The rows of cells of a rank, with a row of each neighbour below and above."""

    def __init__(self, ranks):
        self.ranks = ranks
        self.first, self.last = (CELLS[1] * rank // ranks.size
                                 for rank in (ranks.rank, ranks.rank + 1))
        self.below = ranks.rank - 1 if self.first > 0 else MPI.PROC_NULL
        self.above = ranks.rank + 1 if self.last < CELLS[1] else MPI.PROC_NULL
        self.ink = np.zeros((self.last - self.first + 2, CELLS[0]))
        self.own = self.ink[1:-1]
        self.own[:] = self.start()

    def start(self):
        """Two drops on pale ground."""
        x = (np.arange(CELLS[0]) + 0.5) * SPACING
        y = (np.arange(self.first, self.last)[:, None] + 0.5) * SPACING
        drops = [(x - at[0]) ** 2 + (y - at[1]) ** 2 for at in ((0.45, 0.3), (1.3, 0.55))]
        return 0.05 + sum(1 / (1 + (squares / 0.03) ** 4) for squares in drops)

    def fill_neighbours(self):
        self.ranks.Sendrecv(self.own[-1], self.above, recvbuf=self.ink[0], source=self.below)
        self.ranks.Sendrecv(self.own[0], self.below, recvbuf=self.ink[-1], source=self.above)

    def stream(self, time):
        """The stream function at the corners of the cells, 0 at the walls: no fluid is lost."""
        along = np.arange(CELLS[0] + 1) * SPACING
        sway = SWAY * np.sin(2 * np.pi * time / PERIOD)
        x = np.sin(np.pi * (sway * along ** 2 + (1 - 2 * sway) * along))
        y = np.sin(np.pi * np.arange(CELLS[1] + 1) * SPACING)
        x[0] = x[-1] = y[0] = y[-1] = 0
        return SPEED * y[self.first:self.last + 1, None] * x

    def advance(self, time):
        """One step, with fluxes upwind: the ink of all ranks stays the same."""
        self.fill_neighbours()
        stream = self.stream(time)
        right = -np.diff(stream, axis=0)[:, 1:-1]
        up = np.diff(stream, axis=1)
        across = flux(self.own[:, :-1], self.own[:, 1:], right)
        along = flux(self.ink[:-1], self.ink[1:], up)
        if self.below == MPI.PROC_NULL:
            along[0] = 0
        if self.above == MPI.PROC_NULL:
            along[-1] = 0
        change = -np.diff(along, axis=0)
        change[:, :-1] -= across
        change[:, 1:] += across
        self.own += STEP / SPACING ** 2 * change

    def image(self):
        """The own cells for VTK, which looks at this array and copies nothing."""
        image = vtkImageData()
        image.SetExtent(0, CELLS[0], self.first, self.last, 0, 0)
        image.SetSpacing(SPACING, SPACING, 1)
        values = numpy_to_vtk(self.own.reshape(-1))
        values.SetName("Ink")
        image.GetCellData().SetScalars(values)
        return image


def flux(before, after, fluid):
    """The ink that passes from cells to their neighbours in a second, with so much fluid."""
    return np.where(fluid > 0, fluid * before, fluid * after) - DIFFUSION * (after - before)


def main():
    rows = Rows(MPI.COMM_WORLD)
    bridge.initialize()
    bridge.add_pipeline(os.path.join(os.path.dirname(os.path.abspath(__file__)), "pipeline.py"), 2)
    for step in range(STEPS + 1):
        time = step * STEP
        if step % STEPS_OF_A_PICTURE == 0:
            bridge.coprocess(time, step, rows.image(), "ink", (0, CELLS[0], 0, CELLS[1], 0, 0))
        rows.advance(time)
    bridge.finalize()


if __name__ == "__main__":
    main()

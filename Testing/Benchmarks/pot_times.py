# SPDX-License-Identifier: BSD-3-Clause
"""Times POT (python3-pot) on the pair "uniform → photograph" of run.py --bounds, at few pixels."""

import os
import time

import numpy
import ot
from PIL import Image

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data")


def ink():
    """As PhotographInput.h has it: 1024 x 1024, the last 256 rows mirrored below."""
    with Image.open(os.path.join(DATA, "raccoon.png")) as picture:
        pixels = numpy.asarray(picture.convert("RGB"), float)
    dark = 255 - pixels @ (0.2126, 0.7152, 0.0722)
    return numpy.concatenate((dark, dark[:-257:-1]))


def timed(solve, *arguments, **options):
    begin = time.process_time()
    cost = float(numpy.ravel(solve(*arguments, **options))[0])
    return f"{cost:.6g} in {time.process_time() - begin:.2f} s"


def main():
    whole = ink()
    for side in (32, 48, 64):
        edges = numpy.arange(side) * len(whole) // side
        masses = numpy.add.reduceat(numpy.add.reduceat(whole, edges, 0), edges, 1).ravel()
        masses /= masses.sum()
        uniform = numpy.full(side * side, 1 / side**2)
        axis = (numpy.arange(side) + 0.5) / side
        centres = numpy.stack(numpy.meshgrid(axis, axis), -1).reshape(-1, 2)
        costs = ot.dist(centres, centres)
        print(f"{side}²: {costs.nbytes / 1e6:.0f} MB of costs;",
              "emd", timed(ot.emd2, uniform, masses, costs, numItermax=10**8) + ";",
              "sinkhorn, reg 0.001, 2000 iterations",
              timed(ot.sinkhorn2, uniform, masses, costs, reg=1e-3, numItermax=2000), flush=True)


if __name__ == "__main__":
    main()

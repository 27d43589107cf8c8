# SPDX-License-Identifier: BSD-3-Clause
"""Times POT (python3-pot) on the pair "uniform → photograph" of run.py --bounds, at few pixels; with
--arrays beside rectifiedtransport.arrays, on one thread, on a ring and two discs, and on a blob that
moves. PYTHONPATH names the folder of the package."""

import os
import sys
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


def seconds(solve, *arguments, **options):
    """A result, and the processor's time that it took."""
    begin = time.process_time()
    result = solve(*arguments, **options)
    return result, time.process_time() - begin


def timed(solve, *arguments, **options):
    result, took = seconds(solve, *arguments, **options)
    return f"{float(numpy.ravel(result)[0]):.6g} in {took:.2f} s"


def centres_of(side):
    """The middles of the pixels of the unit square."""
    axis = (numpy.arange(side) + 0.5) / side
    return numpy.stack(numpy.meshgrid(axis, axis), -1).reshape(-1, 2)


def share(values):
    return (values / values.sum()).ravel()


def ring_and_discs(side):
    x, y = centres_of(side).T
    ring = numpy.abs(numpy.hypot(x - 0.5, y - 0.5) - 0.3) < 0.08
    discs = numpy.minimum(numpy.hypot(x - 0.25, y - 0.3), numpy.hypot(x - 0.75, y - 0.6)) < 0.15
    return [(density + 0.01).reshape(side, side) for density in (ring, discs)]


def bump(side, middle):
    """Smooth, a quarter of the square wide, with its middle at a place."""
    x, y = (centres_of(side) - middle).T
    return (numpy.maximum(0.125 ** 2 - x ** 2 - y ** 2, 0) ** 2).reshape(side, side)


def beside_arrays():
    from rectifiedtransport import arrays

    print("W2 of a ring and two discs in the unit square")
    for side in 32, 48, 64, 256, 1024:
        a, b = ring_and_discs(side)
        found, took = seconds(arrays.distance, a, b, spacing=1 / side, Threading="Serial")
        print(f"{side}²: from {found.lower:.6f} to {found.upper:.6f} in {took:.3f} s", end="")
        if side <= 64:
            centres = centres_of(side)
            cost, took = seconds(lambda: ot.emd2(share(a), share(b), ot.dist(centres, centres),
                                                 numItermax=10**8))
            print(f"; emd2 {cost ** 0.5:.6f} in {took:.2f} s", end="")
        print(flush=True)

    print("The barycenter of a bump at two places: how much of its mass is elsewhere than halfway")
    for side in 64, 128:
        a, b = bump(side, (0.25, 0.25)), bump(side, (0.75, 0.5))
        halfway = share(bump(side, (0.5, 0.375)))
        runs = {"barycenter": lambda: arrays.barycenter([a, b], Threading="Serial"),
                "barycenter, Optimal": lambda: arrays.barycenter([a, b], Method="Optimal",
                                                                 Threading="Serial"),
                "convolutional_barycenter2d, reg 0.004": lambda: ot.bregman.convolutional_barycenter2d(
                    numpy.stack([values / values.sum() for values in (a, b)]), reg=4e-3)}
        for name, run in runs.items():
            found, took = seconds(run)
            off = numpy.abs(share(found) - halfway).sum() / 2
            print(f"{side}²: {name}: {100 * off:.1f} % in {took:.3f} s", flush=True)


def main():
    whole = ink()
    for side in (32, 48, 64):
        edges = numpy.arange(side) * len(whole) // side
        masses = numpy.add.reduceat(numpy.add.reduceat(whole, edges, 0), edges, 1).ravel()
        masses /= masses.sum()
        uniform = numpy.full(side * side, 1 / side**2)
        centres = centres_of(side)
        costs = ot.dist(centres, centres)
        print(f"{side}²: {costs.nbytes / 1e6:.0f} MB of costs;",
              "emd", timed(ot.emd2, uniform, masses, costs, numItermax=10**8) + ";",
              "sinkhorn, reg 0.001, 2000 iterations",
              timed(ot.sinkhorn2, uniform, masses, costs, reg=1e-3, numItermax=2000), flush=True)


if __name__ == "__main__":
    beside_arrays() if sys.argv[1:] == ["--arrays"] else main()

# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 10 of the paper: relaxation from points at random and from ours."""
import os
import sys
from types import SimpleNamespace

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_charts as charts
import rectified_example as example
import rectified_figures as figures
import rectified_relaxation as relaxing
from paraview import simple

ASCENT = os.path.join(example.DATA, "ascent.png")
STARTS = {"random": (0.80, 0.36, 0.10), "ours": (0.15, 0.35, 0.65)}
# The energy that the charts begin at: of the random start, after so many iterations.
CHARTED = {"GaussianBlueNoise": 0, "OptimalTransport": 1}
# Seconds of the paper, on 32 cores (AMD Ryzen Threadripper 2990WX).
PAPER = {("GaussianBlueNoise", "random"): "150 (1000 iterations)",
         ("GaussianBlueNoise", "ours"): "-",
         ("OptimalTransport", "random"): "1972", ("OptimalTransport", "ours"): "215"}


def relaxed(dots, image, method, arguments):
    """Points, energies and seconds at some iterations: each of a run of so many iterations."""
    def run(iterations, repeats):
        proxy, data, seconds = relaxing.timed(
            lambda: relaxing.relaxation(dots, image, method, MaximumIterations=iterations,
                                        Threading="Serial"), repeats=repeats)
        found = relaxing.places(data), relaxing.energies(data)
        simple.Delete(proxy)
        return (*found, seconds)

    runs = {n: run(n, arguments.repeats) for n in arguments.iterations}
    energy = runs[max(runs)][1]
    marks = sorted(runs)
    times = np.interp(np.arange(len(energy)), marks, [runs[n][2] for n in marks])
    return SimpleNamespace(points={n: runs[n][0] for n in marks}, energy=energy, times=times)


def first_below(run, energy):
    """The first iteration of a run whose energy is at most a given one, and its time, as words."""
    below = np.flatnonzero(run.energy <= energy)
    return ["%d" % below[0], "%.2f" % run.times[below[0]]] if len(below) else [
        "more than %d" % (len(run.energy) - 1), "-"]


def draw(points, side, radius, panel, stipple):
    """The middle half of the picture along each side."""
    dots = example.producer(figures.shape(points, [1] * len(points), "Verts"))
    picture = figures.drawn(stipple.write_png, dots, [side / 4, 3 * side / 4] * 2, radius, panel)
    simple.Delete(dots)
    return picture


def chart_of(method, runs, over, size):
    """The energies of the runs from both starts over the iterations or the time."""
    lines = [(start, np.arange(len(run.energy)) if over == "iterations" else run.times, run.energy,
              STARTS[start], sorted(run.points)) for start, run in runs.items()]
    low = 0.9 * min(run.energy[-1] for run in runs.values())
    first = CHARTED[method]
    high = 1.05 * max(runs["random"].energy[first], runs["ours"].energy[0])
    if high < 2 * low:  # close to each other: room for them
        low *= 1.08
    longest = max(line[1][-1] for line in lines)
    return charts.chart(lines, (over, "Energy"), ((0, longest), (low, high)), size)


def print_tables(found, ink, tables_of):
    rows, reached = [], []
    for (method, start), run in found.items():
        before, after = (relaxing.pixel_energy(run.points[n], ink)
                         for n in (min(run.points), max(run.points)))
        rows.append([method, start, "%d" % (len(run.energy) - 1), "%.2f" % run.times[-1],
                     "%.5f" % run.energy[0], "%.5f" % run.energy[-1], "%.5f" % before,
                     "%.5f" % after, "%+.2f %%" % (100 * (after / before - 1)),
                     PAPER[method, start]])
    figures.table(tables_of + "\nSeconds of one thread, without the start. Energy: the method's. "
                  "E: at the pixels' centres, for both methods.",
                  ["method", "start", "iterations", "seconds", "Energy before", "after",
                   "E before", "after", "change", "paper, seconds"], rows)
    for method in relaxing.METHODS:
        random, ours = found[method, "random"], found[method, "ours"]
        for n in sorted(random.points)[1:]:
            n = min(n, len(random.energy) - 1)
            reached.append([method, "%d" % n, "%.2f" % random.times[n],
                            "%.5f" % random.energy[n], *first_below(ours, random.energy[n])])
    figures.table("How soon our start has the energy of the random one",
                  ["method", "random: iterations", "seconds", "Energy", "ours: iterations",
                   "seconds"], reached)


def main():
    parser = example.parser(
        __doc__, small="--size 256 --particles 600 --iterations 1 5 20 --panel 128",
        image=example.file(ASCENT),
        size=example.number(1024, "pixels along the sides of the photograph", 8),
        particles=example.number(8192, "number of dots"),
        iterations=example.number([0, 1, 5, 20, 50], "that are drawn and timed", 0),
        repeats=example.number(1, "runs of which the median time counts"),
        panel=256)
    arguments = parser.parse_args()
    arguments.iterations = sorted({0, *arguments.iterations})
    if len(arguments.iterations) < 2:
        parser.error("--iterations has no number above 0")

    example.load_plugin()
    stipple = example.script("StippleImage")
    side, number = arguments.size, arguments.particles
    photograph = figures.grey_square(figures.photograph(arguments.image), side)
    ink = relaxing.BLACK - figures.values_of(photograph).astype(float)
    image = example.producer(photograph)
    starts = {"random": relaxing.start(image, number, SeedPattern="Random", FlowTime=0),
              "ours": relaxing.start(image, number, Threading="Serial")}
    print("Our start: %.3f s" % figures.seconds(starts["ours"]))
    starts["random"].UpdatePipeline()

    found = {(method, start): relaxed(dots, image, method, arguments)
             for method in relaxing.METHODS for start, dots in starts.items()}
    print_tables(found, ink, "%d dots, %d\u00b2 pixels of %s."
                 % (number, side, os.path.basename(arguments.image)))

    radius = relaxing.disc_radius(ink, number)
    pictures, plots = [], []
    for method in relaxing.METHODS:
        runs = {start: found[method, start] for start in STARTS}
        for start, run in runs.items():
            pictures.append([
                ("%s, %s, %d" % ({"GaussianBlueNoise": "GBN", "OptimalTransport": "OT"}[method],
                                 start, n), draw(points, side, radius, arguments.panel, stipple))
                for n, points in run.points.items()])
        size = [2 * arguments.panel, 5 * arguments.panel // 4]
        plots.append([("%s" % method, chart_of(method, runs, over, size))
                      for over in ("iterations", "seconds")])
    print("\n" + figures.write_montage(arguments, "figure10-points.png", pictures))
    arguments.panel *= 2
    print(figures.write_montage(arguments, "figure10-energy.png", plots))


if __name__ == "__main__":
    main()

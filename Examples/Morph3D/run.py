# SPDX-License-Identifier: BSD-3-Clause
"""Morphs one solid into another: two closed meshes, a density each, and surfaces in between."""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_shapes as shapes
from paraview import simple


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("shapes", nargs="*", default=["spot", "armadillo"],
                        help="two closed surfaces: names of rectified_shapes.py or files")
    parser.add_argument("--resolution", type=figures.at_least(8), default=96,
                        help="cells along the longest axis of a solid; the paper has 256")
    parser.add_argument("--frames", type=figures.at_least(2), default=5, help="pictures of it")
    parser.add_argument("--panel", type=figures.at_least(16), default=400,
                        help="side of each of the pictures")
    parser.add_argument("--output", default=".", help="folder of the picture")
    arguments = parser.parse_args()
    if len(arguments.shapes) != 2:
        parser.error("%d shapes are given; it must be two" % len(arguments.shapes))

    example.load_plugin()
    watch, times = shapes.Watch(), []

    def took(what, paper="-"):
        times.append([what, *("%.2f" % seconds for seconds in watch.lap()), paper])

    solids = []
    for name in arguments.shapes:
        mesh = example.producer(shapes.posed(name))
        watch.lap()
        solids.append(simple.SolidDensity(Input=mesh, Resolution=arguments.resolution))
        figures.result(solids[-1])
        took("solid of " + name)
    morph = simple.MorphDensities(Input=solids[0], Target=solids[1], Parameter=0,
                                  Kernel="Gaussian")
    contour = shapes.surface(morph)
    pictures = []
    for frame, t in enumerate(np.linspace(0, 1, arguments.frames)):
        watch.lap()
        morph.Parameter = t
        density = figures.result(morph)
        if frame == 0:
            took("maps, and the step t = 0", "815")
        else:
            took("step t = %.2f" % t, "3 with its surface")
        figures.result(contour)
        took("its surface")
        pictures.append(("t = %.2f" % t, shapes.lit(contour, shapes.mixed([1 - t, t]),
                                                    arguments.panel)))
    figures.table("Seconds; a grid of %d x %d x %d values and as many particles"
                  % density.GetDimensions(),
                  ["stage", "clock", "all processors", "paper, 256\u00b3, 32 cores"], times)
    print("\nAt most %.2f GiB of memory" % shapes.peak_memory())
    os.makedirs(arguments.output, exist_ok=True)
    path = os.path.join(arguments.output, "morph-3d-%s-%s.png" % tuple(
        os.path.splitext(os.path.basename(name))[0] for name in arguments.shapes))
    figures.montage(path, [pictures], arguments.panel)
    print(path)


if __name__ == "__main__":
    main()

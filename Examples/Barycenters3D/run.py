# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 13 of the paper: barycenters of three solids, in a triangle."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_shapes as shapes
from paraview import simple


def main():
    parser = example.parser(
        __doc__, small="--resolution 32 --rows 3 --panel 120",
        shapes=shapes.names(["spot", "eight", "bunny"],
                            "three closed surfaces, top, left and right", joined=False),
        resolution=96, rows=example.number(4, "rows of the triangle", 2), panel=360)
    arguments = parser.parse_args()
    if len(arguments.shapes) != 3:
        parser.error("%d shapes are given; it must be three" % len(arguments.shapes))

    example.load_plugin()
    solids = [simple.SolidDensity(example.producer(shapes.posed(name)),
                                  Resolution=arguments.resolution) for name in arguments.shapes]
    watch = shapes.Watch()
    for solid in solids:
        example.result(solid)
    voxels = watch.lap()
    # With the default of 32 steps one particle ends beside a solid, and the filter warns.
    mean = simple.DensityBarycenter(Input=solids, ParticlesPerCell=1, Kernel="Gaussian",
                                    NumberOfSteps=48)
    step, last = arguments.panel, arguments.rows - 1
    picture = np.full((arguments.rows * step, arguments.rows * step, 3), 255, np.uint8)
    times = []
    for row in range(arguments.rows):
        for column in range(row + 1):
            mean.Weights = [(last - row) / last, (row - column) / last, column / last]
            watch.lap()
            density = example.result(mean)
            surface = shapes.surface(density)
            times.append(watch.lap())
            left, low = round((last - row) / 2 * step) + column * step, (last - row) * step
            picture[low:low + step, left:left + step] = shapes.lit(
                surface, shapes.mixed(mean.Weights), step)
    figures.table("%d x %d x %d cells with as many particles: seconds" % density.GetDimensions(),
                  ["stage", "clock", "all processors", "paper, 256\u00b3, 32 cores"],
                  [[what, *("%.2f" % seconds for seconds in time), paper] for what, time, paper in
                   (("three solids", voxels, "-"),
                    ("three maps, the first barycenter and surface", times[0], "1394"),
                    ("another barycenter and surface", np.mean(times[1:], axis=0), "4"))])
    print("\nAt most %.2f GiB of memory" % shapes.peak_memory())
    path = example.output(arguments, "barycenters-3d.png")
    figures.save(path, picture)
    print(path)


if __name__ == "__main__":
    main()

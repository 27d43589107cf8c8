# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 12 of the paper: barycenters of the silhouettes of four real shapes."""
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
        __doc__, small="--size 64 --rows 3 --panel 96",
        shapes=shapes.names(["bunny", "coupling", "spot+bear", "knot"], "four shapes, top "
                            "left, top right, bottom left, bottom right"),
        size=256, particles=9, rows=example.number(5, "rows and columns of pictures", 2), panel=256)
    arguments = parser.parse_args()
    if len(arguments.shapes) != 4:
        parser.error("%d shapes are given; it must be four" % len(arguments.shapes))

    example.load_plugin()
    images = [example.producer(shapes.silhouette(name, arguments.size))
              for name in arguments.shapes]
    mean = simple.DensityBarycenter(Input=images, ParticlesPerCell=arguments.particles,
                                    **shapes.SMOOTH)
    watch, pictures, times = shapes.Watch(), [], []
    for down in np.linspace(0, 1, arguments.rows):
        line = []
        for right in np.linspace(0, 1, arguments.rows):
            mean.Weights = np.outer([1 - down, down], [1 - right, right]).ravel().tolist()
            watch.lap()
            image = example.result(mean)
            times.append(watch.lap())
            line.append(("", shapes.inked(image, shapes.mixed(mean.Weights))))
        pictures.append(line)
    figures.table("%d\u00b2 pixels with %d particles each" % (arguments.size, arguments.particles),
                  ["seconds", "clock", "all processors"],
                  [[what, *("%.3f" % seconds for seconds in time)] for what, time in
                   (("four maps, and the first barycenter", times[0]),
                    ("another barycenter", np.mean(times[1:], axis=0)),
                    ("all %d barycenters" % len(times), np.sum(times, axis=0)))])
    print("\n" + figures.write_montage(arguments, "barycenters-2d.png", pictures, caption=0))


if __name__ == "__main__":
    main()

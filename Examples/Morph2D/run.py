# SPDX-License-Identifier: BSD-3-Clause
"""Morphs silhouettes of real shapes: one piece into two, and holes into other holes."""
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
        __doc__, small="--size 64 --frames 3 --panel 96",
        shapes=shapes.names(["bunny", "camel+dinosaur", "knot", "coupling", "bull", "rings"],
                            "pairs of shapes, a morph each"),
        size=256, particles=9, frames=7, panel=256)
    arguments = parser.parse_args()
    pairs = shapes.pairs(parser, arguments.shapes)

    example.load_plugin()
    rows, pictures = [], []
    for pair in pairs:
        images = [example.producer(shapes.silhouette(name, arguments.size)) for name in pair]
        morph = simple.MorphDensities(images[0], Target=images[1],
                                      ParticlesPerCell=arguments.particles, Parameter=0,
                                      **shapes.SMOOTH)
        watch, line, times = shapes.Watch(), [], []
        for t in np.linspace(0, 1, arguments.frames):
            morph.Parameter = t
            image = example.result(morph)
            times.append(watch.lap())
            line.append(("t = %.2f" % t, shapes.inked(image, shapes.mixed([1 - t, t]))))
            watch.lap()
        rows.append(["%s to %s" % pair, *("%.3f / %.3f" % tuple(time) for time in
                             (times[0], np.mean(times[1:], axis=0), np.sum(times, axis=0)))])
        pictures.append(line)
    figures.table("%d\u00b2 pixels with %d particles each: seconds of the clock / of all "
                  "processors" % (arguments.size, arguments.particles),
                  ["morph", "maps and a frame", "another frame",
                   "%d frames" % arguments.frames], rows)
    print("\n" + figures.write_montage(arguments, "morph-2d.png", pictures))


if __name__ == "__main__":
    main()

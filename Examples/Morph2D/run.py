# SPDX-License-Identifier: BSD-3-Clause
"""Morphs silhouettes of real shapes: one piece into two, and holes into other holes."""
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
    parser.add_argument("shapes", nargs="*", default=["bunny", "camel+dinosaur", "knot",
                                                      "coupling", "bull", "rings"],
                        help="pairs of shapes, a morph each: names of rectified_shapes.py or files "
                        "of surfaces, or two joined by + to be side by side")
    parser.add_argument("--size", type=figures.at_least(8), default=256,
                        help="pixels along the sides of the images")
    parser.add_argument("--particles", type=figures.at_least(1), default=9,
                        help="particles a pixel; the paper has 1")
    parser.add_argument("--frames", type=figures.at_least(2), default=7, help="pictures of a morph")
    parser.add_argument("--panel", type=figures.at_least(16), default=256,
                        help="side of each of the pictures")
    parser.add_argument("--output", default=".", help="folder of the picture")
    arguments = parser.parse_args()
    pairs = shapes.pairs(parser, arguments.shapes)

    example.load_plugin()
    rows, pictures = [], []
    for pair in pairs:
        images = [example.producer(shapes.silhouette(name, arguments.size)) for name in pair]
        morph = simple.MorphDensities(Input=images[0], Target=images[1],
                                      ParticlesPerCell=arguments.particles, Parameter=0,
                                      **shapes.SMOOTH)
        watch, line, times = shapes.Watch(), [], []
        for t in np.linspace(0, 1, arguments.frames):
            morph.Parameter = t
            image = figures.result(morph)
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
    os.makedirs(arguments.output, exist_ok=True)
    path = os.path.join(arguments.output, "morph-2d.png")
    figures.montage(path, pictures, arguments.panel)
    print("\n" + path)


if __name__ == "__main__":
    main()

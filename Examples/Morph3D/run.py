# SPDX-License-Identifier: BSD-3-Clause
"""Morphs one solid into another: two closed meshes, a density each, and surfaces in between."""
import itertools
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_shapes as shapes
from paraview import simple


def morph(names, method, options):
    """Pictures of a morph by a method, the size of its grid, and how long what took."""
    watch, times = shapes.Watch(), []

    def took(what, paper="-"):
        times.append([what, *("%.2f" % seconds for seconds in watch.lap()), paper])

    solids = []
    for name in names:
        mesh = example.producer(shapes.posed(name))
        watch.lap()
        solid = simple.SolidDensity(mesh, Resolution=options.resolution)
        density = example.result(solid)
        if options.cube:
            solid = example.producer(shapes.cubed(density, options.resolution))
        took("solid of " + name)
        solids.append(solid)
    between = simple.MorphDensities(solids[0], Target=solids[1], ParticlesPerCell=1,
                                    Kernel=options.kernel, Method=method)
    pictures = []
    for t in np.linspace(0, 1, options.frames):
        watch.lap()
        between.Parameter = t
        density = example.result(between)
        took(*("step t = %.2f" % t, "3") if pictures else ("the maps, step t = 0", "815"))
        surface = shapes.surface(density)
        took("its surface", "with the step")
        words = "t = %.2f" % t if len(options.method) == 1 else "%s, t = %.2f" % (method, t)
        pictures.append((words, shapes.lit(surface, shapes.mixed([1 - t, t]), options.panel)))
    return pictures, density.GetDimensions(), times


def main():
    parser = example.parser(
        __doc__, small="--resolution 32 --frames 3 --panel 120",
        shapes=shapes.names(["spot", "bunny", "spot", "eight"],
                            "pairs of closed surfaces, a morph each", joined=False),
        resolution=128,
        cube=dict(action="store_true",
                  help="grow the boxes of the solids to cubes, as the paper has them"),
        kernel=dict(default="Gaussian",
                    choices=["Gaussian", "CloudInCell", "TriangularShapedCloud"],
                    help="how a particle's mass is spread"),
        method=dict(nargs="+", default=["RectifiedFlow"], choices=["RectifiedFlow", "Optimal"],
                    help="by which map; a row for each"),
        frames=5, panel=400)
    arguments = parser.parse_args()
    pairs = shapes.pairs(parser, arguments.shapes)

    example.load_plugin()
    pictures = []
    for pair, method in itertools.product(pairs, arguments.method):
        line, size, times = morph(pair, method, arguments)
        figures.table("%s to %s by %s on %d x %d x %d cells with as many particles: seconds"
                      % (*pair, method, *size),
                      ["stage", "clock", "all processors", "paper, 256\u00b3, 32 cores"], times)
        pictures.append(line)
    print("\nAt most %.2f GiB of memory" % shapes.peak_memory())
    print(figures.write_montage(arguments, "morph-3d.png", pictures))


if __name__ == "__main__":
    main()

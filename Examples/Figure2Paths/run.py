# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 2 of the paper: paths in space and time to a density in one dimension."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

HEIGHT = 0.55  # of the paths' part of the picture, of its width; so are these:
DENSITY = 0.16
MARGIN = 0.06


def two_gaussians(cells):
    """A sum of two Gaussians at the centres of the cells."""
    x = (np.arange(cells) + 0.5) / cells
    return (np.exp(-0.5 * ((x - 0.3) / 0.07) ** 2)
            + 0.7 * np.exp(-0.5 * ((x - 0.72) / 0.1) ** 2))


def line_image(density):
    """A line of cells of length 1 that hold a density."""
    image = vtkImageData()
    image.SetDimensions(len(density) + 1, 1, 1)
    array = numpy_to_vtk(density, deep=1)
    array.SetName("Density")
    image.GetCellData().SetScalars(array)
    return example.producer(image)


def exact_ends(density, seeds):
    """Where transport takes seeds: the inverse of the cumulative sum, which is unique in 1D."""
    sums = np.concatenate([[0], np.cumsum(density)])
    return np.interp(seeds / len(density) * sums[-1], sums, np.arange(len(sums)))


def seed_points(seeds):
    """Points on the line, as another input of Sample Density."""
    points = np.stack([seeds, 0 * seeds], axis=1)
    return example.producer(figures.shape(points, [1] * len(seeds), "Verts"))


def ends_of(transport, **options):
    """Seeds and ends of particles that flow with options of Sample Density."""
    data = example.result(transport, **options)
    seeds = vtk_to_numpy(data.GetPointData().GetArray("SeedPosition"))[:, 0]
    return seeds, vtk_to_numpy(data.GetPoints().GetData())[:, 0]


def print_errors(density, particles, start):
    transport = simple.SampleDensity(line_image(density), SeedPattern="Lattice",
                                     NumberOfParticles=particles)
    runs = [("%s, N = %d" % run, {"Integrator": run[0], "NumberOfSteps": run[1]})
            for run in [("Multistep", n) for n in (8, 16, 32, 64, 128)] + [("RungeKutta4", 50)]]
    rows = []
    for name, options in [*runs, ("Adaptive", {"Integrator": "Adaptive"})]:
        seeds, ends = ends_of(transport, **options)
        errors = np.abs(ends - exact_ends(density, seeds))
        rows.append([name, *("%.4f" % e for e in (errors.mean(), np.quantile(errors, 0.99),
                                                  errors.max())), "-"])
    figures.table("%d particles against the inverse of the cumulative sum, in cells" % particles,
                  ["ours", "mean error", "99 % below", "largest", "paper"], rows)

    one = simple.SampleDensity(line_image(density), Seeds=seed_points(np.array([start])))
    end = ends_of(one)[1][0]
    figures.table("The particle of the purple curve, in cells",
                  ["curve", "ours, N = 32", "exact", "paper"],
                  [["start", "%.2f" % start, "%.2f" % start, "256"],
                   ["end", "%.2f" % end, "%.2f" % exact_ends(density, start), "drawn only"]])


def paths_of(density, seeds, steps=128):
    """The paths of seeds: x and t, with rows for the seeds."""
    paths = simple.SampleDensity(line_image(density), Seeds=seed_points(seeds),
                                 OutputPaths=1, NumberOfSteps=steps)
    data = example.result(paths)
    x = vtk_to_numpy(data.GetPoints().GetData())[:, 0].reshape(len(seeds), -1)
    return x, vtk_to_numpy(data.GetPointData().GetArray("Time")).reshape(len(seeds), -1)


def draw(density, number, start, pixels):
    """Space to the right and time upwards, the density on top, and the box B' of one moment."""
    cells = len(density)
    top = HEIGHT * cells
    seeds = (np.arange(number) + 0.5) * cells / number
    x, t = paths_of(density, np.append(seeds, start))
    moment = t.shape[1] * 5 // 8
    here, now = x[-1, moment], t[-1, moment]
    left, right = max(0, cells - (cells - here) / now), min(cells, here / now)

    heights = top + DENSITY * cells * density / density.max()

    def area(low, high):
        """What lies under the density in an interval, as one rectangle a cell."""
        corners = []
        for i in range(int(low), int(np.ceil(high))):
            a, b = max(low, i), min(high, i + 1)
            corners += [(a, top), (b, top), (b, heights[i]), (a, heights[i])]
        return figures.shape(corners, [4] * (len(corners) // 4), "Polys")

    grey, orange, purple = [0.75, 0.78, 0.82], [0.95, 0.55, 0.1], [0.5, 0.1, 0.7]
    view = example.picture_view([pixels, round(pixels * (HEIGHT + DENSITY + 2 * MARGIN)
                                               / (1 + 2 * MARGIN))], [1, 1, 1])
    flat = np.stack([x, top * t], axis=-1)
    shape = figures.shape
    parts = [(area(0, cells), grey, 1), (area(left, right), [0.98, 0.82, 0.6], 1),
             (shape(flat[:-1].reshape(-1, 2), [x.shape[1]] * number), [0.35, 0.55, 0.75], 2),
             (shape([(0, 0), (right, top), (cells, 0), (left, top)], [2, 2]), orange, 4),
             (shape(flat[-1], [x.shape[1]]), purple, 7),
             (shape([(0, 0), (cells, 0), (cells, top), (0, top), (0, 0)], [5]), [0.2] * 3, 2)]
    for height, (data, colour, width) in enumerate(parts):
        shown = simple.Show(example.moved(example.producer(data), 0, 0, height), view,
                            "GeometryRepresentation")
        shown.Ambient, shown.Diffuse = 1, 0
        example.paint(shown, colour)
        shown.LineWidth = width
        shown.RenderLinesAsTubes = int(width > 4)  # wide lines have gaps where they bend
    low, high = -MARGIN * cells, top + (DENSITY + MARGIN) * cells
    example.look_down(view, [cells / 2, (low + high) / 2], high - low, cells)
    picture = figures.drawn(example.save_picture, view)

    zoom, size = pixels / ((1 + 2 * MARGIN) * cells), max(9, pixels // 60)

    def write(words, across, up, lines):
        figures.stamp(picture, words, round(zoom * (across - low)),
                      round(zoom * (up - low) + 1.3 * size * lines), size, centred=True)

    write("x = %g" % start, start, 0, -1)
    write("0", 0, 0, -1)
    write("%d" % cells, cells, 0, -1)
    write("t = 0", -MARGIN * cells / 2, 0, 0)
    write("t = 1", -MARGIN * cells / 2, top, 0)
    write("l", left, top, -1)
    write("r", right, top, -1)
    return picture


def main():
    parser = example.parser(
        __doc__, small="--particles 2000 --paths 24 --pixels 480",
        cells=example.number(512, "cells of the density", 8),
        particles=example.number(10000, "number of particles that the errors are taken over"),
        paths=example.number(64, "number of paths in the picture"),
        start=dict(type=float, help="where the purple path starts, in cells; by default in the "
                   "middle: 256 of 512"),
        pixels=example.number(1200, "width of the picture", 100))
    arguments = parser.parse_args()
    start = arguments.cells / 2 if arguments.start is None else arguments.start
    if not 0 < start < arguments.cells:
        parser.error("--start is %g; it must lie between 0 and %d" % (start, arguments.cells))

    example.load_plugin()
    density = two_gaussians(arguments.cells)
    print_errors(density, arguments.particles, start)
    path = example.output(arguments, "figure2-paths.png")
    figures.save(path, draw(density, arguments.paths, start, arguments.pixels))
    print("\n%d paths: %s" % (arguments.paths, path))


if __name__ == "__main__":
    main()

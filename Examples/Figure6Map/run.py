# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 6 of the paper: the displacement of the map and its divergence, beside those of the
optimal map."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple

# Relative errors against the optimum in the l2 norm, of T, of its displacement and divergence.
PAPER = {"photograph": ("1.5 %", "14.6 %", "21.8 %"), "subject": ("2.6 %", "13.2 %", "125 %")}


def subject_of(path, side):
    """The middle slice of a volume, or a picture, as a density: bright is mass."""
    image = figures.photograph(path, flat=False)
    columns, rows, slices = image.GetDimensions()
    values = figures.values_of(image, slices // 2)
    room = max(columns, rows)  # around it, so that it is a square
    below, left = (room - rows) // 2, (room - columns) // 2
    padding = [(below, room - rows - below), (left, room - columns - left)]
    padding += [(0, 0)] * (values.ndim - 2)
    return figures.grey_square(figures.image_of(np.pad(values, padding)), side)


def maps(transport, **options):
    """T in cells, its displacement and divergence."""
    moved = figures.displacement(transport, **options)
    places = np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in moved.shape[1::-1])), axis=-1)
    return places + moved, moved, figures.field(example.result(transport), "Divergence").copy()


def relative_errors(found, exact, where):
    """In the l2 norm over the samples where it is defined."""
    return ["%.2f %%" % (100 * np.linalg.norm((a - b)[where]) / np.linalg.norm(b[where]))
            for a, b in zip(found, exact)]


def measure(name, image, invert, direction):
    """Rows of the tables of errors and of figures, and the pictures."""
    transport = simple.TransportMap(example.producer(image), InvertDensity=invert,
                                    Direction=direction)
    exact = maps(transport, Integrator="Adaptive", Tolerance=1e-4)
    cost = example.result(transport).GetFieldData().GetArray("TransportCost").GetValue(0)
    density = figures.values_of(image).astype(float)
    density = 255 - density if invert else density
    forward = direction == "UniformToDensity"
    # Backward, nothing comes from where there is no mass.
    where = np.ones(density.shape, bool) if forward else density > 0
    best = maps(transport, Method="Optimal", OptimalityTolerance=1e-5)
    gap = example.result(transport).GetFieldData().GetArray("OptimalityGap").GetValue(0)
    errors = [["%s, %s" % (name, direction), "the flow against the optimal map",
               *relative_errors(exact, best, where)]]
    for integrator, steps in (("Multistep", 32), ("Multistep", 64), ("RungeKutta4", 50)):
        found = maps(transport, Method="RectifiedFlow", Integrator=integrator, NumberOfSteps=steps)
        errors.append(["%s, %s" % (name, direction), "%s, %d" % (integrator, steps),
                       *relative_errors(found, exact, where)])
    divergence = exact[2][where]
    side = density.shape[0]
    simple.Delete(transport)
    row = ["%s, %s" % (name, direction), "%.1f" % figures.lengths(exact[1])[where].mean(),
           "%.2f to %.2f" % (divergence.min(), divergence.max()),
           "%.2f to %.2f" % tuple(np.quantile(divergence, (0.01, 0.99))),
           "%.6f" % (cost / side ** 2), "%.3f %%" % (100 * gap)]
    longest = np.quantile(np.abs(exact[1][where]), 0.995) or 1.0
    steepest = np.abs(np.quantile(divergence, (0.01, 0.99))).max() or 1.0
    shown = []
    for words, (_, moved, spread) in ("flow", exact), ("optimal", best):
        pictures = (figures.coloured_vectors(moved, longest),
                    figures.coloured(spread, -steepest, steepest))
        for picture in pictures:
            picture[~where] = 255
        shown += zip(("%s: displacement, \u00b1%.0f cells" % (words, longest),
                      "%s: divergence, \u00b1%.1f" % (words, steepest)), pictures)
    return errors, row, shown


def main():
    arguments = example.parser(
        __doc__, small="--size 64 --panel 64",
        image=example.file(words="a photograph that covers the plane; dark is mass"),
        subject=dict(default=example.BRAIN,
                     help="a picture, or a volume of which the middle slice is taken, with a "
                     "background of 0; bright is mass"),
        size=example.number(512, "pixels along the sides of both", 2), panel=384).parse_args()

    example.load_plugin()
    photograph = figures.grey_square(figures.photograph(arguments.image), arguments.size)
    subject = subject_of(arguments.subject, arguments.size)
    errors, rows, pictures = [], [], []
    for name, image, invert in ("photograph", photograph, 1), ("subject", subject, 0):
        values = figures.values_of(image)
        empty = 100 * np.mean(values == (255 if invert else 0))
        for direction in "UniformToDensity", "DensityToUniform":
            added, row, shown = measure(name, image, invert, direction)
            errors += added
            rows.append(row)
            pictures.append([("%s; %.0f %% without mass" % (direction, empty),
                              figures.grey(values if invert else 255 - values)), *shown])
        errors.append(["%s, paper, against the optimum" % name, "RK4, 50", *PAPER[name]])
    figures.table(
        "Relative errors in the l2 norm: the flow's map (Adaptive, Tolerance 0.0001) against the "
        "optimal map,\nand other integrators against the flow's map. Those of the paper are quoted: "
        "other pictures.",
        ["map", "steps", "T", "displacement", "divergence"], errors)
    figures.table("The maps. TransportCost / width\u00b2 is an upper bound on W2\u00b2.",
                  ["map", "mean distance, cells", "divergence", "1 % to 99 %",
                   "cost / width\u00b2", "gap of the optimal map"],
                  [*rows, ["paper", "pictures only", "-", "-", "-", "-"]])
    print("\n" + figures.write_montage(arguments, "figure6-map.png", pictures))


if __name__ == "__main__":
    main()

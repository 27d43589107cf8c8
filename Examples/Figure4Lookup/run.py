# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 4 of the paper: what interpolating the tables and the number of steps do."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple

PAPER_STEPS = 50  # T of the paper
RANGE = (-1.5, 1.5)  # of the divergence in colours


def published_map(density, samples, steps=PAPER_STEPS):
    """Algorithms 1 and 2 of the paper with entries of the tables instead of interpolation, at
    coordinates rounded down as in the authors' code: how a lattice of samples moves, as rows,
    columns and x, y in cells. NaN where a box has no cell."""
    height, width = density.shape
    side = np.array([width, height], float)
    tables = np.zeros((height + 1, width + 1, 3))  # E^pi, E^x, E^y
    tables[1:, 1:, 0] = density
    tables[1:, 1:, 1] = density * (np.arange(width) + 0.5)
    tables[1:, 1:, 2] = density * (np.arange(height) + 0.5)[:, None]
    tables = tables.cumsum(axis=0).cumsum(axis=1).reshape(-1, 3)

    def velocity(x, t):
        if t >= 1:
            return np.zeros_like(x)  # theirs too: the formula is 0 / 0
        low = np.maximum(0, side - (side - x) / t) if t > 0 else np.zeros_like(x)
        high = np.minimum(side, x / t) if t > 0 else np.zeros_like(x) + side
        l, u, r, b = (np.clip(np.nan_to_num(ends).astype(int), 0, size)
                      for ends, size in ((low[:, 0], width), (low[:, 1], height),
                                         (high[:, 0], width), (high[:, 1], height)))
        row = width + 1
        sums = (tables[b * row + r] - tables[b * row + l]) - (tables[u * row + r]
                                                              - tables[u * row + l])
        return (sums[:, 1:] / sums[:, :1] - x) / (1 - t)

    y, x = np.meshgrid(*((np.arange(samples) + 0.5) * n / samples for n in (height, width)),
                       indexing="ij")
    seeds = np.stack([x.ravel(), y.ravel()], axis=1)
    x, dt = seeds, 1 / steps
    with np.errstate(divide="ignore", invalid="ignore"):
        for step in range(steps):
            v1 = velocity(x, step / steps)
            v2 = velocity(x + dt / 2 * v1, (step + 0.5) / steps)
            v3 = velocity(x + dt / 2 * v2, (step + 0.5) / steps)
            v4 = velocity(x + dt * v3, (step + 1) / steps)
            x = x + dt / 6 * (v1 + 2 * (v2 + v3) + v4)
    return (x - seeds).reshape(samples, samples, 2)


def divergence(vectors, spacing):
    """By central differences, as Transport Map has it."""
    return (np.gradient(vectors[..., 0], spacing, axis=1)
            + np.gradient(vectors[..., 1], spacing, axis=0))


def transport_map(image, samples, **options):
    return simple.TransportMap(example.producer(image), InvertDensity=1,
                               SampleDimensions=[samples, samples, 1], **options)


def time_ratio(image, samples):
    """The time of the flow with Nearest over that with Interpolated."""
    transport = transport_map(image, 2, Integrator="RungeKutta4", NumberOfSteps=PAPER_STEPS,
                              Threading="Serial")
    again = "Tolerance", [0.1, 0.2, 0.3]  # which Runge-Kutta does not use
    transport.UpdatePipeline()  # the tables
    few = figures.fastest(transport, *again)
    transport.SampleDimensions = [samples, samples, 1]
    times = []
    for lookup in "Nearest", "Interpolated":
        transport.TableLookup = lookup
        times.append(figures.fastest(transport, *again) - few)
    simple.Delete(transport)
    return times[0] / times[1]


def compare_lookups(photograph, arguments):
    """The rows of the figure's upper part, and of its table."""
    rows, pictures = [], [[], [], []]
    for side in arguments.resolutions:
        image = figures.grey_square(photograph, side)
        name = "%d\u00b2" % side
        published = published_map(255.0 - figures.values_of(image), arguments.published)
        lost = np.isnan(published).any(axis=-1)
        share = "%.2f %%" % (100 * lost.mean())
        pictures[0].append(("published, %s: %s NaN" % (name, share), figures.coloured(
            divergence(published, side / arguments.published), *RANGE)))

        transport = transport_map(image, arguments.samples, Integrator="RungeKutta4",
                                  NumberOfSteps=PAPER_STEPS)
        moved, counts = {}, {}
        for lookup, row in ("Nearest", pictures[1]), ("Interpolated", pictures[2]):
            moved[lookup] = figures.displacement(transport, TableLookup=lookup)
            counts[lookup] = np.isnan(moved[lookup]).any(axis=-1).sum()
            row.append(("%s, %s: %d NaN" % (lookup, name, counts[lookup]), figures.coloured(
                figures.field(example.result(transport), "Divergence"), *RANGE)))
        simple.Delete(transport)
        apart = figures.lengths(moved["Nearest"] - moved["Interpolated"])
        rows.append([name, share, *("%d" % counts[lookup] for lookup in counts),
                     "%.3f" % apart.mean(), "%.2f" % apart.max(),
                     "%.2f" % time_ratio(image, arguments.check)])
    return rows, pictures


def count_steps(photograph, arguments):
    """The rows of the figure's lower part, and of its table."""
    image = figures.grey_square(photograph, arguments.size)
    check = transport_map(image, arguments.check)
    exact = figures.displacement(check, Integrator="Adaptive", Tolerance=1e-4)

    def error(integrator, steps):
        apart = figures.lengths(figures.displacement(check, Integrator=integrator,
                                                     NumberOfSteps=steps) - exact)
        return apart.mean(), np.quantile(apart, 0.95)

    shown = transport_map(image, arguments.step_samples)
    rows, pictures = [], [[], []]
    for steps in arguments.steps:
        errors = [error("RungeKutta4", steps), error("Multistep", steps),
                  error("Multistep", 4 * steps + 1)]
        rows.append(["%d" % steps, *("%.3f / %.3f" % pair for pair in errors)])
        for row, integrator, pair in zip(pictures, ("RungeKutta4", "Multistep"), errors):
            shown.Integrator, shown.NumberOfSteps = integrator, steps
            field = figures.field(example.result(shown), "Divergence")
            row.append(("%s, %d: %.3f cells" % (integrator, steps, pair[0]),
                        figures.coloured(field, *RANGE)))
    return rows, pictures


def main():
    arguments = example.parser(
        __doc__, small="--resolutions 16 64 --samples 64 --published 48 --check 40 --size 128 "
                       "--step-samples 64 --steps 5 25 --panel 96",
        image=example.file(),
        resolutions=example.number([16, 64, 256, 1024],
                                   "pixels along the sides of the photograph, upper part", 2),
        steps=example.number([5, 10, 25, 50, 100], "numbers of steps, lower part"),
        size=example.number(1024, "pixels along the sides of the photograph, lower part", 2),
        samples=example.number(1024, "samples of the maps along each side, upper part", 2),
        step_samples=example.number(512, "the same, lower part", 2),
        published=example.number(256, "the same, of the published scheme, upper part", 2),
        check=example.number(150, "the same, for errors and times", 2), panel=256).parse_args()

    example.load_plugin()
    photograph = figures.photograph(arguments.image)
    rows, pictures = compare_lookups(photograph, arguments)
    figures.table(
        "Top: lookup in the tables, RK4, T = %d. NaN of %d samples of the published scheme and of "
        "%d of ours;\ndistance of our two maps in cells; time of the flow, Nearest / "
        "Interpolated." % (PAPER_STEPS, arguments.published ** 2, arguments.samples ** 2),
        ["image", "published Nearest", "Nearest", "Interpolated", "mean distance", "largest",
         "time ratio"], [*rows, ["paper", "many at low resolution", "-", "0", "-", "-",
                                 "about 0.5"]])
    top = figures.write_montage(arguments, "figure4-lookup.png", pictures)

    rows, pictures = count_steps(photograph, arguments)
    figures.table(
        "Bottom: steps. Error in cells, mean / 95 %% below, of %d samples, %d\u00b2 pixels, "
        "against Adaptive, Tolerance 0.0001." % (arguments.check ** 2, arguments.size),
        ["steps N", "RungeKutta4, N (4 N velocities)", "Multistep, N (N - 1 velocities)",
         "Multistep, 4 N + 1 (4 N velocities)"],
        [*rows, ["paper", "pictures; T = 50 chosen", "-", "-"]])
    bottom = figures.write_montage(arguments, "figure4-steps.png", pictures)
    print("\n%s, %s" % (top, bottom))


if __name__ == "__main__":
    main()

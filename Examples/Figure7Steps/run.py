# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 7 of the paper: stipplings by growing numbers of steps."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example
import rectified_figures as figures
from vtkmodules.util.numpy_support import vtk_to_numpy

INTEGRATORS = ("RungeKutta4", "Euler", "Multistep")


def positions(dots, **options):
    """Where the dots are with options of Sample Density set."""
    return vtk_to_numpy(example.result(dots, **options).GetPoints().GetData()).copy()


def main():
    arguments = example.parser(
        __doc__, small="--size 128 --particles 1500 --steps 2 10 50 --pictures 2 --panel 128",
        image=example.file(),
        size=example.number(1024, "pixels along the sides of the photograph", 8),
        particles=example.number(16384, "number of dots"),
        steps=example.number([1, 2, 5, 10, 25, 50, 200], "numbers of steps"),
        pictures=example.number(6, "how many of them are drawn, from the first on"),
        block=example.number(32, "pixels along the sides of a block of DensityError"),
        panel=384).parse_args()

    example.load_plugin()
    stipple = example.script("StippleImage")
    photograph = figures.grey_square(figures.photograph(arguments.image), arguments.size)
    image = example.producer(photograph)
    dots, radius = stipple.stipple(image, arguments.particles)
    bounds = example.pixel_bounds(photograph)
    exact = positions(dots, Integrator="Adaptive", Tolerance=1e-4)
    converged = figures.quality(dots, image, arguments.block)

    rows, pictures = [], [[] for _ in INTEGRATORS]
    for count, steps in enumerate(arguments.steps):
        row = ["%d" % steps]
        for integrator, line in zip(INTEGRATORS, pictures):
            error = figures.lengths(positions(dots, Integrator=integrator, NumberOfSteps=steps)
                                    - exact).mean()
            found = figures.quality(dots, image, arguments.block)
            row.append("%.3f / %.4f / %d" % (error, found["DensityError"], found["InEmptyCells"]))
            if count < arguments.pictures:
                line.append(("%s, %d: %.2f cells" % (integrator, steps, error), figures.drawn(
                    stipple.write_png, dots, bounds, radius, arguments.panel)))
        rows.append(row)
    rows.append(["converged", "0 / %.4f / %d" % (converged["DensityError"],
                                                 converged["InEmptyCells"]), "-", "-"])
    figures.table(
        "%d dots of %d\u00b2 pixels: mean error in cells against Adaptive, Tolerance 0.0001 / "
        "DensityError of blocks of %d\u00b2 / dots in empty cells.\nVelocities of a dot: 4 N "
        "(RungeKutta4), N (Euler), N - 1 (Multistep)."
        % (arguments.particles, arguments.size, arguments.block), ["steps N", *INTEGRATORS],
        [*rows, ["paper", "pictures; N = 50 chosen", "similar with more steps", "-"]])
    print("\n" + figures.write_montage(arguments, "figure7-steps.png", pictures))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 8 of the paper: numbers of samples and resolutions of the image."""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import rectified_example as example
import rectified_figures as figures
from paraview import simple

BLOCKS = 32  # of DensityError along each side of the photograph


def thousands(number):
    return "%dk" % round(number / 1024) if number >= 1024 else "%d" % number


def stipplings(image, side, numbers, repeats, panel, block):
    """For numbers of samples of an image: a row of the table and a picture."""
    stipple = example.script("StippleImage")
    bounds = [0, side, 0, side]
    dots = simple.SampleDensity(Input=image, InvertDensity=1, NumberOfParticles=1,
                                Threading="Serial")
    start = figures.seconds(dots)  # the tables, but for one particle
    rows, pictures = [], []
    for number in numbers:
        dots.NumberOfParticles = number
        times = []
        for seed in range(repeats, 0, -1):  # other seeds, so that the filter runs
            dots.RandomSeed = seed
            times.append(figures.seconds(dots))
        flow = min(times)
        mass = figures.result(dots).GetPointData().GetArray("Mass").GetValue(0)
        found = figures.quality(dots, image, block)
        rows.append([thousands(number), "%d\u00b2" % side, "%.1f" % (1e3 * start),
                     "%.1f" % (1e3 * flow), "%.2f" % (1e6 * flow / number),
                     "%.1f" % (1e9 * start / side ** 2), "%.4f" % found["DensityError"],
                     "%.3f" % found["MeanSpacing"]])
        radius = (mass / 255 / 3.14159265) ** 0.5  # discs with the area of the ink
        pictures.append(("%s samples, %d\u00b2 pixels" % (thousands(number), side), figures.drawn(
            stipple.write_png, dots, bounds, radius, panel)))
    simple.Delete(dots)
    return rows, pictures


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("image", nargs="?", default=figures.RACCOON,
                        help="a photograph in any format that ParaView reads")
    parser.add_argument("--samples", type=figures.at_least(1), nargs="+",
                        default=[2048, 8192, 32768, 131072], help="numbers of samples, first row")
    parser.add_argument("--size", type=figures.at_least(BLOCKS), default=2048,
                        help="pixels along the sides of the photograph, first row")
    parser.add_argument("--sizes", type=figures.at_least(BLOCKS), nargs="+",
                        default=[256, 512, 1024, 2048, 4096],
                        help="pixels along the sides of the photograph, second row")
    parser.add_argument("--particles", type=figures.at_least(1), default=32768,
                        help="number of samples, second row")
    parser.add_argument("--repeats", type=figures.at_least(1), default=5,
                        help="runs of which the fastest counts")
    parser.add_argument("--panel", type=figures.at_least(16), default=480,
                        help="side of each of the pictures")
    parser.add_argument("--output", default=".", help="folder of the picture")
    arguments = parser.parse_args()

    example.load_plugin()
    photograph = figures.photograph(arguments.image)

    def line(side, numbers):
        image = example.producer(figures.grey_square(photograph, side))
        made = stipplings(image, side, numbers, arguments.repeats, arguments.panel, side // BLOCKS)
        simple.Delete(image)
        return made

    first, upper = line(arguments.size, arguments.samples)
    second, lower = [], []
    for side in arguments.sizes:
        rows, pictures = line(side, [arguments.particles])
        second += rows
        lower += pictures
    figures.table("One thread; DensityError over %d\u00b2 blocks" % BLOCKS,
                  ["samples", "image", "tables, ms", "samples, ms", "us / sample", "ns / pixel",
                   "DensityError", "MeanSpacing"], [*first, *second])
    os.makedirs(arguments.output, exist_ok=True)
    path = os.path.join(arguments.output, "figure8-samples.png")
    figures.montage(path, [upper, lower], arguments.panel)
    print("\n" + path)


if __name__ == "__main__":
    main()

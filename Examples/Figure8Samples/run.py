# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 8 of the paper: numbers of samples and resolutions of the image."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example
import rectified_figures as figures
from paraview import simple

BLOCKS = 32  # of DensityError along each side of the photograph
# Table 1: samples, pixels along the sides, seconds on 32 cores (AMD Ryzen Threadripper 2990WX).
PAPER = (8192, 1024, "0.042, 0.048"), (16384, 1024, "0.080"), (16384, 2048, "0.12")


def thousands(number):
    return "%dk" % round(number / 1024) if number >= 1024 else "%d" % number


def name_of(number, side):
    return "%s samples, %d\u00b2 pixels" % (thousands(number), side)


def stipplings(image, side, numbers, repeats, panel):
    """For numbers of samples of an image: a row of the table and a picture."""
    stipple = example.script("StippleImage")
    dots = simple.SampleDensity(image, InvertDensity=1, NumberOfParticles=1, Threading="Serial")
    dots.UpdatePipeline()  # the first use of the memory
    tables = figures.fastest(dots, "Component", (0, -1, 0))  # the same values, but read again
    again = "RandomSeed", range(2, repeats + 2)
    one = figures.fastest(dots, *again)
    times = {}
    for number in numbers:  # before any is shown: ParaView then asks the data for more
        dots.NumberOfParticles = number
        times[number] = figures.fastest(dots, *again) - one
    rows, pictures = [], []
    for number, flow in times.items():
        dots.NumberOfParticles = number
        mass = example.result(dots).GetPointData().GetArray("Mass").GetValue(0)
        found = figures.quality(dots, image, side // BLOCKS)
        rows.append([name_of(number, side), "%.1f" % (1e3 * tables),
                     "%.1f" % (1e9 * tables / side ** 2), "%.1f" % (1e3 * flow),
                     "%.2f" % (1e6 * flow / number), "%.4f" % found["DensityError"],
                     "%.3f" % found["MeanSpacing"]])
        radius = math.sqrt(mass / 255 / math.pi)  # discs with the area of the ink
        pictures.append((name_of(number, side), figures.drawn(
            stipple.write_png, dots, [0, side, 0, side], radius, panel)))
    simple.Delete(dots)
    return rows, pictures


def whole_time(image, number, repeats):
    """The time of the tables and the samples of a filter that is new."""
    times = []
    for _ in range(repeats):
        dots = simple.SampleDensity(image, InvertDensity=1, NumberOfParticles=number,
                                    Threading="Serial")
        times.append(figures.seconds(dots))
        simple.Delete(dots)
    return min(times)


def main():
    arguments = example.parser(
        __doc__, small="--samples 500 2000 --size 256 --sizes 64 128 --particles 1000 --repeats 2 "
                       "--panel 128",
        image=example.file(),
        samples=example.number([2048, 8192, 32768, 131072], "numbers of samples, first row"),
        size=example.number(2048, "pixels along the sides of the photograph, first row", BLOCKS),
        sizes=example.number([256, 512, 1024, 2048, 4096],
                             "pixels along the sides of the photograph, second row", BLOCKS),
        particles=example.number(32768, "number of samples, second row"),
        repeats=example.number(9, "runs of which the fastest counts"), panel=480).parse_args()

    example.load_plugin()
    photograph = figures.photograph(arguments.image)

    def source_of(side):
        return example.producer(figures.grey_square(photograph, side))

    rows, pictures = stipplings(source_of(arguments.size), arguments.size, arguments.samples,
                                arguments.repeats, arguments.panel)
    pictures = [pictures, []]
    for side in arguments.sizes:
        row, picture = stipplings(source_of(side), side, [arguments.particles], arguments.repeats,
                                  arguments.panel)
        rows += row
        pictures[1] += picture
    figures.table("Time of one thread, of the tables in memory that is in use already and of the "
                  "samples.\nQuality: DensityError over %d\u00b2 blocks." % BLOCKS,
                  ["ours", "tables, ms", "ns a pixel", "samples, ms", "us a sample",
                   "DensityError", "MeanSpacing"],
                  [*rows, ["paper", "-", "linear", "-", "linear", "-", "-"]])
    figures.table("Tables and samples together, seconds",
                  ["together", "ours, Multistep, N = 32, one thread",
                   "paper, RK4, T = 50, 32 cores"],
                  [[name_of(number, side), "%.3f" % whole_time(source_of(side), number,
                                                               arguments.repeats), paper]
                   for number, side, paper in PAPER])
    print("\n" + figures.write_montage(arguments, "figure8-samples.png", pictures))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Table 1 of the paper: stippling directly, and relaxed by two methods."""
import importlib.util
import itertools
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_print as pages
import rectified_relaxation as relaxing
from paraview import simple

SHIPPED = [os.path.join(example.DATA, name) for name in ("raccoon.png", "ascent.png")]
SKIMAGE = ["camera.png", "astronaut.png"]  # of Debian's python3-skimage
USUAL = 1024, [2048, 2048, 4096, 4096]
FULL = 2048, [8192, 8192, 16384, 16384]
KINDS = "direct", "GBN", "BNOT"
# Seconds of the paper's four rows, for photographs of its own, on 32 cores (AMD Ryzen Threadripper
# 2990WX).
PAPER = [("8k, 1024\u00b2", "0.042", "152", "173"), ("8k, 1024\u00b2", "0.048", "1205", "1612"),
         ("16k, 1024\u00b2", "0.080", "852", "5653"), ("16k, 2048\u00b2", "0.12", "2400", "1056")]


# And of its column "Ours (GPU)", on an NVIDIA GeForce RTX 2080.
PAPER_GPU = ["0.012", "0.012", "0.018", "0.030"]
ANY_DEVICE = "any"


def photographs():
    """Two photographs of the project and two of python3-skimage; without it, the former twice."""
    found = importlib.util.find_spec("skimage")
    others = [os.path.join(os.path.dirname(found.origin), "data", name)
              for name in SKIMAGE] if found else []
    if others and all(map(os.path.isfile, others)):
        return SHIPPED + others
    print("python3-skimage is not installed: the photographs of the project are taken twice.")
    return SHIPPED * 2


class Faults(list):
    """The warnings of a filter that the processor did a device's work."""
    def __call__(self, _, __, text):
        if "the processor did the work" in text:
            self.append(text)
    CallDataType = "string0"


def directly(image, number, clock, faults=None, **options):
    """Sample Density, its points, and the median of its times with new tables."""
    direct = relaxing.start(image, number, **options)
    if faults is not None:
        direct.GetClientSideObject().AddObserver("WarningEvent", faults)
    example.result(direct)
    times = []
    for component in 0, -1, 0:  # the same values, but read again, to memory that is in use
        begin = clock()
        data = example.result(direct, Component=component)
        times.append(clock() - begin)
    return direct, relaxing.places(data), float(np.median(times))


def on_device(image, number, arguments):
    """Seconds by the clock, all threads, without and with the device, if there is one, and whether
    points are the same to the last bit."""
    name = "" if arguments.device == ANY_DEVICE else arguments.device
    here, points, seconds = directly(image, number, time.perf_counter)
    faults = Faults()
    there, found, on = directly(image, number, time.perf_counter, faults, Device="OpenCL",
                                DeviceName=name)
    simple.Delete(here)
    simple.Delete(there)
    return ["%.4f" % seconds, "none" if faults else "%.4f" % on,
            "the same" if np.array_equal(points, found) else "OTHERS"]


def stipplings(image, number, arguments):
    """What each kind makes of an image: its points, their quality and the time it takes."""
    clock = time.process_time if arguments.threading == "Serial" else time.perf_counter
    direct, points, seconds = directly(image, number, clock, Threading=arguments.threading)
    yield points, figures.quality(direct, image, 64), seconds
    for method in relaxing.METHODS:
        proxy, data, seconds = relaxing.timed(lambda method=method: relaxing.relaxation(
            direct, image, method, MaximumIterations=arguments.iterations,
            Threading=arguments.threading), clock)
        yield relaxing.places(data), figures.quality(proxy, image, 64), seconds
        simple.Delete(proxy)
    simple.Delete(direct)


def rows_of(place, path, number, arguments):
    """Rows of the tables and pictures of a photograph: the photograph and its stipplings."""
    side = arguments.size
    photograph = figures.grey_square(figures.photograph(path), side)
    values = figures.values_of(photograph)
    ink = relaxing.BLACK - values
    image = example.producer(photograph)
    name = "%s, %d" % (example.stem(path), number)
    rows, pictures, direct = [], [(name, figures.grey(values))], None
    device = [[name] + on_device(image, number, arguments)] if arguments.device else []
    for kind, (points, quality, seconds) in zip(KINDS, stipplings(image, number, arguments)):
        energy = relaxing.pixel_energy(points, ink)
        direct = direct or energy
        rows.append([name, kind, "%.3f" % seconds, "%.4f" % energy,
                     "%+.2f %%" % (100 * (energy / direct - 1)),
                     "%.3f" % quality["SmallestSpacing"], "%.3f" % quality["MeanSpacing"]])
        discs = pages.Discs((side, side), points,
                            np.full(number, relaxing.disc_radius(ink, number)))
        picture, = pages.pictures(discs, side)
        figures.save(example.output(arguments, "table1-%d-%s-%s.png" % (
            place, example.stem(path), kind)), picture)
        pictures.append((kind, picture))
    simple.Delete(image)
    return rows, device, pictures


def middle(picture, panel):
    """The middle of a picture, pixel by pixel."""
    low, left = (max(0, (n - panel) // 2) for n in picture.shape[:2])
    return picture[low:low + panel, left:left + panel]


def main():
    arguments = example.parser(
        __doc__, small="--size 192 --samples 400 600 --iterations 10 --panel 96",
        images=dict(nargs="*", help="photographs in any format that ParaView reads (default: two "
                                    "of the project and two of python3-skimage)"),
        full=dict(action="store_true",
                  help="the paper's numbers of dots, on %d\u00b2 pixels" % FULL[0]),
        size=dict(example.number(None, "", 8), help="pixels along the sides of the photographs "
                  "(default: %d)" % USUAL[0]),
        samples=dict(example.number([], ""), default=None,
                     help="numbers of dots, of one photograph after another (default: %s)"
                     % " ".join(map(str, USUAL[1]))),
        iterations=example.number(50, "of each of the two methods, at most"),
        threading=dict(choices=["Serial", "Auto"], default="Serial",
                       help="one thread, timed by the processor's time, or all, by the clock "
                            "(default: %(default)s)"), panel=288,
        device=dict(metavar="NAME",
                    help="also on an OpenCL device whose name contains this, or \"%s\": the paper's "
                         "column \"Ours (GPU)\"" % ANY_DEVICE)).parse_args()
    size, samples = FULL if arguments.full else USUAL
    arguments.size = arguments.size or size
    samples = arguments.samples or samples

    example.load_plugin()
    rows, devices, pictures = [], [], []
    for place, (path, number) in enumerate(
            zip(arguments.images or photographs(), itertools.cycle(samples)), 1):
        found, device, row = rows_of(place, path, number, arguments)
        rows += found
        devices += device
        pictures.append(row)
    figures.table(
        "Dots of %d\u00b2 pixels; GBN and BNOT: %d iterations at most, from the direct dots, whose "
        "time is not counted again.\nSeconds: %s. E: at the pixels' centres. Spacings: those of "
        "Transport Quality." % (arguments.size, arguments.iterations,
                                {"Serial": "one thread's processor time",
                                 "Auto": "by the clock, all threads"}[arguments.threading]),
        ["photograph, dots", "ours", "seconds", "E", "change", "SmallestSpacing", "MeanSpacing"],
        rows)
    figures.table("The paper, seconds, on 32 cores, for photographs of its own",
                  ["dots, pixels", *KINDS], [list(row) for row in PAPER])
    if devices:
        figures.table("Direct dots with new tables, seconds by the clock, all threads",
                      ["photograph, dots", "processor", "device", "points"], devices)
        figures.table("The paper, seconds: \"Ours (CPU)\", \"Ours (GPU)\" on an RTX 2080",
                      ["dots, pixels", "processor", "GPU"],
                      [[row[0], row[1], gpu] for row, gpu in zip(PAPER, PAPER_GPU)])
    print("\n" + figures.write_montage(arguments, "table1-stippling.png", pictures))
    print(figures.write_montage(arguments, "table1-middle.png", [
        [(words, middle(picture, arguments.panel)) for words, picture in row]
        for row in pictures]))


if __name__ == "__main__":
    main()

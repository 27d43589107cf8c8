# SPDX-License-Identifier: BSD-3-Clause
"""Every function of rectifiedtransport.arrays on small pictures, with numpy alone: no pipeline, no
ParaView, no file to read. The picture is drawn into an array and written as PNG."""
import glob
import os
import struct
import sys
import zlib

import numpy as np

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir)
sys.path.insert(0, EXAMPLES)
sys.path += glob.glob(os.path.join(EXAMPLES, os.pardir, "build", "lib*", "python3*", "*-packages"))
from rectified_arguments import number, output, parser
from rectifiedtransport import arrays

INK = np.array([0.13, 0.16, 0.28])
WARM = np.array([0.85, 0.45, 0.15])
COLOURS = np.array([[0.91, 0.78, 0.47], [0.49, 0.66, 0.60], [0.76, 0.47, 0.40], [0.44, 0.53, 0.69],
                    [0.80, 0.80, 0.76], [0.62, 0.50, 0.63], [0.66, 0.73, 0.47]])


def grid(size):
    """x and y of pixels, from -1 to 1."""
    y, x = (np.mgrid[:size, :size] + 0.5) * 2 / size - 1
    return x, y


def ring(size):
    x, y = grid(size)
    return np.clip(size / 2 * (0.2 - np.abs(np.hypot(x, y) - 0.6)) + 0.5, 0, 1)


def discs(size):
    x, y = grid(size)
    edge = np.minimum(np.hypot(x + 0.5, y + 0.45) - 0.32, np.hypot(x - 0.45, y - 0.4) - 0.42)
    return np.clip(0.5 - size / 2 * edge, 0, 1)


def star(size):
    x, y = grid(size)
    edge = np.hypot(x, y) - 0.6 - 0.25 * np.cos(5 * np.arctan2(y, x))
    return np.clip(0.5 - size / 4 * edge, 0, 1)


def waves(size):
    """Smooth, and nowhere empty."""
    x, y = grid(size)
    return 1.1 + np.sin(5 * x + 2 * np.sin(3 * y)) * np.cos(4 * y)


def tinted(values, colour=INK):
    """A picture of a density: white is 0, the colour is its largest value."""
    share = np.clip(values / values.max(), 0, 1)[..., None]
    return 1 - share * (1 - colour)


def enlarged(picture, panel):
    """A picture of another width, its pixels as squares."""
    place = np.arange(panel) * len(picture) // panel
    return picture[place][:, place]


def dotted(points, size, panel, radius, below=None):
    """Round dots at points, columns and rows of an image of size, on a panel."""
    picture = np.ones((panel, panel, 3)) if below is None else below
    scale = panel / size
    rows, columns = np.mgrid[:panel, :panel]
    for x, y in (points + 0.5) * scale - 0.5:
        low, high = np.maximum([y - radius - 1, x - radius - 1], 0), [y + radius + 2, x + radius + 2]
        part = tuple(slice(int(first), int(last)) for first, last in zip(low, high))
        cover = np.clip(radius + 0.5 - np.hypot(rows[part] - y, columns[part] - x), 0, 1)[..., None]
        picture[part] = picture[part] * (1 - cover) + INK * cover
    return picture


def bent(displacement, panel):
    """The lines of a grid where a map takes them, as dots close to each other."""
    size, finer = len(displacement), 3
    fine = np.arange(0, size - 1, size / (4 * finer * panel))
    lines = np.arange(0, size, size / 20)
    x, y = (np.concatenate([np.ravel(first), np.ravel(second)]) for first, second in
            zip(np.meshgrid(fine, lines), np.meshgrid(lines, fine)))
    column, row = (np.minimum(places.astype(int), size - 2) for places in (x, y))
    u, v = (x - column)[:, None], (y - row)[:, None]
    moved = sum(weight * displacement[row + i, column + j] for i, j, weight in (
        (0, 0, (1 - u) * (1 - v)), (0, 1, u * (1 - v)), (1, 0, (1 - u) * v), (1, 1, u * v)))
    place = np.column_stack([x, y]) + moved
    counts = np.histogram2d(place[:, 1], place[:, 0], finer * panel, [[-0.5, size - 0.5]] * 2)[0]
    cover = (counts > 0).reshape(panel, finer, panel, finer).mean(axis=(1, 3))
    return 1 - np.minimum(2 * cover, 1)[..., None] * (1 - INK)



def write_png(path, picture):
    """Writes colours from 0 to 1, the first row at the top."""
    pixels = (255 * picture.clip(0, 1)).round().astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    height, width = pixels.shape[:2]
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)),
                           (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data
                       + struct.pack(">I", zlib.crc32(kind + data)))


def montage(rows, gap=8):
    """Panels in rows, with white between them."""
    panel = len(rows[0][0])
    width = max(map(len, rows))
    picture = np.ones((len(rows) * (panel + gap) - gap, width * (panel + gap) - gap, 3))
    for i, row in enumerate(rows):
        for j, drawn in enumerate(row):
            y, x = i * (panel + gap), j * (panel + gap)
            picture[y:y + panel, x:x + panel] = drawn
    return picture


def main():
    arguments = parser(
        __doc__, small="--size 48 --dots 300 --panel 96",
        size=number(128, "pixels along the sides of the densities", 8),
        dots=number(1500, "number of dots"), panel=256).parse_args()
    size, panel = arguments.size, arguments.panel
    a, b, c, smooth = ring(size), discs(size), star(size), waves(size)
    radius = 0.3 * panel / arguments.dots ** 0.5

    between = arrays.morph(a, b, [0, 1 / 3, 2 / 3, 1], Method="Optimal")
    mean = arrays.barycenter([a, b, c], [1, 1, 2], Method="Optimal")
    points = arrays.sample(smooth, arguments.dots)
    even = arrays.relax(points, smooth)
    dots = arrays.stipple(1 - c, arguments.dots)
    sites = arrays.sample(smooth, 60)
    parts = arrays.cells(sites, smooth, Shape="Power")
    back = arrays.transport_map(smooth, Direction="DensityToUniform")

    print("\nW2 in pixels, of densities of %d\u00b2" % size)
    print("  pair          at least  at most")
    for name, first, second in (("ring, discs", a, b), ("ring, star", a, c), ("discs, star", b, c),
                                ("ring, itself", a, a)):
        found = arrays.distance(first, second)
        print("  %-12s  %-8.3f  %.3f" % (name, found.lower, found.upper))

    coloured = COLOURS[parts.labels % len(COLOURS)]
    picture = montage([
        [enlarged(tinted(values), panel) for values in between],
        [enlarged(tinted(smooth, WARM), panel), dotted(points, size, panel, radius),
         dotted(even, size, panel, radius), dotted(dots, size, panel, radius)],
        [enlarged(tinted(c), panel), enlarged(tinted(mean, WARM), panel),
         dotted(sites, size, panel, panel / 100, enlarged(coloured, panel)),
         bent(back.displacement, panel)]])
    path = output(arguments, "arrays.png")
    write_png(path, picture)
    print(path)


if __name__ == "__main__":
    main()

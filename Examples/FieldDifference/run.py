# SPDX-License-Identifier: BSD-3-Clause
"""Where two runs differ: the map from one plume to another, its arrows and its cost in each cell."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple

COLOURS = [0.9, 0.45, 0.1], [0.1, 0.4, 0.8]  # of the first and the second run


def plume(size, turn, source=(0.12, 0.4)):
    """Smoke from a chimney, which the wind bends and widens, in a box of 2 x 1."""
    y, x = (np.mgrid[:size, :2 * size] + 0.5) / size
    way = np.maximum(x - source[0], 1e-6)
    middle = source[1] + turn * way ** 2
    width = 0.03 + 0.08 * way
    smoke = np.exp(-0.5 * ((y - middle) / width) ** 2) / width * np.exp(-0.8 * way)
    return smoke / (1 + np.exp(-(x - source[0]) / 0.01)) + 0.02


def arrows_of(transport, values, columns):
    """Lines and heads of arrows, one in every so many cells in which the first run has smoke."""
    ways = figures.displacement(transport)
    step = values.shape[1] // columns
    rows, columns = np.meshgrid(*(np.arange(step // 2, n, step) for n in values.shape), indexing="ij")
    smoke = values[rows, columns] > 1
    starts = np.stack([columns[smoke], rows[smoke]], axis=1) + 0.5
    ways = ways[rows[smoke], columns[smoke]]
    lengths = np.maximum(figures.lengths(ways), 1e-9)[:, None]
    ends, along = starts + ways, ways / lengths * np.minimum(0.4 * lengths, 0.35 * step)
    across = 0.45 * along[:, ::-1] * [-1, 1]
    lines = np.stack([starts, ends - 0.5 * along], axis=1).reshape(-1, 2)
    heads = np.stack([ends, ends - along + across, ends - along - across], axis=1).reshape(-1, 2)
    return (figures.shape(lines, [2] * len(starts)), figures.shape(heads, [3] * len(starts), "Polys"))


def draw_arrows(path, runs, arrows, size, pixels):
    """Contours of both plumes, and arrows from the first to the second."""
    view = example.picture_view(pixels, [1, 1, 1])
    for run, colour in zip(runs, COLOURS):
        lines = simple.Contour(Input=run, ContourBy=["POINTS", "Values"], ComputeNormals=0,
                               Isosurfaces=[2.0, 5.0, 9.0])
        shown = simple.Show(lines, view, "GeometryRepresentation")
        example.paint(shown, colour)
        shown.LineWidth = 2.5
    for part in arrows:
        shown = simple.Show(example.producer(part), view, "GeometryRepresentation")
        example.paint(shown, [0.15, 0.15, 0.15])
        shown.LineWidth = 2
    example.look_down(view, [size, 0.5 * size], size, 1000)
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--size 64 --panel 160", size=128, panel=320).parse_args()
    size, panel = arguments.size, arguments.panel
    example.load_plugin()
    values = [plume(size, turn) for turn in (0.05, 0.18)]
    first, second = (example.producer(figures.image_of(run)) for run in values)
    rows = []
    costs = {}
    for method in ("RectifiedFlow", "Optimal"):
        transport = simple.TransportMap(first, Target=second, Method=method, Certify=1)
        output = example.result(transport)
        costs[method] = figures.field(output, "CostDensity").copy()
        data = output.GetFieldData()
        cost, bound, gap = (data.GetArray(name).GetValue(0) for name in (
            "TransportCost", "TransportCostLowerBound", "OptimalityGap"))
        rows.append([method, "%.2f" % cost ** 0.5, "%.2f" % bound ** 0.5, "%.1f %%" % (100 * gap),
                     "%.3f" % data.GetArray("LargestBlockError").GetComponent(0, 0)])
        arrows = arrows_of(transport, values[0], 32)
        simple.Delete(transport)
    figures.table("From the first plume to the second, %d x %d cells" % (2 * size, size),
                  ["Method", "root of TransportCost, cells", "of its bound", "gap",
                   "LargestBlockError"], rows)

    arrows = figures.drawn(draw_arrows, (first, second), arrows, size, [panel, panel // 2])
    change = values[1] - values[0]
    most = np.abs(change).max()
    share = costs["Optimal"][..., None] / np.quantile(costs["Optimal"], 0.999)
    cost = 255 - np.clip(share, 0, 1) * (255 - np.array([120, 20, 90]))
    pictures = [("Displacement", arrows),
                ("CostDensity", figures.fitted(cost.round().astype(np.uint8), panel)),
                ("second run - first run", figures.fitted(figures.coloured(change, -most, most), panel))]
    print("\n" + figures.write_montage(arguments, "field-difference.png", [pictures]))


if __name__ == "__main__":
    main()

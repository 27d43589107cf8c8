# SPDX-License-Identifier: BSD-3-Clause
"""Divides the unit square among sites with either Shape of Equal Mass Cells: what the cells cost, how
equal they are, and how they look side by side."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData


def make_sites(count, seed):
    """Sites at random, evenly spread, and crowded about eight points."""
    random = np.random.default_rng(seed)
    seeds = simple.UniformSeeds(NumberOfPoints=count, RandomSeed=seed)
    even = vtk_to_numpy(example.result(seeds).GetPoints().GetData())[:, :2]
    middles = 0.15 + 0.7 * random.random((8, 2))
    crowds = middles[random.integers(0, 8, count)] + 0.04 * random.standard_normal((count, 2))
    return {"random": random.random((count, 2)), "blue noise": even,
            "clusters": np.clip(crowds, 0.001, 0.999)}


def divide(sites, shape, resolution):
    """The cells of sites in the unit square, and the time that they take."""
    square = vtkImageData()
    square.SetDimensions(2, 2, 1)
    cells = simple.EqualMassCells(example.producer(figures.polydata(sites)),
                                  Domain=example.producer(square), Shape=shape,
                                  Resolution=resolution, Threading="Serial")
    return cells, figures.seconds(cells)


def cost_of(cells, shape, resolution):
    """The mean squared distance over all of the square: the flow's cells are those of whole pixels,
    whose cost is that of the pixels' centres."""
    found = example.result(cells).GetFieldData().GetArray("TransportCost").GetValue(0)
    return found + (2 / 12 / resolution ** 2 if shape == "Flow" else 0)


def deviation(cells):
    sites = cells.GetClientSideObject().GetOutputDataObject(1).GetPointData()
    masses = vtk_to_numpy(sites.GetArray("CellMass"))
    return abs(masses / masses.mean() - 1).max()


def main():
    arguments = example.parser(
        __doc__, small="--sites 64 --resolution 64 --drawn 20 --pixels 480",
        sites=example.number(1024, "how many, in each of the sets"),
        resolution=example.number(1024, "pixels of the square's side"),
        seed=example.number(1, "of the sites", 0),
        drawn=example.number(150, "sites in the pictures"),
        pixels=example.number(1020, "width of the pictures", 64)).parse_args()

    example.load_plugin()
    figure5 = example.script("Figure5Cells")
    rows = []
    for name, sites in make_sites(arguments.sites, arguments.seed).items():
        costs, times, off = {}, [], []
        for shape in ("Flow", "Power"):
            cells, time = divide(sites, shape, arguments.resolution)
            costs[shape] = cost_of(cells, shape, arguments.resolution)
            times.append("%.2f s" % time)
            off.append("%.1g" % deviation(cells))
        rows.append([name, *("%.5g" % costs[shape] for shape in ("Flow", "Power")),
                     "%.4f" % (costs["Flow"] / costs["Power"]), *off, *times])
    figures.table("Cost W_2^2 of %d sites" % arguments.sites,
                  ["sites", "Flow", "Power", "ratio", "unequal: Flow", "Power", "time: Flow",
                   "Power"], rows)
    for name, sites in make_sites(arguments.drawn, arguments.seed).items():
        path = example.output(arguments, "power-cells-%s.png" % name.replace(" ", "-"))
        figure5.draw(path, [divide(sites, shape, arguments.resolution)[0]
                            for shape in ("Flow", "Power")], arguments.pixels)
        print(path)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Remakes the paper's Figure 5: the cells of random sites and of sites on a disc, and their costs."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

COSTS = ((2, 2), (4, 4), (2, 4), (4, 1.6))  # p, q of the paper's W_p^q


def make_sites(count, seed):
    """Sites at random in the unit square, and on a disc in its middle."""
    random = np.random.default_rng(seed)
    angle, radius = 2 * np.pi * random.random(count), 0.4 * np.sqrt(random.random(count))
    disc = np.c_[0.5 + radius * np.cos(angle), 0.5 + radius * np.sin(angle)]
    return {"random": random.random((count, 2)), "disc": disc}


def measure(name, cells, count):
    """Rows of what the cells of a set of sites are like, and what the way to the sites costs."""
    time = figures.seconds(cells)
    labels = example.result(cells)
    found = np.bincount(vtk_to_numpy(labels.GetCellData().GetArray("SiteId")), minlength=count)
    costs = []
    for cells.NormExponent, cells.CostExponent in COSTS:
        cells.UpdatePipeline()
        costs.append("%.4g" % labels.GetFieldData().GetArray("TransportCost").GetValue(0))
    return ([name, "%d to %d" % (found.min(), found.max()), "%.2g" % (found.std() / found.mean()),
             "%.1f s" % time], [name, *costs])


def draw(path, sets, pixels):
    """The cells of both sets side by side, with outlines and sites."""
    view = example.picture_view([pixels, round(pixels / 2.04)], [1, 1, 1])
    for column, cells in enumerate(sets):
        for port, colour in ((0, None), (2, [0, 0, 0]), (1, [0, 0, 0])):
            shown = simple.Show(example.moved(simple.OutputPort(cells, port), 1.04 * column, 0,
                                              0.01 * port), view)
            shown.Ambient, shown.Diffuse = 1, 0
            shown.LineWidth = 1.5
            if colour is None:
                # Neighbours in the list of sites are no neighbours in the plane.
                example.colour_by(shown, view, ("CELLS", "SiteId"), "Viridis")
            else:
                example.paint(shown, colour)
            if port == 1:
                shown.SetRepresentationType("Point Gaussian")
                shown.ShaderPreset = "Plain circle"
                shown.GaussianRadius = 0.002
    example.look_down(view, [1.02, 0.5], 1, 10)
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--sites 64 --resolution 128 --pixels 480",
        sites=example.number(1024, "how many, in each of the two sets"),
        resolution=example.number(1024, "pixels of the square's side"),
        seed=example.number(1, "of the random sites", 0),
        pixels=example.number(2040, "width of the picture", 64)).parse_args()

    example.load_plugin()
    square = vtkImageData()
    square.SetDimensions(2, 2, 1)
    sets, masses, costs = [], [], []
    for name, sites in make_sites(arguments.sites, arguments.seed).items():
        sets.append(simple.EqualMassCells(example.producer(figures.polydata(sites)),
                                          Domain=example.producer(square),
                                          Resolution=arguments.resolution, Threading="Serial"))
        mass, cost = measure(name, sets[-1], arguments.sites)
        masses.append(mass)
        costs.append(cost)
    figures.table("Pixels of a cell", ["sites", "least to most", "deviation", "time"],
                  [*masses, ["paper", "\"equal areas\"", "-", "- (3000 steps)"]])
    figures.table("Upper bounds of the costs", ["sites", *("W_%g^%g" % c for c in COSTS)],
                  [*costs, ["paper", *("-" for _ in COSTS)]])

    path = example.output(arguments, "figure5-cells.png")
    draw(path, sets, arguments.pixels)
    print(path)


if __name__ == "__main__":
    main()

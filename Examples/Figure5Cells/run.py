# SPDX-License-Identifier: BSD-3-Clause
"""Remakes the paper's Figure 5: the cells of random sites and of sites on a disc, and their costs."""
import argparse
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import numpy as np
import rectified_example as example
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

COSTS = ((2, 2), (4, 4), (2, 4), (4, 1.6))  # p, q of the paper's W_p^q


def sites_at(coordinates):
    """A source of sites, given as rows of x and y."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.c_[coordinates, np.zeros(len(coordinates))], deep=1))
    data = vtkPolyData()
    data.SetPoints(points)
    return example.producer(data)


def make_sites(count, seed):
    """Sites at random in the unit square, and on a disc in its middle."""
    random = np.random.default_rng(seed)
    angle, radius = 2 * np.pi * random.random(count), 0.4 * np.sqrt(random.random(count))
    disc = np.c_[0.5 + radius * np.cos(angle), 0.5 + radius * np.sin(angle)]
    return {"random": random.random((count, 2)), "disc": disc}


def measure(name, cells, count):
    """Prints the masses of the cells and the costs of the way to the sites."""
    start = time.perf_counter()
    cells.UpdatePipeline()
    seconds = time.perf_counter() - start
    labels, sites = (cells.GetClientSideObject().GetOutputDataObject(i) for i in (0, 1))
    if labels.GetNumberOfCells() == 0:
        sys.exit(1)  # the filter has said why
    found = np.bincount(vtk_to_numpy(labels.GetCellData().GetArray("SiteId")), minlength=count)
    costs = []
    for cells.NormExponent, cells.CostExponent in COSTS:
        cells.UpdatePipeline()
        costs.append(labels.GetFieldData().GetArray("TransportCost").GetValue(0))
    mass = vtk_to_numpy(sites.GetPointData().GetArray("CellMass"))
    print("%-7s %6.2f s   pixels a cell: %d to %d   mass: deviation %.2g, largest %.2g" % (
        name, seconds, found.min(), found.max(), mass.std() / mass.mean(),
        abs(mass / mass.mean() - 1).max()))
    print("        upper bounds: " + ", ".join(
        "W_%g^%g %.4g" % (p, q, cost) for (p, q), cost in zip(COSTS, costs)))


def draw(path, sets, pixels):
    """The cells of both sets side by side, with outlines and sites."""
    view = example.picture_view([pixels, round(pixels / 2.04)], [1, 1, 1])
    for column, cells in enumerate(sets):
        for port, colour in ((0, None), (2, [0, 0, 0]), (1, [0, 0, 0])):
            place = simple.Transform(Input=simple.OutputPort(cells, port), Transform="Transform")
            place.Transform.Translate = [1.04 * column, 0, 0.01 * port]
            shown = simple.Show(place, view)
            shown.Ambient, shown.Diffuse = 1, 0
            shown.LineWidth = 1.5
            if colour is None:
                # Neighbours in the list of sites are no neighbours in the plane.
                simple.ColorBy(shown, ("CELLS", "SiteId"))
                shown.SetScalarBarVisibility(view, False)
                simple.GetColorTransferFunction("SiteId").ApplyPreset("Viridis (matplotlib)", True)
            else:
                shown.ColorArrayName = [None, ""]
                shown.AmbientColor = shown.DiffuseColor = colour
            if port == 1:
                shown.SetRepresentationType("Point Gaussian")
                shown.ShaderPreset = "Plain circle"
                shown.GaussianRadius = 0.002
    example.look_down(view, [1.02, 0.5], 1, 10)
    example.save_picture(path, view)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sites", type=int, default=1024, help="how many, in each of the two sets")
    parser.add_argument("--resolution", type=int, default=1024, help="pixels of the square's side")
    parser.add_argument("--seed", type=int, default=1, help="of the random sites")
    parser.add_argument("--pixels", type=int, default=2040, help="width of the picture")
    parser.add_argument("--output", default=".", help="folder of the picture")
    arguments = parser.parse_args()

    example.load_plugin()
    square = vtkImageData()
    square.SetDimensions(2, 2, 1)
    sets = []
    for name, sites in make_sites(arguments.sites, arguments.seed).items():
        sets.append(simple.EqualMassCells(Input=sites_at(sites), Domain=example.producer(square),
                                          Resolution=arguments.resolution))
        measure(name, sets[-1], arguments.sites)
    print("The paper gives no figures here; its cells are \"of equal areas\", made in 3000 steps.")

    os.makedirs(arguments.output, exist_ok=True)
    path = os.path.join(arguments.output, "figure5-cells.png")
    draw(path, sets, arguments.pixels)
    print(path)


if __name__ == "__main__":
    main()

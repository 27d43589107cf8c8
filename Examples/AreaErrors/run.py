# SPDX-License-Identifier: BSD-3-Clause
"""Draws the errors of areas around a dense disc: with 32 steps, and with as many as needed."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy
import rectified_example as example
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

BLOCK = 4  # cells along each side


def disc(cells, ratio):
    """An image of a disc that is `ratio` times as dense as the rest; its border is smoothed over a cell."""
    parts = 8
    places = (numpy.arange(cells * parts) + 0.5) / (cells * parts)
    inside = numpy.hypot(places[None, :] - 0.45, places[:, None] - 0.52) < 0.15
    share = inside.reshape(cells, parts, cells, parts).mean(axis=(1, 3))
    image = vtkImageData()
    image.SetDimensions(cells + 1, cells + 1, 1)
    values = numpy_to_vtk((1 + (ratio - 1) * share).ravel(), deep=1)
    values.SetName("Density")
    image.GetCellData().SetScalars(values)
    return image


def areas(polygons):
    """Of the quadrilaterals of a mesh, negative where they are turned over."""
    points = vtk_to_numpy(polygons.GetPoints().GetData())[:, :2].astype(float)
    corners = vtk_to_numpy(polygons.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    a, b, c, d = (points[corners[:, k]] for k in range(4))
    p, q = c - a, d - b
    return 0.5 * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])


def blocks(values):
    """Sums of the cells of a square image over blocks."""
    side = int(round(len(values) ** 0.5)) // BLOCK
    return values.reshape(side, BLOCK, side, BLOCK).sum(axis=(1, 3))


def main():
    arguments = example.parser(
        __doc__, small="--cells 128 --pixels 480",
        cells=example.number(256, "cells along each side, a multiple of 4", 8),
        ratio=dict(type=float, default=100, help="density of the disc over that of the rest"),
        pixels=example.number(1600, "width of the picture")).parse_args()
    if arguments.cells % BLOCK:
        sys.exit("--cells is %d, it must be a multiple of %d" % (arguments.cells, BLOCK))

    example.load_plugin()
    image = disc(arguments.cells, arguments.ratio)
    geometry = vtkGeometryFilter()
    geometry.SetInputData(image)
    geometry.PassThroughCellIdsOn()
    geometry.Update()
    places = vtk_to_numpy(geometry.GetOutput().GetCellData().GetArray("vtkOriginalCellIds"))
    density = example.producer(image)
    mesh = example.producer(geometry.GetOutput())
    mass = vtk_to_numpy(image.GetCellData().GetScalars())
    share = mass / mass.sum() * arguments.cells ** 2

    view = example.picture_view([arguments.pixels, arguments.pixels // 2], [1, 1, 1])
    for column, steps in enumerate((32, 0)):
        warp = simple.DensityEqualizingWarp(mesh, Density=density, NumberOfSteps=steps)
        warped = example.result(warp)
        area = numpy.empty(len(places))
        area[places] = areas(warped)  # from VTK 9.6 on cells come in any order
        error = blocks(area) / blocks(share) - 1
        taken = warped.GetFieldData().GetArray("StepsTaken").GetValue(0)
        print("%4d steps: blocks of %d x %d cells off by %.4f (99.9 %%: %.4f), %d cells folded" % (
            taken, BLOCK, BLOCK, numpy.abs(error).max(), numpy.quantile(numpy.abs(error), 0.999),
            (area <= 0).sum()))
        values = numpy_to_vtk(numpy.repeat(numpy.repeat(error, BLOCK, 0), BLOCK, 1).ravel()[places], deep=1)
        values.SetName("AreaError")
        drawn = vtkPolyData()
        drawn.ShallowCopy(geometry.GetOutput())
        drawn.GetCellData().AddArray(values)
        shown = simple.Show(example.moved(example.producer(drawn), 1.04 * column * arguments.cells, 0, 0),
                            view, "GeometryRepresentation")
        simple.ColorBy(shown, ("CELLS", "AreaError"))
        shown.SetRepresentationType("Surface")
        shown.Ambient, shown.Diffuse = 1, 0
        shown.SetScalarBarVisibility(view, False)
    colours = simple.GetColorTransferFunction("AreaError")
    colours.ApplyPreset("Cool to Warm", True)
    colours.RescaleTransferFunction(-0.5, 0.5)
    path = example.output(arguments, "area-errors.png")
    width = 2.04 * arguments.cells
    example.look_down(view, [width / 2, arguments.cells / 2], arguments.cells, width)
    example.save_picture(path, view)
    print(path)


if __name__ == "__main__":
    main()

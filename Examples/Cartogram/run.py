# SPDX-License-Identifier: BSD-3-Clause
"""Draws the states of a map, and the cartogram in which their areas are their people."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy
import rectified_example as example
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

MAP = os.path.join(example.DATA, "us-states.geojson")


def main():
    arguments = example.parser(
        __doc__, small="--pixels 480",
        map=example.file(MAP, "a map that GDAL Vector Reader takes, in an equal-area projection"),
        mass=dict(default="mass", help="the attribute with the people of each state"),
        pixels=example.number(1600, "width of the picture")).parse_args()

    example.load_plugin()
    if not hasattr(simple, "GDALVectorReader"):
        sys.exit("This ParaView has no GDAL Vector Reader")
    if not os.path.isfile(arguments.map):
        sys.exit("There is no file " + arguments.map)
    states = simple.GDALVectorReader(FileName=arguments.map)
    maps = [simple.Cartogram(Input=states, MassArray=["CELLS", arguments.mass], Blend=blend)
            for blend in (0, 1)]
    before, after = map(example.result, maps)
    errors = vtk_to_numpy(after.GetFieldData().GetArray("AreaErrors"))
    densities = vtk_to_numpy(after.GetCellData().GetArray("MassPerArea"))
    print("%d regions, largest error of an area after each pass: %s" % (
        len(set(densities)), ", ".join("%.4f" % error for error in errors)))

    bounds = numpy.array([data.GetBounds() for data in (before, after)])
    low, high = bounds[:, ::2].min(0), bounds[:, 1::2].max(0)
    width, height = (high - low)[:2]
    view = example.picture_view(
        [arguments.pixels, int(1.04 * height / (2.1 * width) * arguments.pixels)], [1, 1, 1])
    for blend, cartogram in enumerate(maps):
        shown = simple.Show(example.moved(cartogram, 1.04 * blend * width, 0, 0), view)
        shown.Representation = "Filled Outlines With Edges"
        shown.Ambient, shown.Diffuse = 1, 0
        shown.EdgeColor = [0, 0, 0]
        shown.LineWidth = max(1, arguments.pixels / 1000)
        colours = example.colour_by(shown, view, ("CELLS", "MassPerArea"), "Viridis")
    colours.RescaleTransferFunction(*numpy.quantile(densities[densities > 0], [0.02, 0.98]))
    colours.MapControlPointsToLogSpace()
    colours.UseLogScale = 1
    example.look_down(view, [low[0] + 1.02 * width, low[1] + height / 2], 1.04 * height, 2.1 * width)
    path = example.output(arguments, "cartogram.png")
    example.save_picture(path, view)
    print(path)


if __name__ == "__main__":
    main()

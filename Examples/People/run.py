# SPDX-License-Identifier: BSD-3-Clause
"""Draws the states of a map, and the cartogram in which their areas are their people."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy
import rectified_example as example
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

MAP = os.path.join(example.DATA, "us-states.geojson")


def filled(outlines, density):
    """Triangles in closed lines, which can be coloured; holes would be filled."""
    polygons = vtkPolyData()
    polygons.SetPoints(outlines.GetPoints())
    polygons.SetPolys(outlines.GetLines())
    values = numpy_to_vtk(numpy.log10(density), deep=1)
    values.SetName("LogDensity")
    polygons.GetCellData().SetScalars(values)
    triangles = vtkTriangleFilter()
    triangles.SetInputData(polygons)
    triangles.Update()
    return triangles.GetOutput()


def main():
    arguments = example.parser(
        __doc__, map=example.file(MAP, "a map that GDAL Vector Reader takes, in an equal-area projection"),
        mass=dict(default="mass", help="the attribute with the people of each state"),
        pixels=example.number(1600, "width of the picture")).parse_args()

    example.load_plugin()
    if not hasattr(simple, "GDALVectorReader"):
        sys.exit("This ParaView has no GDAL Vector Reader")
    if not os.path.isfile(arguments.map):
        sys.exit("There is no file " + arguments.map)
    states = simple.GDALVectorReader(FileName=arguments.map)
    cartogram = simple.Cartogram(Input=states, MassArray=["CELLS", arguments.mass])
    after = example.result(cartogram)
    errors = vtk_to_numpy(after.GetFieldData().GetArray("AreaErrors"))
    print("%d regions, largest error of an area after each pass: %s" % (
        len(set(vtk_to_numpy(after.GetCellData().GetArray("TargetArea")))),
        ", ".join("%.4f" % error for error in errors)))

    # The colour is of the density on the map, in both pictures.
    error = vtk_to_numpy(after.GetCellData().GetArray("AreaError"))
    share = vtk_to_numpy(after.GetCellData().GetArray("TargetArea")) * (1 + error)
    shapes = {blend: vtkPolyData() for blend in (0, 1)}
    for blend, shape in shapes.items():
        shape.DeepCopy(example.result(cartogram, Blend=blend))
    before = areas(shapes[0], share)
    density = share / before

    bounds = numpy.array([shape.GetBounds() for shape in shapes.values()])
    low, high = bounds[:, ::2].min(0), bounds[:, 1::2].max(0)
    width, height = (high - low)[:2]
    whole = 2.1 * width
    view = example.picture_view(
        [arguments.pixels, int(1.04 * height / whole * arguments.pixels)], [1, 1, 1])
    for blend, shape in shapes.items():
        place = 1.04 * blend * width
        shown = simple.Show(example.moved(example.producer(filled(shape, density)), place, 0, 0), view,
                            "GeometryRepresentation")
        colours = example.colour_by(shown, view, ("CELLS", "LogDensity"), "Viridis")
        shown.Ambient, shown.Diffuse = 1, 0
        border = simple.Show(example.moved(example.producer(shape), place, 0, 0), view,
                             "GeometryRepresentation")
        example.paint(border, [0, 0, 0])
        border.LineWidth = max(1, arguments.pixels / 1000)
    colours.RescaleTransferFunction(*numpy.quantile(numpy.log10(density), [0.02, 0.98]))
    middle = [low[0] + 1.02 * width, low[1] + height / 2]
    example.look_down(view, middle, 1.04 * height, whole)
    path = example.output(arguments, "people.png")
    example.save_picture(path, view)
    print(path)


def areas(data, share):
    """The areas of regions, for each of their cells; those of one share are one region."""
    places = vtk_to_numpy(data.GetPoints().GetData())[:, :2]
    lines = data.GetLines()
    offsets = vtk_to_numpy(lines.GetOffsetsArray())
    ids = vtk_to_numpy(lines.GetConnectivityArray())
    x, y = (places[ids] - places[ids[0]]).T
    cross = numpy.append(x[:-1] * y[1:] - x[1:] * y[:-1], 0)
    cross[offsets[1:] - 1] = 0
    rings = numpy.abs(0.5 * numpy.add.reduceat(cross, offsets[:-1]))
    _, region = numpy.unique(share, return_inverse=True)
    return numpy.bincount(region, rings)[region]


if __name__ == "__main__":
    main()

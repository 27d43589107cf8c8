# SPDX-License-Identifier: BSD-3-Clause
"""Divides a country, a raster of people whose sea is nodata, into parts of equal population."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example
import rectified_raster as raster
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy


LAND = dict(LowerThreshold=0, UpperThreshold=1e9)


def draw(path, people, power, flow, pixels):
    """The people under the borders of Power, its parts, and those of Flow."""
    x0, x1, y0, y1 = example.fetch(people).GetBounds()[:4]
    step = 1.06 * (x1 - x0)
    width = 2 * step + x1 - x0
    view = example.picture_view([pixels, round(pixels * (y1 - y0) / width)], [1, 1, 1])

    def show(source, column, height=0):
        shown = simple.Show(example.moved(source, column * step, 0, height), view)
        shown.Ambient, shown.Diffuse = 1, 0
        return shown

    for column in range(3):
        frame = simple.Plane(Origin=[x0, y0, 0], Point1=[x1, y0, 0], Point2=[x0, y1, 0])
        example.paint(show(frame, column, -1), [0.86, 0.91, 0.96])
    land = show(simple.Threshold(Input=people, Scalars=["CELLS", "Elevation"], **LAND), 0)
    example.colour_by(land, view, ("CELLS", "Elevation"), "Viridis").RescaleTransferFunction(0, 300)
    for column in range(2):
        borders = show(simple.OutputPort(power, 2), column, 1)
        example.paint(borders, [1, 1, 1])
        borders.LineWidth = max(1, pixels / 500)
    parts = show(simple.Threshold(Input=power, Scalars=["CELLS", "SiteId"], **LAND), 1)
    polygons = show(simple.OutputPort(flow, 3), 2)
    polygons.Representation = "Filled Outlines With Edges"
    polygons.EdgeColor = [1, 1, 1]
    polygons.LineWidth = max(1, pixels / 500)
    for shown in parts, polygons:
        colours = example.colour_by(shown, view, ("CELLS", "SiteColor"), "Viridis")
        colours.InterpretValuesAsCategories = 1
        colours.Annotations = [word for i in range(12) for word in 2 * [str(i)]]
        colours.ApplyPreset("Brewer Qualitative Set2", True)
    example.look_down(view, [x0 + width / 2, (y0 + y1) / 2], y1 - y0, 2 * step)
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--pixels 600",
        parts=example.number(12, "how many parts"),
        pixels=example.number(1800, "width of the picture")).parse_args()
    example.load_plugin()
    path = example.output(arguments, "people.tif")
    raster.write_geotiff(path, raster.island())

    people = simple.GDALRasterReader(FileName=path)
    sites = simple.SampleDensity(people, NumberOfParticles=arguments.parts)
    middles = simple.RelaxBlueNoise(sites, Density=people, Method="OptimalTransport", MaximumIterations=50)
    power, flow = (simple.EqualMassCells(middles, Domain=people, Measure="Density", Shape=shape)
                   for shape in ("Power", "Flow"))
    for cells in power, flow:
        example.result(cells)
        masses = vtk_to_numpy(
            cells.GetClientSideObject().GetOutputDataObject(1).GetPointData().GetArray("CellMass"))
        people_of = masses / raster.CELL ** 2  # the raster is people per square kilometre
        print("Shape %s: %d parts of %.0f to %.0f people" % (
            str(cells.Shape).strip("'"), len(masses), people_of.min(), people_of.max()))
    drawing = example.output(arguments, "districts.svg")
    simple.SaveData(drawing, proxy=simple.OutputPort(flow, 3), ColorArray=["CELLS", "SiteColor"])
    picture = example.output(arguments, "districts.png")
    draw(picture, people, power, flow, arguments.pixels)
    print(picture + " " + drawing)


if __name__ == "__main__":
    main()

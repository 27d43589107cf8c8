# SPDX-License-Identifier: BSD-3-Clause
"""Draws a photograph under a labelled grid, and both warped so that the ink is spread evenly."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example
from paraview import simple
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkLineSource
from vtkmodules.vtkRenderingFreeType import vtkVectorText


def grid(bounds, columns, rows):
    """The lines of a grid and, in the middle of each cell, its column and row, as two data sets."""
    x0, x1, y0, y1 = bounds
    width, height = (x1 - x0) / columns, (y1 - y0) / rows
    lines, labels = vtkAppendPolyData(), vtkAppendPolyData()

    def line(*ends):
        source = vtkLineSource()
        source.SetPoint1(*ends[0], 0)
        source.SetPoint2(*ends[1], 0)
        source.SetResolution(400)  # enough points to bend
        source.Update()
        lines.AddInputData(source.GetOutput())

    for i in range(columns + 1):
        line((x0 + i * width, y0), (x0 + i * width, y1))
    for j in range(rows + 1):
        line((x0, y0 + j * height), (x1, y0 + j * height))
    for i in range(columns):
        for j in range(rows):
            text = vtkVectorText()
            text.SetText("%s%d" % (chr(ord("A") + i), j + 1))
            text.Update()
            box = text.GetOutput().GetBounds()
            place = vtkTransform()
            place.Translate(x0 + (i + 0.5) * width, y1 - (j + 0.5) * height, 0)
            place.Scale(*[0.25 * min(width, height)] * 3)
            place.Translate(-(box[0] + box[1]) / 2, -(box[2] + box[3]) / 2, 0)
            moved = vtkTransformPolyDataFilter()
            moved.SetInputConnection(text.GetOutputPort())
            moved.SetTransform(place)
            moved.Update()
            labels.AddInputData(moved.GetOutput())
    lines.Update()
    labels.Update()
    return lines.GetOutput(), labels.GetOutput()


def draw(path, parts, array, bounds, pixels):
    """Photograph, lines and labels on the left, and warped on the right."""
    x0, x1, y0, y1 = bounds
    step = 1.04 * (x1 - x0)
    zoom = pixels / (step + x1 - x0)
    view = example.picture_view([pixels, round(zoom * (y1 - y0))], [1, 1, 1])
    colors = (None, [1, 0.85, 0.1], [1, 1, 1])
    for column, row in enumerate(parts):
        for height, (part, color) in enumerate(zip(row, colors)):
            shown = simple.Show(example.moved(part, column * step, 0, height), view,
                                "GeometryRepresentation")
            shown.SetRepresentationType("Surface")
            shown.Ambient, shown.Diffuse = 1, 0
            if color:
                example.paint(shown, color)
                shown.LineWidth = 2
            else:
                simple.ColorBy(shown, ("POINTS", array.GetName()))
                shown.SetScalarBarVisibility(view, False)
                if array.GetNumberOfComponents() > 1:
                    shown.MapScalars = 0
                else:
                    simple.GetColorTransferFunction(array.GetName()).ApplyPreset("Grayscale", True)
    example.look_down(view, [(x0 + step + x1) / 2, (y0 + y1) / 2], y1 - y0, 2 * step)
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--pixels 480",
        image=example.file(),
        columns=example.number(8, "cells of the grid, left to right"),
        rows=example.number(6, "and top to bottom"),
        blend=dict(type=float, default=1, help="how far to warp, from 0 to 1"),
        pixels=example.number(2000, "width of the picture")).parse_args()

    example.load_plugin()
    image = example.open_image(arguments.image)
    data = example.fetch(image)
    bounds = example.pixel_bounds(data)
    surface = simple.ExtractSurface(Input=image)
    parts = [surface, *map(example.producer, grid(bounds, arguments.columns, arguments.rows))]
    warped = [simple.DensityEqualizingWarp(part, Density=image, Blend=arguments.blend,
                                           InvertDensity=1) for part in parts]
    example.result(warped[0])

    path = example.output(arguments, "warped-" + example.stem(arguments.image) + ".png")
    draw(path, (parts, warped), data.GetPointData().GetArray(0), bounds, arguments.pixels)
    print("%d points warped: %s" % (data.GetNumberOfPoints(), path))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Draws a photograph with dots, as a PNG and as an SVG of a width in millimetres."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_print as pages
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def stipple(image, number, **options):
    """The dots of an image and the radius that gives them the photograph's amount of ink."""
    dots = simple.SampleDensity(image, **options)
    dots.InvertDensity = 1  # dark ink is mass
    dots.NumberOfParticles = number
    mass = example.result(dots).GetPointData().GetArray("Mass").GetValue(0)
    array = example.fetch(image).GetPointData().GetArray(0)
    black = 255.0 if array.GetDataTypeSize() == 1 else array.GetRange(-1)[1]
    return dots, math.sqrt(mass / black / math.pi)


def write_png(path, dots, bounds, radius, longest):
    """The dots as ParaView draws them, the picture as wide as the photograph's domain."""
    x0, x1, y0, y1 = bounds
    zoom = longest / max(x1 - x0, y1 - y0)
    size = [round(zoom * (x1 - x0)), round(zoom * (y1 - y0))]
    view = example.picture_view(size, [1, 1, 1])
    shown = simple.Show(dots, view, "GeometryRepresentation")
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Plain circle"
    shown.GaussianRadius = radius
    example.paint(shown, [0, 0, 0])
    example.look_down(view, [(x0 + x1) / 2, (y0 + y1) / 2], y1 - y0, max(x1 - x0, y1 - y0))
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--particles 5000 --pixels 800",
        image=example.file(),
        particles=example.number(40000, "number of dots"),
        pixels=example.number(2048, "longest side of the PNG"), width=pages.WIDTH).parse_args()

    example.load_plugin()
    image = example.open_image(arguments.image)
    dots, radius = stipple(image, arguments.particles)
    bounds = example.pixel_bounds(example.fetch(image))

    path = example.output(arguments, "stipple-" + example.stem(arguments.image))
    points = vtk_to_numpy(example.fetch(dots).GetPoints().GetData())
    x0, x1, y0, y1 = bounds
    pages.write(path + ".svg", pages.Discs((x1 - x0, y1 - y0), points[:, :2] - [x0, y0],
                                           np.full(len(points), radius)), arguments.width)
    write_png(path + ".png", dots, bounds, radius, arguments.pixels)
    print("%d dots of radius %.2f pixels: %s.png, %s.svg" % (len(points), radius, path, path))


if __name__ == "__main__":
    main()

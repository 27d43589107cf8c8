# SPDX-License-Identifier: BSD-3-Clause
"""Paints a photograph with round dots: each has the photograph's colour where it is, and the size of
another array, small in what has detail."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkImagingGeneral import vtkImageGaussianSmooth

PAPER = [0.10, 0.09, 0.09]


def smoothed(values, width):
    """Means of rows and columns of numbers with Gaussian weights."""
    image = figures.apply(vtkImageGaussianSmooth(), figures.image_of(values), Dimensionality=2,
                          StandardDeviations=(width, width, 0), RadiusFactors=(3, 3, 0))
    return figures.values_of(image)


def size_of(colours, scale, ratio):
    """The size of a dot at each pixel: 1 where the picture has most detail, `ratio` where it has
    none. Detail is how much the picture changes within `scale` pixels."""
    grey = smoothed(colours @ [0.2126, 0.7152, 0.0722], scale / 4)
    detail = smoothed(np.hypot(*np.gradient(grey)), scale)
    detail = (detail / np.quantile(detail, 0.97)).clip(0, 1)
    return ratio ** (1 - np.sqrt(detail))


def add(image, name, values):
    array = numpy_to_vtk(values.ravel(), deep=1)
    array.SetName(name)
    image.GetPointData().AddArray(array)


def paint(photograph, number, scale, ratio, iterations):
    """Dots that carry the photograph's arrays. Where they are small there are more of them: as many
    as cover the same part of the paper everywhere."""
    size = size_of(figures.colours_of(photograph), scale, ratio)
    add(photograph, "Size", size)
    add(photograph, "Dots", 1 / size ** 2)
    source = example.producer(photograph)
    source.UpdatePipeline()
    dots = simple.SampleDensity(Input=source, DensityArray=["POINTS", "Dots"],
                                NumberOfParticles=number)
    if iterations == 0:
        return dots
    dots.UpdatePipeline()
    even = simple.RelaxBlueNoise(Input=dots, Density=source, DensityArray=["POINTS", "Dots"],
                                 MaximumIterations=iterations)
    even.UpdatePipeline()
    # At time 0 particles are where their seeds are: they take the arrays' values there.
    return simple.SampleDensity(Input=source, Seeds=even, DensityArray=["POINTS", "Dots"],
                                FlowTime=0)


def radius_of(dots, bounds, coverage):
    """The radius of a dot of size 1: all of them have that part of the paper's area."""
    sizes = vtk_to_numpy(example.result(dots).GetPointData().GetArray("Size"))
    area = (bounds[1] - bounds[0]) * (bounds[3] - bounds[2])
    return math.sqrt(coverage * area / (math.pi * (sizes ** 2).sum()))


def draw(path, dots, colours, bounds, radius, longest):
    """The dots in the colours and sizes that they carry."""
    x0, x1, y0, y1 = bounds
    zoom = longest / max(x1 - x0, y1 - y0)
    view = example.picture_view([round(zoom * (x1 - x0)), round(zoom * (y1 - y0))], PAPER)
    shown = simple.Show(dots, view, "GeometryRepresentation")
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Plain circle"
    simple.ColorBy(shown, ("POINTS", colours))
    shown.MapScalars = 0  # they are colours
    shown.Ambient, shown.Diffuse = 1, 0
    shown.GaussianRadius = radius
    shown.ScaleByArray = 1
    shown.SetScaleArray = ["POINTS", "Size"]
    shown.UseScaleFunction = 0
    example.look_down(view, [(x0 + x1) / 2, (y0 + y1) / 2], y1 - y0, max(x1 - x0, y1 - y0))
    example.save_picture(path, view)


def main():
    arguments = example.parser(
        __doc__, small="--particles 3000 --iterations 10 --pixels 480",
        image=example.file(),
        particles=example.number(30000, "number of dots"),
        ratio=example.number(5, "how many times as large the largest dots are"),
        scale=example.number(10, "pixels over which detail is looked for"),
        iterations=example.number(40, "of the dots' relaxation", 0),
        coverage=example.number(84, "percent of the paper that the dots have in all"),
        pixels=example.number(2048, "longest side of the picture", 64)).parse_args()

    example.load_plugin()
    photograph = example.fetch(example.open_image(arguments.image))
    bounds = example.pixel_bounds(photograph)
    colours = photograph.GetPointData().GetScalars().GetName()
    dots = paint(photograph, arguments.particles, arguments.scale, arguments.ratio,
                 arguments.iterations)
    radius = radius_of(dots, bounds, arguments.coverage / 100)
    path = example.output(arguments, "colours-%s.png" % example.stem(arguments.image))
    draw(path, dots, colours, bounds, radius, arguments.pixels)
    sizes = vtk_to_numpy(example.result(dots).GetPointData().GetArray("Size"))
    print("%d dots of radius %.2f to %.2f pixels: %s"
          % (len(sizes), radius * sizes.min(), radius * sizes.max(), path))


if __name__ == "__main__":
    main()

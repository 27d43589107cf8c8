# SPDX-License-Identifier: BSD-3-Clause
"""Discs in pictures and on pages of a size in millimetres: SVG with a circle for each, and PDF."""
import sys
from dataclasses import dataclass

import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk

MILLIMETRE = 72 / 25.4  # points of PDF
LARGEST = 5080  # millimetres, 14400 points: what readers of PDF take


@dataclass
class Discs:
    """Discs on a page of width x height units; y points up."""
    size: tuple
    points: np.ndarray  # rows of x and y
    radii: np.ndarray
    colours: np.ndarray = None  # rows of RGB, 0 to 255; None: all black

    def area(self):
        return np.pi * (self.radii ** 2).sum()


def write_svg(path, discs, width=None):
    """Writes discs as circles, with three decimals; the page's width is in millimetres, or left to
    who shows it."""
    across, up = discs.size
    page = "" if width is None else 'width="%gmm" height="%gmm" ' % (width, width * up / across)
    fills = [""] * len(discs.points) if discs.colours is None else [
        ' fill="#%02x%02x%02x"' % tuple(colour) for colour in discs.colours.tolist()]
    with open(path, "w", encoding="utf-8") as file:
        file.write('<svg xmlns="http://www.w3.org/2000/svg" %sviewBox="0 0 %g %g">\n'
                   '<rect width="100%%" height="100%%" fill="white"/>\n' % (page, across, up))
        for (x, y), radius, fill in zip(discs.points, discs.radii, fills):
            file.write('<circle cx="%.3f" cy="%.3f" r="%.3f"%s/>\n' % (x, up - y, radius, fill))
        file.write("</svg>\n")


def write_pdf(path, discs, width, title):
    """Writes discs on a page of a width in millimetres. One outline serves all: a disc takes tens
    of bytes. Black is grey of the value 0, which is printed with black ink alone."""
    try:
        from reportlab.pdfgen.canvas import Canvas  # only who writes PDF needs it
    except ImportError:
        sys.exit("PDF is written with reportlab, which is missing: apt install python3-reportlab")
    scale = width * MILLIMETRE / discs.size[0]
    canvas = Canvas(path, [scale * side for side in discs.size], pageCompression=1, invariant=1)
    canvas.setTitle(title)
    canvas.beginForm("disc", -1, -1, 1, 1)
    canvas.circle(0, 0, 1, stroke=0, fill=1)
    canvas.endForm()
    canvas.setFillGray(0)
    points = (scale * discs.points).round(3).tolist()
    radii = (scale * discs.radii).round(4).tolist()
    colours = None if discs.colours is None else (discs.colours / 255).round(4).tolist()
    for i, ((x, y), radius) in enumerate(zip(points, radii)):
        canvas.saveState()
        if colours:
            canvas.setFillColorRGB(*colours[i])
        canvas.transform(radius, 0, 0, radius, x, y)
        canvas.doForm("disc")
        canvas.restoreState()
    canvas.save()


def pictures(discs, pixels, enlarged=(1,)):
    """Pages as ParaView draws them, so many pixels wide: the middle, enlarged by factors."""
    width, height = discs.size
    data = figures.shape(discs.points, [1] * len(discs.points), "Verts")
    colours = np.zeros((len(discs.points), 3), np.uint8) if discs.colours is None else discs.colours
    for name, values in ("Radius", discs.radii), ("Colour", colours):
        array = numpy_to_vtk(values, deep=1)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    view = example.picture_view([pixels, max(1, round(pixels * height / width))], [1, 1, 1])
    source = example.producer(data)
    shown = simple.Show(source, view, "GeometryRepresentation")
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Plain circle"
    shown.GaussianRadius = 1
    shown.ScaleByArray, shown.UseScaleFunction = 1, 0
    shown.SetScaleArray = ["POINTS", "Radius"]
    shown.ColorArrayName, shown.MapScalars = ["POINTS", "Colour"], 0
    drawn = []
    for times in enlarged:
        example.look_down(view, [width / 2, height / 2], height / times, max(width, height))
        drawn.append(figures.drawn(example.save_picture, view))
    simple.Delete(view)
    simple.Delete(source)
    return drawn

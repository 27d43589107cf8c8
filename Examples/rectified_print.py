# SPDX-License-Identifier: BSD-3-Clause
"""Discs in pictures and on pages of a size in millimetres, SVG and PDF."""
import argparse
import os
import sys
from dataclasses import dataclass

import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk

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


def width(text):
    """An argument of a parser that is the width of a page."""
    number = float(text)
    if not 0 < number <= LARGEST:
        raise argparse.ArgumentTypeError("%s is not more than 0 and at most %d mm" % (text, LARGEST))
    return number


WIDTH = dict(type=width, default=200, help="of the page, in mm (default: %(default)s)")


def drawing(discs):
    """A white page under vertices, with the arrays Radius and Colour."""
    right, top = discs.size
    corners = [[0, 0], [right, 0], [right, top], [0, top]]
    data = figures.polydata(np.concatenate([corners, discs.points]))
    count = len(discs.points)
    data.SetPolys(figures.cells([4]))
    data.SetVerts(figures.cells([1] * count, first=4))
    colours = np.zeros((count, 3), np.uint8) if discs.colours is None else discs.colours
    for name, values in (("Radius", np.concatenate([np.zeros(4), discs.radii])),
                         ("Colour", np.concatenate([np.full((4, 3), 255, np.uint8), colours]))):
        array = numpy_to_vtk(values, deep=1)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def write(path, discs, millimetres, order="File"):
    """Writes discs as SVG or PDF, by the path's ending. The page is so wide; what lies beyond it is
    cut off. `order` is that of the writers."""
    if os.path.isfile(path):
        os.remove(path)
    source = example.producer(drawing(discs))
    simple.SaveData(path, proxy=source, Width=millimetres, Order=order,
                    PageBounds=[0, discs.size[0], 0, discs.size[1], 0, 0],
                    RadiusArray=["POINTS", "Radius"], ColorArray=["POINTS", "Colour"])
    simple.Delete(source)
    if not os.path.isfile(path):
        sys.exit(1)  # the writer has said why


def pictures(discs, pixels, enlarged=(1,)):
    """Pages as ParaView draws them, so many pixels wide: the middle, enlarged by factors."""
    width, height = discs.size
    view = example.picture_view([pixels, max(1, round(pixels * height / width))], [1, 1, 1])
    source = example.producer(drawing(discs))
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

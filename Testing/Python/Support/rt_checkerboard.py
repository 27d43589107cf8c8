# SPDX-License-Identifier: BSD-3-Clause
"""A surface whose checkerboard has its squares where one knows: a rectangle of 3 by 1."""
import os

import numpy as np
from PIL import Image
from rt_testing import OUTPUT

SQUARES = 24  # of the representation, along a side
SIZE = (720, 480)  # of a picture
RECTANGLE = (0, 3, 0, 1)  # where the surface is
SQUARE = (0, 1, 0, 1)  # where it is laid flat


def parameterized(simple):
    plane = simple.Plane(Origin=[0, 0, 0], Point1=[3, 0, 0], Point2=[0, 1, 0], XResolution=4,
                         YResolution=4)
    return simple.AreaPreservingParameterization(plane, Corners=[0, 4, 24, 20])


def look_at(view, box):
    """From above, so that a box of x and y fills the picture in one direction."""
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 0
    view.CameraParallelProjection = 1
    middle = [(box[0] + box[1]) / 2, (box[2] + box[3]) / 2]
    view.CameraFocalPoint, view.CameraPosition = [*middle, 0], [*middle, 10]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = max(box[3] - box[2], (box[1] - box[0]) * SIZE[1] / SIZE[0]) / 2


def picture(simple, view, name):
    """The view's pixels, as rows of luminance from 0 to 255."""
    path = os.path.join(OUTPUT, name)
    simple.SaveScreenshot(path, view, ImageResolution=SIZE)
    with Image.open(path) as image:
        return np.asarray(image.convert("L")).astype(float)


def tones(pixels, view, box):
    """The luminance in the middle of each square, by its place from the lower left."""
    scale = SIZE[1] / (2 * view.CameraParallelScale)  # pixels a unit
    middle = np.array(view.CameraFocalPoint[:2])
    places = (np.arange(SQUARES) + 0.5) / SQUARES
    x = SIZE[0] / 2 + (box[0] + (box[1] - box[0]) * places - middle[0]) * scale
    y = SIZE[1] / 2 - (box[2] + (box[3] - box[2]) * places - middle[1]) * scale
    return pixels[np.ix_(y.astype(int), x.astype(int))]


def is_checkered(found):
    """Whether squares are light and dark in turn, from a light one at the lower left."""
    i, j = np.indices(found.shape)
    light, dark = found[(i + j) % 2 == 0], found[(i + j) % 2 == 1]
    return bool(light.min() > 1.4 * dark.max())

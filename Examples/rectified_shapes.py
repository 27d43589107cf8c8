# SPDX-License-Identifier: BSD-3-Clause
"""What the morphs and barycenters share: real shapes, their silhouettes, and how they are drawn.

The meshes are those of Debian's libcgal-demo, which CMake/setup.sh unpacks into build-meshes/, and
spot of Testing/Data. All that are named here are closed and manifold.
"""
import os
import re
import resource
import sys
import time

import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkProbeFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkImagingCore import vtkImageConstantPad

MESHES = os.path.join(example.ROOT, "build-meshes")
# The file, and which of its axes point right and up when the shape is seen from its best side.
SHAPES = {"armadillo": ("armadillo.off", "-x", "+y"),
          "bear": ("bear.off", "+x", "+y"),
          "bull": ("bull.off", "+x", "+y"),
          "bunny": ("bunny00.off", "+x", "+y"),
          "camel": ("camel.off", "+z", "+y"),
          "coupling": ("couplingdown.off", "+x", "+y"),
          "cow": ("cow.off", "+x", "+y"),
          "dinosaur": ("dino.off", "+y", "+z"),
          "eight": ("eight.off", "-x", "+z"),
          "elephant": ("refined_elephant.off", "+x", "+y"),
          "foot": ("bones.off", "-x", "+z"),
          "hand": ("hand.off", "-x", "+z"),
          "knot": ("knot1.off", "+x", "+y"),
          "man": ("man.off", "-x", "+z"),
          "rings": ("knot2.off", "+x", "+y"),
          "rotor": ("rotor.off", "+y", "+z"),
          "spot": ("spot.vtp", "-z", "+y"),
          "triceratops": ("triceratops.off", "+x", "+y")}
COLOURS = np.array([[25, 75, 160], [190, 35, 65], [15, 125, 90], [215, 130, 15]], float)
MARGIN = 0.06  # around silhouettes, of the side of the image
# With the default of 32 steps a few particles end in the narrow gaps of silhouettes; the filters
# would move them to the nearest mass, and warn.
SMOOTH = {"Kernel": "Gaussian", "NumberOfSteps": 64}
FINE = 4  # points along the sides of a pixel that its covered part is counted with


def read_off(path):
    """The polygons of a text file in the Object File Format."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line for line in re.sub("#.*", "", file.read()).splitlines() if line.strip()]
    words = " ".join(lines[:2]).split()
    try:
        if words[0] not in ("OFF", "COFF", "NOFF", "CNOFF"):  # normals and colours follow x, y, z
            raise ValueError
        points, faces = int(words[1]), int(words[2])
        lines = lines[1 if len(lines[0].split()) > 1 else 2:]
        coordinates = np.array([line.split()[:3] for line in lines[:points]], float)
        corners = [line.split() for line in lines[points:points + faces]]
        corners = [np.array(corner[1:1 + int(corner[0])], np.int64) for corner in corners]
        if coordinates.shape != (points, 3) or not 0 < faces == len(corners):
            raise ValueError
        ids = np.concatenate(corners)
        if ids.min() < 0 or ids.max() >= points:
            raise ValueError
    except (IndexError, ValueError):
        sys.exit(path + " holds no polygons of the Object File Format as text")

    mesh = figures.polydata(coordinates)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.cumsum([0, *map(len, corners)]), deep=1),
                  numpy_to_vtkIdTypeArray(ids, deep=1))
    mesh.SetPolys(cells)
    return mesh


def read_mesh(name):
    """The mesh of a shape that is named above, or of a file, and its axes right and up."""
    path, right, up = SHAPES.get(name, (name, "+x", "+y"))
    if name in SHAPES:
        path = os.path.join(example.DATA if name == "spot" else MESHES, path)
    if not os.path.isfile(path):
        sys.exit("There is no file %s; %s" % (path, "bash Examples/run.sh fetches it"
                                              if name in SHAPES else
                                              "the shapes with names are " + ", ".join(SHAPES)))
    if path.endswith(".off"):
        return read_off(path), right, up
    try:
        mesh = example.fetch(simple.OpenDataFile(path))
    except RuntimeError:
        sys.exit("ParaView has no reader for " + path)
    if not mesh or not mesh.IsA("vtkPolyData") or mesh.GetNumberOfPolys() == 0:
        sys.exit(path + " holds no surface that ParaView can read")
    return mesh, right, up


def moved(mesh, transform):
    return figures.apply(vtkTransformPolyDataFilter(), mesh, Transform=transform)


def axis(words):
    """The vector of +x, -x, +y ..."""
    return (-1 if words[0] == "-" else 1) * np.eye(3)["xyz".index(words[1])]


def posed(name):
    """A shape seen from +z with y up, its middle in the origin and its longest side 1."""
    mesh, right, up = read_mesh(name)
    right, up = axis(right), axis(up)
    low, high = np.array(mesh.GetBounds()).reshape(3, 2).T
    turn = np.eye(4)
    turn[:3, :3] = [right, up, np.cross(right, up)]
    turn[:3, 3] = -turn[:3, :3] @ (low + high) / 2
    pose = vtkTransform()
    pose.SetMatrix(turn.ravel())
    pose.PostMultiply()
    pose.Scale(*[1 / (high - low).max()] * 3)
    return moved(mesh, pose)


def silhouette(names, size):
    """The image of size x size pixels of 0 to 1 that a shape covers, or two of them, left+right."""
    fine = vtkImageData()
    fine.SetDimensions(FINE * size, FINE * size, 1)
    fine.SetSpacing(1 / FINE, 1 / FINE, 1)
    fine.SetOrigin(0.5 / FINE, 0.5 / FINE, 0)
    covered = np.zeros(fine.GetNumberOfPoints(), bool)
    names = names.split("+")
    width = (1 - MARGIN) / len(names)
    for i, name in enumerate(names):
        mesh = posed(name)
        low, high = np.array(mesh.GetBounds()).reshape(3, 2)[:2].T
        zoom = min((width - MARGIN, 1 - 2 * MARGIN) / (high - low))
        place = vtkTransform()
        place.Scale(size, size, 0)
        place.Translate((1 + (2 * i + 1 - len(names)) * width) / 2, 0.5, 0)
        place.Scale(zoom, zoom, 1)
        place.Translate(*-(low + high) / 2, 0)
        probe = figures.apply(vtkProbeFilter(), fine, SourceData=moved(mesh, place))
        covered |= vtk_to_numpy(probe.GetPointData().GetArray("vtkValidPointMask")) > 0
    return figures.image_of(covered.reshape(size, FINE, size, FINE).mean(axis=(1, 3)))


def inked(image, colour):
    """The picture of a density from white, 0, to a colour, 1 and more."""
    array = image.GetPointData().GetScalars()
    width, height = image.GetDimensions()[:2]
    values = np.clip(vtk_to_numpy(array), 0, 1).reshape(height, width, 1)
    return (255 - values * (255 - np.array(colour))).round().astype(np.uint8)


def mixed(weights):
    """The mean of the COLOURS of the shapes, with weights."""
    return np.array(weights) @ COLOURS[:len(weights)] / np.sum(weights)


def peak_memory():
    """The most memory that this process had, in GiB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2 ** 20


class Watch:
    """Seconds of a clock and of all processors between calls."""

    def __init__(self):
        self.lap()

    def lap(self):
        now = np.array([time.perf_counter(), time.process_time()])
        before, self.now = getattr(self, "now", now), now
        return now - before


def names(default, words, joined=True):
    """An argument of a parser that is shapes; two may be joined in pictures."""
    return dict(nargs="*", default=default,
                help=words + ": names of rectified_shapes.py or files of surfaces"
                + (", or two joined by + to be side by side" if joined else ""))


def pairs(parser, names):
    """Names two by two."""
    if len(names) == 0 or len(names) % 2:
        parser.error("%d shapes are given; it must be two, or more pairs" % len(names))
    return list(zip(names[::2], names[1::2]))


def cubed(image, cells):
    """An image of a density in a cube of cells cells a side around the origin, empty where it is
    new."""
    pad = vtkImageConstantPad()
    extent = []
    for size in image.GetDimensions():
        before = (cells - size) // 2
        extent += [-before, cells - 1 - before]
    pad.SetOutputWholeExtent(extent)
    grown = figures.apply(pad, image)
    cube = vtkImageData()
    cube.SetDimensions(cells, cells, cells)
    cube.SetSpacing(image.GetSpacing())
    cube.SetOrigin([-(cells - 1) / 2 * step for step in image.GetSpacing()])
    cube.GetPointData().SetScalars(grown.GetPointData().GetScalars())
    return cube


def surface(image):
    """The mesh where a density is half of that of a solid, with its gradients as normals."""
    edges = vtkFlyingEdges3D()  # the Contour of ParaView 5.11 uses an older filter
    edges.SetInputData(image)
    edges.SetValue(0, 0.5)
    edges.ComputeScalarsOff()
    edges.Update()
    return edges.GetOutput()


def lit(mesh, colour, pixels):
    """The picture of a surface in the unit box around the origin, from the right and above."""
    view = example.picture_view([pixels, pixels], [1, 1, 1])
    source = example.producer(mesh)
    shown = simple.Show(source, view, "GeometryRepresentation")
    example.paint(shown, [0.35 + 0.65 * part / 255 for part in colour])
    shown.Ambient, shown.Specular, shown.SpecularPower = 0.12, 0.15, 20
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = [1.3, 0.9, 2.6]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = 0.6
    picture = figures.drawn(example.save_picture, view)
    simple.Delete(view)
    simple.Delete(source)
    return picture

# SPDX-License-Identifier: BSD-3-Clause
"""Stipples a surface by its area and by its curvature, and prints how even the dots are."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_disks as disks
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersGeneral import vtkCurvatures

LIMIT = 0.95  # of the points, whose curvature is not cut off


def add_curvature(mesh):
    """Adds the array Curvature: how much the surface bends at a point, from a tenth of the largest
    value on, so that flat parts have dots as well."""
    curved = figures.apply(vtkCurvatures(), mesh, CurvatureType=1)  # mean
    bend = np.abs(vtk_to_numpy(curved.GetPointData().GetArray("Mean_Curvature")))
    most = max(np.quantile(bend, LIMIT), 1e-300)  # 0 where all is flat
    density = numpy_to_vtk(0.1 + 0.9 * np.minimum(bend, most) / most, deep=1)
    density.SetName("Curvature")
    mesh.GetPointData().AddArray(density)


def spacing(dots, area):
    """The mean distance of the nearest dot by that of the hexagonal lattice of the plane."""
    places = vtk_to_numpy(dots.GetPoints().GetData())
    nearest = cKDTree(places).query(places, k=2)[0][:, 1]
    return nearest.mean() / np.sqrt(2 * area / (np.sqrt(3) * len(places)))


def draw(mesh, dots, size, pose, pixels):
    """The picture of black discs on a white surface that hides those behind it."""
    view = example.picture_view([pixels, pixels], [1, 1, 1])
    sources = example.producer(mesh), example.producer(dots)
    surface = simple.Show(sources[0], view, "GeometryRepresentation")
    example.paint(surface, [1, 1, 1])
    surface.Ambient, surface.Diffuse = 1, 0
    discs = simple.Glyph(Input=sources[1], GlyphType="Cylinder", GlyphMode="All Points",
                         OrientationArray=["POINTS", "Normal"], ScaleArray=["POINTS", "No scale array"],
                         ScaleFactor=size)
    discs.GlyphType.Resolution, discs.GlyphType.Radius = 16, 1
    # Glyphs have their x axis along Normal; the cylinder's own axis is y.
    discs.GlyphTransform.Rotate, discs.GlyphTransform.Scale = [0, 0, -90], [1, 0.5, 1]
    ink = simple.Show(discs, view, "GeometryRepresentation")
    example.paint(ink, [0, 0, 0])
    ink.Ambient, ink.Diffuse = 1, 0
    disks.aim(view, mesh, pose)
    picture = figures.drawn(example.save_picture, view)
    for proxy in (view, discs, *sources):
        simple.Delete(proxy)
    return picture


def main():
    arguments = example.parser(
        __doc__, small="--dots 3000 --panel 300",
        surface=dict(nargs="?", default="bunny",
                     help="a name of rectified_shapes.py or rectified_disks.py, or a "
                     "file of a surface (default: %(default)s)"),
        dots=example.number(16384, "dots on the surface"), panel=640).parse_args()

    example.load_plugin()
    mesh, pose = disks.read(arguments.surface)
    add_curvature(mesh)
    source = example.producer(mesh)
    stipple = simple.SampleSurface(source, NumberOfParticles=arguments.dots)
    rows, pictures = [], []
    for words, array in ("by area", ["POINTS", "None"]), ("by curvature", ["POINTS", "Curvature"]):
        dots = example.result(stipple, DensityArray=array)
        mass = dots.GetFieldData().GetArray("TotalMass").GetValue(0)
        if array[1] == "None":
            area = mass
        # Dots as far apart as they are on a hexagonal lattice would touch.
        size = 0.5 * np.sqrt(2 * area / (np.sqrt(3) * arguments.dots))
        rows.append([words, "%d" % dots.GetNumberOfPoints(), "%.6g" % mass,
                     "%.2f" % spacing(dots, area)])
        pictures.append((words, draw(mesh, dots, 0.5 * size, pose, arguments.panel)))
    figures.table("The dots. Spacing: the mean distance of the nearest by that of the hexagonal "
                  "lattice of as many on\nthe same area; independent dots have 0.5.",
                  ["density", "dots", "TotalMass", "spacing"], rows)
    print("\n" + figures.write_montage(
        arguments, "stipple-surface-%s.png" % example.stem(arguments.surface), [pictures]))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Cuts closed surfaces open along seams, lays them flat with equal areas, and prints how exact that
is."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_disks as disks
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkPolyDataNormals, vtkTubeFilter

SQUARES = 32  # of the checkerboard along a side
RED = [0.8, 0.1, 0.1]


def seams_of(mesh):
    """Tubes along the edges where a mesh is open: seams, if it was closed."""
    edges = figures.apply(vtkFeatureEdges(), mesh, BoundaryEdges=1, FeatureEdges=0,
                          NonManifoldEdges=0, ManifoldEdges=0, Coloring=0)
    return figures.apply(vtkTubeFilter(), edges, Radius=0.004 * mesh.GetLength(), NumberOfSides=8)


def paint_normals(flat, mesh):
    """Gives a mesh laid flat the colours of the normals on the surface, x, y and z as RGB."""
    normals = figures.apply(vtkPolyDataNormals(), mesh, Splitting=0)
    normals = vtk_to_numpy(normals.GetPointData().GetNormals())
    ids = flat.GetPointData().GetArray("PointIds")
    if ids:
        normals = normals[vtk_to_numpy(ids)]
    colours = numpy_to_vtk(figures.bytes_of((normals + 1) / 2), deep=1)
    colours.SetName("Colours")
    flat.GetPointData().SetScalars(colours)


def flat_picture(flat, pixels):
    """The picture of a mesh laid flat in the colours of its points."""
    view = example.picture_view([pixels, pixels], [1, 1, 1])
    source = example.producer(flat)
    shown = simple.Show(source, view, "GeometryRepresentation")
    simple.ColorBy(shown, ("POINTS", "Colours"))
    shown.MapScalars, shown.Ambient, shown.Diffuse = 0, 1, 0
    example.look_down(view, [0.5, 0.5], 1.04, 2)
    picture = figures.drawn(example.save_picture, view)
    for proxy in view, source:
        simple.Delete(proxy)
    return picture


def row(name, mesh, cut):
    """A row of the table: how the map changes areas and angles."""
    quotient, angle, share = disks.distortion(
        disks.triangles(cut), disks.points(cut), disks.coordinates(cut, "AreaPreservingExact"))
    off = np.abs(quotient - 1)
    order = np.argsort(off)
    sums = np.cumsum(share[order])
    median, most = (off[order][np.searchsorted(sums, part * sums[-1])] for part in (0.5, 0.95))
    return ["%s (%d)" % (name, mesh.GetNumberOfPolys()),
            "%d" % (cut.GetNumberOfPoints() - mesh.GetNumberOfPoints()), "%.3f" % median,
            "%.3f" % most, "%d" % (quotient <= 0).sum(), "%.1f" % (share @ angle)]


def main():
    arguments = example.parser(
        __doc__, small="--panel 160",
        surfaces=dict(nargs="*", default=["bunny", "armadillo", "eight"],
                      help="names of rectified_shapes.py or files of closed surfaces "
                      "(default: bunny, armadillo, eight)"), panel=360).parse_args()
    example.load_plugin()
    rows, pictures = [], []
    for name in arguments.surfaces:
        mesh, (towards, up) = disks.read(name)
        source = example.producer(mesh)
        maps = simple.AreaPreservingParameterization(source)
        cut = example.result(maps)
        flat = maps.GetClientSideObject().GetOutputDataObject(1)
        paint_normals(flat, mesh)
        rows.append(row(example.stem(name), mesh, cut))
        seams = seams_of(cut)
        words = ["%s, and its seams" % example.stem(name), "from behind"]
        pictures.append(
            [(word, disks.textured(cut, "AreaPreserving", SQUARES, (side, up), arguments.panel,
                                   (seams, RED)))
             for word, side in zip(words, (np.array(towards), -np.array(towards)))]
            + [("laid flat, colours of the normals", flat_picture(flat, arguments.panel))])
        for proxy in maps, source:
            simple.Delete(proxy)
    figures.table("The deviation from 1 of a triangle's share of the square by that of the surface, "
                  "weighted by area.\nAngles: the mean quotient of the singular values.",
                  ["surface (triangles)", "doubled points", "median", "95 %", "flipped", "angles"],
                  rows)
    print("\n" + figures.write_montage(arguments, "closed-surfaces.png", pictures))


if __name__ == "__main__":
    main()

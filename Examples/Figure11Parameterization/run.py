# SPDX-License-Identifier: BSD-3-Clause
"""Remakes Figure 11 of the paper: surfaces laid flat by a conformal map and by one that keeps areas.

Beside them Tutte's map, and figures of how areas and angles change.
"""
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_disks as disks
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkPolyData

SQUARES = 24  # of the checkerboard along a side
PRESET = "Cool to Warm"
LIMIT = 0.3  # of the colours, for the share of the area in the square by that of the surface's


def tutte(triangles, points, square, corners):
    """Tutte's map: the boundary on the sides by its length, other points in the middle of their
    neighbours. `square` is another map of the points with the same corners."""
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
    count = len(points)
    place = np.zeros((count, 2))
    loop = disks.boundary(triangles)
    loop = np.roll(loop, -int(np.flatnonzero(loop == corners[0])[0]))
    ends = [int(np.flatnonzero(loop == corner)[0]) for corner in corners] + [len(loop)]
    loop = np.append(loop, loop[0])
    for side, (x, y, u, v) in enumerate([(0, 0, 1, 0), (1, 0, 0, 1), (1, 1, -1, 0), (0, 1, 0, -1)]):
        part = loop[ends[side]:ends[side + 1] + 1]
        length = np.append(0, np.cumsum(np.linalg.norm(np.diff(points[part], axis=0), axis=1)))
        place[part] = np.array([x, y]) + (length / length[-1])[:, None] * np.array([u, v])
    ones = np.ones(2 * len(edges))
    both = np.vstack([edges, edges[:, ::-1]])
    graph = coo_matrix((ones, both.T), shape=(count, count)).tocsr()
    inner = np.ones(count, bool)
    inner[loop] = False
    degree = np.asarray(graph.sum(axis=1)).ravel()
    matrix = coo_matrix((degree[inner], 2 * [np.arange(inner.sum())])) - graph[inner][:, inner]
    place[inner] = spsolve(matrix.tocsc(), graph[inner][:, ~inner] @ place[~inner])
    return place


def row(name, words, triangles, points, map_, seconds):
    """A row of the table: how a map of points changes areas and angles."""
    quotient, angle, share = disks.distortion(triangles, points, map_)
    off = np.abs(quotient - 1)
    order = np.argsort(off)
    sums = np.cumsum(share[order])
    quantile = [off[order][np.searchsorted(sums, part * sums[-1])] for part in (0.5, 0.95)]
    return [name, words, "%.4f" % np.sqrt(share @ off ** 2), *("%.4f" % q for q in quantile),
            "%d" % (quotient <= 0).sum(), "%.2f" % (share @ angle),
            "%.2f" % seconds if seconds else ""]


def flat_output(maps, polish):
    """The mesh in the square. A copy, whose arrays another run leaves."""
    example.result(maps, Polish=polish)
    plane = vtkPolyData()
    plane.ShallowCopy(maps.GetClientSideObject().GetOutputDataObject(1))
    return plane


def measure(name, mesh, resolution):
    """Rows of the table, the mesh with its maps, and the mesh laid flat by the flow alone and with the
    polish."""
    source = example.producer(mesh)
    maps = simple.AreaPreservingParameterization(source, Resolution=resolution, Seams="None")
    # The filter warns of triangles that the flow alone turns over; the table counts them.
    warns = maps.GetClientSideObject().AddObserver("WarningEvent", lambda *_: None)
    clock = time.perf_counter()
    alone = flat_output(maps, 0)
    middle = time.perf_counter()
    maps.GetClientSideObject().RemoveObserver(warns)
    again = time.perf_counter()
    kept = flat_output(maps, 1)
    end = time.perf_counter()
    made = example.result(maps)
    points, triangles = disks.points(made), disks.triangles(made)
    conformal = disks.coordinates(made, "Conformal")
    corners = disks.corners(conformal)
    label = "%s (%d)" % (name, len(triangles))
    rows = [row(label, "Tutte", triangles, points, tutte(triangles, points, conformal, corners), 0),
            row("", "conformal", triangles, points, conformal, 0),
            row("", "flow alone", triangles, points, disks.points(alone)[:, :2], middle - clock),
            row("", "and polish", triangles, points, disks.points(kept)[:, :2], end - again)]
    simple.Delete(maps)
    simple.Delete(source)
    return rows, made, alone, kept


def flat(plane, preset, values, limits, pixels):
    """The picture of a mesh laid flat, coloured by values of its triangles."""
    colour = numpy_to_vtk(values, deep=1)
    colour.SetName("Colour")
    plane.GetCellData().SetScalars(colour)
    view = example.picture_view([pixels, pixels], [1, 1, 1])
    source = example.producer(plane)
    shown = simple.Show(source, view, "GeometryRepresentation")
    shown.SetRepresentationType("Surface With Edges" if len(values) < 30000 else "Surface")
    shown.EdgeColor, shown.LineWidth = [0.2, 0.2, 0.2], 0.5
    shown.Ambient, shown.Diffuse, shown.Interpolation = 1, 0, "Flat"
    simple.ColorBy(shown, ("CELLS", "Colour"))
    shown.SetScalarBarVisibility(view, False)
    colours = simple.GetColorTransferFunction("Colour")
    colours.ApplyPreset(preset, True)
    colours.RescaleTransferFunction(*limits)
    example.look_down(view, [0.5, 0.5], 1.04, 2)
    picture = figures.drawn(example.save_picture, view)
    for proxy in view, source:
        simple.Delete(proxy)
    return picture


def pictures_of(mesh, alone, kept, pose, pixels):
    """Rows of pictures: the maps with the triangles' areas, and on the surface."""
    conformal = disks.laid_flat(mesh, disks.coordinates(mesh, "Conformal"))

    def quotient(plane):
        return disks.distortion(disks.triangles(mesh), disks.points(mesh),
                                disks.points(plane)[:, :2])[0]

    factor = np.log10(np.maximum(quotient(conformal), 1e-9))
    spread = max(np.abs(np.quantile(factor, (0.02, 0.98))).max(), 0.01)
    limits = 1 - LIMIT, 1 + LIMIT
    words = "%s, area \u00b1{:.0f} %%".format(100 * LIMIT)
    times = ("%.1f" if spread < 1 else "%.0f") % 10 ** spread
    return [[("conformal, area \u00d7 or / " + times,
              flat(conformal, PRESET, factor, (-spread, spread), pixels)),
             (words % "flow alone", flat(alone, PRESET, quotient(alone), limits, pixels)),
             (words % "flow and polish", flat(kept, PRESET, quotient(kept), limits, pixels))],
            [("surface", disks.lit(mesh, pose, pixels)),
             ("conformal", disks.textured(mesh, "Conformal", SQUARES, pose, pixels)),
             ("areas kept", disks.textured(mesh, "AreaPreserving", SQUARES, pose, pixels))]]


def main():
    arguments = example.parser(
        __doc__, small="--resolution 128 --panel 160",
        surfaces=dict(nargs="*", default=list(disks.NAMES),
                      help="names of rectified_disks.py or files of surfaces that are "
                      "disks (default: all that have names)"),
        resolution=example.number(1024, "cells along the grid of the flow"),
        panel=360).parse_args()

    example.load_plugin()
    rows = []
    paths = []
    for name in arguments.surfaces:
        mesh, pose = disks.read(name)
        added, *made = measure(example.stem(name), mesh, arguments.resolution)
        rows += added
        paths.append(figures.write_montage(
            arguments, "figure11-%s.png" % example.stem(name),
            pictures_of(*made, pose, arguments.panel)))
    figures.table(
        "The deviation from 1 of a triangle's share of the square by that of the surface, weighted "
        "by area.\nAngles: the mean quotient of the singular values. Seconds: with the conformal map.",
        ["surface (triangles)", "map", "rms", "median", "95 %", "flipped", "angles", "s"], rows)
    print()
    for path in paths:
        print(path)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""What the examples with surfaces share: real ones that are disks, their maps, how they are drawn.

Meshes are those of Debian's libcgal-demo, which CMake/setup.sh unpacks into build-meshes/; the
terrain is a height field of python-matplotlib-data.
"""
import os
import sys
import tempfile

import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_shapes as shapes
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

TERRAIN = "/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz"
# The direction that they are looked at from, and what is up.
NAMES = {"lion-head": ((0, 0, 1), (0, 1, 0)),
         "mannequin-devil": ((0.3, -1, 0.25), (0, 0, 1)),
         "nefertiti": ((0, 0, 1), (0, 1, 0)),
         "mushroom": ((0.2, -1, 0.6), (0, 0, 1)),
         "three_peaks": ((0.4, -0.5, 1), (0, -1, 0)),
         "hemisphere": ((0.3, -1, 1), (0, 0, 1)),
         "terrain": ((0.2, -1, 1.2), (0, 0, 1))}


def mesh_of(points, triangles):
    """A vtkPolyData of rows of x, y and z, and of three numbers of points."""
    mesh = figures.polydata(points)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(triangles) + 1, 3), deep=1),
                  numpy_to_vtkIdTypeArray(np.ravel(triangles).astype(np.int64), deep=1))
    mesh.SetPolys(cells)
    return mesh


def hemisphere(rings=96):
    """Rings of 6, 12, 18 ... points around the pole, with triangles of about equal sides."""
    points, starts = [(0, 0, 1)], [0]
    for ring in range(1, rings + 1):
        starts.append(len(points))
        slope = np.pi / 2 * ring / rings
        around = np.pi / 3 * np.arange(6 * ring) / ring
        points += list(zip(np.sin(slope) * np.cos(around), np.sin(slope) * np.sin(around),
                           np.full(6 * ring, np.cos(slope))))
    triangles = []
    for ring in range(1, rings + 1):
        inside, outside = 6 * ring - 6 or 1, 6 * ring
        for sector in range(6):
            for k in range(ring):
                a = starts[ring - 1] + (sector * (ring - 1) + k) % inside
                b, c = (starts[ring] + (sector * ring + k + i) % outside for i in (0, 1))
                triangles.append((a, b, c))
                if k + 1 < ring:
                    d = starts[ring - 1] + (sector * (ring - 1) + k + 1) % inside
                    triangles.append((a, c, d))
    return mesh_of(np.array(points), np.array(triangles))


def terrain(path=TERRAIN):
    """A height field in metres, two triangles between each four values."""
    if not os.path.isfile(path):
        sys.exit("There is no file %s; it is in python-matplotlib-data" % path)
    data = np.load(path)
    heights = data["elevation"][::-1].astype(float)
    degree = 111320.0  # metres
    latitude = np.radians((data["ymin"] + data["ymax"]) / 2)
    rows, columns = heights.shape
    y, x = np.mgrid[:rows, :columns]
    points = np.stack([x * float(data["dx"]) * degree * np.cos(latitude),
                       y * float(data["dy"]) * degree, heights], axis=-1).reshape(-1, 3)
    a = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    b, c, d = a + 1, a + columns, a + columns + 1
    return mesh_of(points, np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)]))


def read(name):
    """A surface that is named above or in rectified_shapes.py, or of a file, and the direction that
    it is looked at from and what is up."""
    if name == "hemisphere":
        return hemisphere(), NAMES[name]
    if name == "terrain":
        return terrain(), NAMES[name]
    path = os.path.join(shapes.MESHES, name + ".off") if name in NAMES else name
    mesh, right, up = shapes.read_mesh(path)
    right, up = shapes.axis(right), shapes.axis(up)
    return mesh, NAMES.get(name, (np.cross(right, up), up))


def points(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData())


def triangles(mesh):
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def coordinates(mesh, name):
    """A copy of an array of texture coordinates."""
    return vtk_to_numpy(mesh.GetPointData().GetArray(name)).copy()


def corners(map_):
    """The points at the corners of the square, from (0, 0) counter-clockwise."""
    return [int(np.flatnonzero((map_ == corner).all(axis=1))[0])
            for corner in ([0, 0], [1, 0], [1, 1], [0, 1])]


def boundary(triangles):
    """The points of the boundary in order."""
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    count = triangles.max() + 1
    open_ = sides[~np.isin(sides[:, 0] * count + sides[:, 1], sides[:, 1] * count + sides[:, 0])]
    following = dict(open_.tolist())
    loop = [int(open_[0, 0])]
    while following[loop[-1]] != loop[0]:
        loop.append(following[loop[-1]])
    return np.array(loop)


def distortion(triangles, points, map_):
    """Of each triangle: its share of the area in the square by that of the surface, the quotient of
    the singular values of its map, and its share of the surface."""
    (a, b, c), (p, q, r) = (array[triangles].transpose(1, 0, 2) for array in (points, map_))
    first, second = b - a, c - a
    length = np.linalg.norm(first, axis=1)
    along = (first * second).sum(axis=1) / length
    across = np.linalg.norm(np.cross(first, second), axis=1) / length
    x = (q - p) / length[:, None]
    y = ((r - p) - x * along[:, None]) / across[:, None]
    area = (x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0]) * length * across / 2
    values = np.linalg.svd(np.stack([x, y], axis=-1), compute_uv=False)
    share = length * across / (length * across).sum()
    angle = np.minimum(values[:, 0] / np.maximum(values[:, 1], 1e-300), 1000)
    return area / area.sum() / share, angle, share


def laid_flat(mesh, map_):
    """The triangles of a mesh in the unit square."""
    plane = vtkPolyData()
    plane.DeepCopy(figures.polydata(map_))
    plane.SetPolys(mesh.GetPolys())
    return plane


def checkerboard(squares, pixels=32):
    """The picture of squares in two colours, a darker line around each."""
    row = np.arange(squares * pixels)
    odd = (row[:, None] // pixels + row // pixels) % 2
    picture = np.where(odd[..., None] == 1, (245, 245, 240), (60, 105, 165)).astype(np.uint8)
    return picture


def lit(mesh, pose, pixels, texture=None, lines=None):
    """The picture of a surface, in grey or with a texture by its active coordinates. `lines` are a
    mesh and its colour that are shown, too."""
    view = example.picture_view([pixels, pixels], [1, 1, 1])
    sources = [example.producer(mesh)]
    shown = simple.Show(sources[0], view, "GeometryRepresentation")
    example.paint(shown, [1, 1, 1])
    shown.Texture = texture
    shown.Ambient, shown.Diffuse = 0.25, 0.75
    if lines:
        sources.append(example.producer(lines[0]))
        example.paint(simple.Show(sources[1], view, "GeometryRepresentation"), lines[1])
    aim(view, mesh, pose)
    picture = figures.drawn(example.save_picture, view)
    for proxy in view, *sources:
        simple.Delete(proxy)
    return picture


def textured(mesh, name, squares, pose, pixels, lines=None):
    """The picture of a surface with a checkerboard laid on it by an array of texture coordinates."""
    shown = mesh.NewInstance()
    shown.ShallowCopy(mesh)
    shown.GetPointData().SetActiveTCoords(name)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "checkerboard.png")
        figures.save(path, checkerboard(squares))
        texture = simple.CreateTexture(path)
        texture.UpdateVTKObjects()  # ParaView 5.13 would show none
        return lit(shown, pose, pixels, texture, lines)


def aim(view, mesh, pose):
    """Looks at the middle of a surface, from a direction and with a direction up."""
    low, high = np.array(mesh.GetBounds()).reshape(3, 2).T
    middle, size = (low + high) / 2, np.linalg.norm(high - low)
    towards, up = (np.array(words, float) for words in pose)
    towards /= np.linalg.norm(towards)
    right = np.cross(up, towards)
    right /= np.linalg.norm(right)
    up = np.cross(towards, right)
    places = points(mesh) - middle
    half = max(np.abs(places @ right).max(), np.abs(places @ up).max())
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = middle.tolist()
    view.CameraPosition = (middle + 2 * size * towards).tolist()
    view.CameraViewUp = up.tolist()
    view.CameraParallelScale = 1.04 * half

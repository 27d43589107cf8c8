# SPDX-License-Identifier: BSD-3-Clause
"""Sample Surface and Area Preserving Parameterization on what ParaView's filters make: Clip and Slice through
points, meshes with points twice, unused or on one line. Particles are exactly as many, their mass is the area,
none is on a cell without area, and every cell of the input is in the output with its own figures."""
import itertools
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_QUAD, VTK_TRIANGLE_STRIP, vtkStructuredGrid
from vtkmodules.vtkFiltersSources import vtkTexturedSphereSource

from rt_testing import Listener, load_plugin, main, output_of, positions, producer, surface

simple = load_plugin()


def sheet(number=8):
    """The unit square, in triangles."""
    y, x = np.mgrid[0:number + 1, 0:number + 1] / number
    row = number + 1
    cells = [cell for j in range(number) for i in range(number) for cell in (
        (j * row + i, j * row + i + 1, j * row + i + row + 1),
        (j * row + i, j * row + i + row + 1, j * row + i + row))]
    return np.c_[x.ravel(), y.ravel(), 0 * x.ravel()], cells


def on_diagonals(kind, turn):
    """A sheet with a point on each diagonal, in a triangle without area."""
    points, cells = sheet()
    made, more = list(points), []
    for right, left in zip(cells[::2], cells[1::2]):
        middle = len(made)
        made.append(0.3 * points[right[0]] + 0.7 * points[right[2]])
        more += [right, (right[0], right[2], middle), (left[0], middle, left[2]),
                 (middle, left[1], left[2])]
    made = np.array(made)
    if turn:
        made = made @ np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0] + [1, 2, 3]
    return producer(simple, surface(made.astype(kind), more))


def apart(source, kind=None):
    """Triangles with points of their own, as STL has them."""
    source.UpdatePipeline()
    data = source.GetClientSideObject().GetOutputDataObject(0)
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    points = positions(data)[corners]
    return producer(simple, surface(points if kind is None else points.astype(kind),
                                    np.arange(len(corners)).reshape(-1, 3)))


def clip(source, normal=(1, 0, 0), **properties):
    made = simple.Clip(Input=source, **properties)
    made.ClipType.Normal = normal
    return made


def slice_of(source, normal, **properties):
    made = simple.Slice(Input=source, **properties)
    made.SliceType.Normal = normal
    return made


def slice_apart(source, normal):
    """A slice whose points are not merged; ParaView has changed the property's name."""
    made = slice_of(source, normal)
    if "PointMergeMethod" in made.ListProperties():
        made.PointMergeMethod = "NotMergingPoints"
    else:
        made.Mergeduplicatedpointsintheslice = 0
    return made


def moved(source, **properties):
    made = simple.Transform(Input=source)
    for name, value in properties.items():
        setattr(made.Transform, name, value)
    return made


def textured_sphere():
    source = vtkTexturedSphereSource()
    source.SetThetaResolution(16)
    source.SetPhiResolution(8)
    source.Update()
    data = source.GetOutput()
    data.GetPointData().GetNormals().SetName("Normals")  # ParaView needs names
    data.GetPointData().GetTCoords().SetName("Texture")
    return producer(simple, data)


def hill():
    grid = vtkStructuredGrid()
    grid.SetDimensions(9, 7, 1)
    grid.SetPoints(vtkPoints())
    for y in range(7):
        for x in range(9):
            grid.GetPoints().InsertNextPoint(x, y, np.sin(x / 2))
    return producer(simple, grid)


def with_more(points=(), cells=()):
    there, triangles = sheet()
    return producer(simple, surface(np.array(list(there) + list(points), float),
                                    triangles + list(cells)))


NORMALS = (1, 1, .2), (1, 1, 0), (1, 1, 1), (1, 2, 3), (0, 1, .5)

# By name: an input, and whether something of it is repaired.
INPUTS = {
    "Clip": (lambda: clip(simple.Sphere()), True),
    "Clip, Extract Surface": (lambda: simple.ExtractSurface(Input=clip(simple.Sphere())), True),
    "Clip, inverted": (lambda: clip(simple.Sphere(), Invert=0), True),
    "Clip, Clean": (lambda: simple.Clean(Input=simple.ExtractSurface(
        Input=clip(simple.Sphere()))), True),
    "Clip, Triangulate": (lambda: simple.Triangulate(Input=simple.ExtractSurface(
        Input=clip(simple.Sphere()))), True),
    "Clip, Clean, Triangulate": (lambda: simple.Triangulate(Input=simple.Clean(
        Input=simple.ExtractSurface(Input=clip(simple.Sphere())))), True),
    "Clip, moved": (lambda: moved(clip(simple.Sphere()), Rotate=[13, 27, 41],
                                  Translate=[100, 0, 20]), True),
    "Clip of quads": (lambda: clip(simple.Plane(XResolution=10, YResolution=10), (1, 1, 0)), True),
    "Clip of strips": (lambda: clip(simple.TriangleStrips(Input=simple.Sphere())), True),
    "Clip off the points": (lambda: clip(simple.Sphere(), (1, 2, 3)), False),
    "Clip of a box": (lambda: clip(simple.Box()), True),
    **{"Slice %g %g %g" % normal: (lambda n=normal: slice_of(simple.Wavelet(), n), True)
       for normal in NORMALS},
    "Slice of polygons": (lambda: slice_of(simple.Wavelet(), NORMALS[0], Triangulatetheslice=0), True),
    "Slice of tetrahedra, points apart": (lambda: slice_apart(
        simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-5, 5] * 3)), NORMALS[0]), True),
    "Slice, moved": (lambda: moved(slice_of(simple.Wavelet(), NORMALS[0]),
                                   Translate=[1e4, 2e4, 0]), True),
    "Disk to its centre": (lambda: simple.Disk(InnerRadius=0), True),
    "Textured sphere": (textured_sphere, True),
    "Triangles apart": (lambda: apart(simple.Sphere(EndPhi=90)), True),
    "Triangles apart, in double": (lambda: apart(simple.Sphere(EndPhi=90), np.float64), True),
    "Delaunay, points twice": (lambda: simple.Delaunay2D(Input=with_more(
        [(.3, .4, 0), (.3, .4, 0), (.7, .1, 0)])), True),
    "Loop Subdivision": (lambda: simple.LoopSubdivision(Input=simple.Sphere(EndPhi=90)), False),
    "Structured grid": (hill, False),
    "An unused point": (lambda: with_more([(5, 5, 5)]), True),
    "A point twice in a triangle": (lambda: with_more(cells=[(30, 30, 31)]), True),
    "A part without area": (lambda: with_more([(4, 4, 4), (5, 5, 5), (7, 7, 7)],
                                              [(81, 82, 83)]), True),
    "Points on sides": (lambda: on_diagonals(np.float64, False), True),
    "Points on sides, turned": (lambda: on_diagonals(np.float64, True), True),
    "Points near sides": (lambda: on_diagonals(np.float32, True), False),
    "A corner twice in a polygon": (lambda: producer(simple, surface(
        [(0., 0, 0), (1, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)],
        [(0, 1, 2, 3, 4), (2, 5, 6, 3)])), True),
    "A flat polygon": (lambda: producer(simple, surface(
        [(0., 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (.5, 0, 0), (.25, 0, 0)],
        [(5, 4, 1, 2, 3, 0), (0, 1, 4, 5)])), True),
}


def cell_areas(data):
    """Of plane convex cells."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    areas = np.zeros(data.GetNumberOfCells())
    for i in range(len(areas)):
        cell = data.GetCell(i)
        if cell.GetCellDimension() == 2:
            corners = points[[cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]]
            if cell.GetCellType() == VTK_TRIANGLE_STRIP:
                thirds = zip(corners, corners[1:], corners[2:])
            elif cell.GetCellType() == VTK_QUAD:  # need not be plane
                thirds = [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
            else:
                thirds = [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
            areas[i] = sum(np.linalg.norm(np.cross(b - a, c - a)) / 2 for a, b, c in thirds)
    return areas


METHODS = "Relaxation", "Flow"


class Surfaces(unittest.TestCase):
    def run_filter(self, name, source, repaired, **properties):
        made = getattr(simple, name)(Input=source, **properties)
        reported = Listener(made.GetClientSideObject())
        data = output_of(made)
        self.assertEqual(reported.errors, [])
        said = [text for text in reported.warnings if "The input surface was repaired: " in text]
        self.assertEqual(len(said), 1 if repaired else 0, reported.warnings)
        return data

    def test_particles(self):
        for (name, (make, repaired)), method in itertools.product(INPUTS.items(), METHODS):
            with self.subTest(name, method=method):
                source = make()
                areas = cell_areas(output_of(source))
                particles = self.run_filter(
                    "SampleSurface", source, repaired and method == "Flow", Method=method,
                    NumberOfParticles=1000, Resolution=128)
                self.assertEqual(particles.GetNumberOfPoints(), 1000)
                mass = particles.GetFieldData().GetArray("TotalMass").GetValue(0)
                # A quad that is not plane may be cut the other way.
                self.assertLess(abs(mass / areas.sum() - 1), 1e-2 if name == "Structured grid" else 1e-5)
                cells = vtk_to_numpy(particles.GetPointData().GetArray("CellId"))
                self.assertGreater(areas[cells].min(), 1e-9 * areas.max())
                normals = vtk_to_numpy(particles.GetPointData().GetArray("Normal"))
                np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, rtol=1e-9)

    def test_coordinates(self):
        for name, (make, repaired) in INPUTS.items():
            with self.subTest(name):
                source = make()
                given = output_of(source)
                mapped = self.run_filter("AreaPreservingParameterization", source, repaired,
                                         Resolution=64)
                np.testing.assert_array_equal(positions(mapped), positions(given))
                self.check_map(mapped)

    def check_map(self, mapped):
        places = vtk_to_numpy(mapped.GetPointData().GetArray("AreaPreservingExact"))
        self.assertTrue(np.isfinite(places).all() and places.min() >= 0 and places.max() <= 1)
        np.testing.assert_array_equal(
            vtk_to_numpy(mapped.GetPointData().GetTCoords()), places.astype(np.float32))
        areas = cell_areas(mapped)
        quotients = vtk_to_numpy(mapped.GetCellData().GetArray("AreaDistortion"))
        corners = np.array([[mapped.GetCell(i).GetPointId(k) for k in range(3)]
                            if areas[i] > 1e-9 * areas.max() else [0, 0, 0]
                            for i in range(len(areas))])
        a, b, c = (places[corners[:, i]] for i in range(3))
        inside = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
        has_area = areas > 1e-9 * areas.max()
        share = areas[has_area] / areas.sum()
        np.testing.assert_allclose(np.abs(inside[has_area]) / share, np.abs(quotients[has_area]),
                                   rtol=1e-5, atol=1e-6)
        flipped = vtk_to_numpy(mapped.GetCellData().GetArray("Flipped"))
        self.assertEqual(flipped.sum(), 0)
        rms = mapped.GetFieldData().GetArray("AreaDistortionRMS").GetValue(0)
        self.assertAlmostEqual(rms, np.sqrt((share * (quotients[has_area] - 1) ** 2).sum()), places=5)
        self.assertLess(rms, 0.2)

    def test_point_values(self):
        """Values of points at one place may differ: each triangle has its own."""
        source = apart(simple.Sphere(EndPhi=90))
        data = source.GetClientSideObject().GetOutputDataObject(0)
        values = np.repeat(np.arange(data.GetNumberOfCells(), dtype=float), 3)
        array = numpy_to_vtk(values, deep=1)
        array.SetName("Triangle")
        data.GetPointData().AddArray(array)
        for method in METHODS:
            particles = self.run_filter("SampleSurface", source, method == "Flow", Method=method,
                                        NumberOfParticles=500, Resolution=128,
                                        DensityArray=["POINTS", "Triangle"])
            np.testing.assert_allclose(
                vtk_to_numpy(particles.GetPointData().GetArray("Triangle")),
                vtk_to_numpy(particles.GetPointData().GetArray("CellId")), atol=1e-9)
            mass = particles.GetFieldData().GetArray("TotalMass").GetValue(0)
            right = (cell_areas(data) * values[::3]).sum()
            self.assertAlmostEqual(mass / right, 1, places=6)

    def test_any_shape(self):
        """Sources of the menu that are no disks, and what filters make of volumes."""
        volume = simple.Wavelet(WholeExtent=[-4, 4] * 3)
        for name, source in (
                ("sphere", simple.Sphere()), ("box", simple.Box()), ("cone", simple.Cone()),
                ("cylinder", simple.Cylinder()), ("disk with a hole", simple.Disk()),
                ("two", simple.AppendDatasets(Input=[simple.Sphere(), simple.Box()])),
                ("contour", simple.Contour(Input=volume, ContourBy=["POINTS", "RTData"],
                                           Isosurfaces=[150.0])),
                ("tetrahedra", simple.Tetrahedralize(Input=volume)),
                ("clipped", simple.Clip(Input=volume, ClipType="Sphere"))):
            with self.subTest(name):
                particles = self.run_filter("SampleSurface", source, False, NumberOfParticles=700)
                self.assertEqual(particles.GetNumberOfPoints(), 700)
                surface = output_of(simple.Triangulate(Input=simple.ExtractSurface(Input=source)))
                mass = particles.GetFieldData().GetArray("TotalMass").GetValue(0)
                self.assertAlmostEqual(mass / cell_areas(surface).sum(), 1, places=4)
                found, shape = (np.array(data.GetBounds()) for data in (particles, surface))
                size = np.abs(shape[1::2] - shape[::2]).max()
                self.assertTrue((found[::2] > shape[::2] - 1e-6 * size).all() and
                                (found[1::2] < shape[1::2] + 1e-6 * size).all())
                self.assertLess(np.abs(found - shape).max(), 0.2 * size)

    def test_count(self):
        source = with_more([(5, 5, 5), (6, 6, 6)], [(30, 30, 31)])
        made = simple.SampleSurface(Input=source, Method="Flow", Resolution=32, NumberOfParticles=10)
        reported = Listener(made.GetClientSideObject())
        output_of(made)
        self.assertIn("The input surface was repaired: 2 points in no polygon left out, 1 triangle "
                      "without area left out", reported.warnings[0])

    def test_corners(self):
        """Ids are those of the input."""
        source = with_more([(5, 5, 5)], [(0, 0, 1)])
        made = simple.AreaPreservingParameterization(Input=source, Resolution=32,
                                                     Corners=[8, 80, 72, 0])
        places = vtk_to_numpy(output_of(made).GetPointData().GetArray("AreaPreservingExact"))
        np.testing.assert_array_equal(places[[8, 80, 72, 0]], [[0, 0], [1, 0], [1, 1], [0, 1]])
        np.testing.assert_array_equal(places[81], [0, 0])
        for corners, message in (([8, 80, 72, 81], "Corners have the point 81, which is in no triangle "
                                  "with area"), ([8, 80, 72, 99], "there are points 0 to 81"),
                                 ([8, 80, 72, 40], "the point 40, which is not on the boundary")):
            made.Corners = corners
            reported = Listener(made.GetClientSideObject())
            output_of(made)
            self.assertIn(message, reported.errors[0])


if __name__ == "__main__":
    main()

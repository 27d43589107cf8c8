# SPDX-License-Identifier: BSD-3-Clause
"""Area Preserving Parameterization of surfaces that are no disks: closed, with holes or handles, with one side, in
several components. Areas are kept as on disks, no triangle is turned over, points on seams are copies, and
components have squares of their own. Disks are as they are without Seams, to the bit."""
import os
import time
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricMobius, vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import (vtkCubeSource, vtkParametricFunctionSource, vtkPlaneSource, vtkSphereSource,
                                          vtkSuperquadricSource)
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from rt_testing import SOURCE, Listener, load_plugin, main, positions, producer

simple = load_plugin()


def made(source, **settings):
    for name, value in settings.items():
        getattr(source, "Set" + name)(value)
    source.Update()
    return source.GetOutput()


def sphere(number=40, **settings):
    return made(vtkSphereSource(), ThetaResolution=number, PhiResolution=number, **settings)


def parametric(function, u, v):
    return made(vtkParametricFunctionSource(), ParametricFunction=function, UResolution=u, VResolution=v,
                GenerateNormals=0, GenerateTextureCoordinates=0)


def spot():
    return made(vtkXMLPolyDataReader(), FileName=os.path.join(SOURCE, "Testing", "Data", "spot.vtp"))


def several():
    append = vtkAppendPolyData()
    plane = made(vtkPlaneSource(), XResolution=12, YResolution=12, Center=(5, 0, 0))
    triangle = made(vtkPlaneSource(), Center=(8, 0, 0))
    triangle.GetPolys().Reset()
    triangle.GetPolys().InsertNextCell(3, [0, 1, 2])
    for part in (sphere(24), plane, triangle, sphere(16, Center=(-3, 0, 0), StartPhi=40, EndPhi=130)):
        append.AddInputData(part)
    return made(append)


def mapped(data, **settings):
    """Both outputs, and the figures in the field data."""
    made_ = simple.AreaPreservingParameterization(producer(simple, data), Resolution=256, **settings)
    reported = Listener(made_.GetClientSideObject())
    made_.UpdatePipeline()
    outputs = [vtkPolyData() for _ in range(2)]
    for port, output in enumerate(outputs):
        output.ShallowCopy(made_.GetClientSideObject().GetOutputDataObject(port))
    return outputs, reported


def point_array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def cell_array(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))


def corners(data):
    return vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def of_triangles(places, triangles):
    data = vtkPolyData()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for place in places:
        points.InsertNextPoint(*place)
    data.SetPoints(points)
    data.SetPolys(vtkCellArray())
    for triangle in triangles:
        data.GetPolys().InsertNextCell(3, [int(point) for point in triangle])
    return data


def projective_plane():
    """Six points, each two of which an edge joins, in ten triangles: divided three times."""
    subdivide = vtkLinearSubdivisionFilter()
    subdivide.SetNumberOfSubdivisions(3)
    subdivide.SetInputData(of_triangles(
        np.random.default_rng(3).standard_normal((6, 3)),
        [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 1), (1, 2, 4), (2, 3, 5), (3, 4, 1), (4, 5, 2),
         (5, 1, 3)]))
    return made(subdivide)


def sheet(n, holes=0):
    """A wavy sheet of n x n squares, with holes x holes square holes of a third of their distance."""
    v, u = np.mgrid[0:n + 1, 0:n + 1] / n
    places = np.c_[u.ravel(), v.ravel(), 0.2 * (np.sin(5 * u) * np.cos(4 * v)).ravel()]
    j, i = np.mgrid[0:n, 0:n]
    each = n // holes if holes else 1
    hole = (i % each * 3 // each == 1) & (j % each * 3 // each == 1) if holes else np.zeros((n, n), bool)
    a = (j * (n + 1) + i)[~hole]
    triangles = np.concatenate([np.c_[a, a + 1, a + n + 2], np.c_[a, a + n + 2, a + n + 1]])
    used = np.unique(triangles)
    return places[used], np.searchsorted(used, triangles)


SURFACES = {
    "sphere": sphere,
    "torus": lambda: parametric(vtkParametricTorus(), 48, 24),
    "tube": lambda: sphere(30, StartPhi=30, EndPhi=150),
    "Moebius band": lambda: parametric(vtkParametricMobius(), 60, 8),
    "projective plane": projective_plane,
    "sheet with 25 holes": lambda: of_triangles(*sheet(45, 5)),
    "spot": spot,
    "superquadric with its seam": lambda: made(vtkSuperquadricSource(), PhiResolution=32, ThetaResolution=32),
    "several": several,
}


class Seams(unittest.TestCase):
    def check_cut(self, data, surface, flat):
        """The output is the input, with copies of points at their places; its figures are those of its arrays."""
        origins = point_array(surface, "PointIds")
        given = data.GetNumberOfPoints()
        np.testing.assert_array_equal(origins[:given], np.arange(given))
        self.assertEqual(origins.size, surface.GetNumberOfPoints())
        np.testing.assert_array_equal(positions(surface), positions(data)[origins])
        triangles = corners(surface)
        if data.GetPolys().GetMaxCellSize() == 3 and data.GetNumberOfStrips() == 0:
            np.testing.assert_array_equal(origins[triangles], corners(data))
        component = cell_array(surface, "Component")
        self.assertEqual(component.size, surface.GetNumberOfCells())
        flat_cells = areas(positions(surface).astype(float), triangles) < 1e-9
        np.testing.assert_array_equal(component == -1, flat_cells)

        exact = point_array(surface, "AreaPreservingExact")
        np.testing.assert_array_equal(positions(flat)[:, :2], exact)
        self.assertGreaterEqual(exact.min(), 0)
        self.assertLessEqual(exact.max(), 1)
        u, v = exact[triangles[:, 1]] - exact[triangles[:, 0]], exact[triangles[:, 2]] - exact[triangles[:, 0]]
        squares = 0.5 * np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
        share = areas(positions(surface).astype(float), triangles)
        share /= share.sum()
        # Components turned over as wholes have the orientation of most of their area.
        np.testing.assert_allclose(np.abs(cell_array(surface, "AreaDistortion")) * share,
                                   squares / squares.sum(), atol=1e-9)
        deviation = np.abs(cell_array(surface, "AreaDistortion") - 1)
        order = np.argsort(deviation)
        sums = np.cumsum(share[order])
        self.assertLess(deviation[order][np.searchsorted(sums, 0.5)], 0.01)
        self.assertLess(deviation[order][np.searchsorted(sums, 0.95)], 0.05)
        self.assertEqual(cell_array(surface, "Flipped").max(), 0)
        self.assertEqual(surface.GetFieldData().GetArray("FlippedCount").GetValue(0), 0)
        return component, exact, triangles

    def test_surfaces(self):
        for name, make in SURFACES.items():
            with self.subTest(surface=name):
                data = make()
                (surface, flat), reported = mapped(data)
                self.assertEqual(reported.errors, [])
                component, _, _ = self.check_cut(data, surface, flat)
                self.assertEqual(set(component) - {-1}, set(range(4 if name == "several" else 1)))
                self.assertLess(surface.GetFieldData().GetArray("AngleDistortionMean").GetValue(0), 20)

    def test_atlas(self):
        """Squares in proportion to the components' areas, and apart."""
        data = several()
        (surface, flat), _ = mapped(data)
        component, exact, triangles = self.check_cut(data, surface, flat)
        boxes = [(exact[triangles[component == i]].reshape(-1, 2).min(axis=0),
                  exact[triangles[component == i]].reshape(-1, 2).max(axis=0)) for i in range(4)]
        for i in range(4):
            for j in range(i):
                apart = np.maximum(boxes[i][0] - boxes[j][1], boxes[j][0] - boxes[i][1]).max()
                self.assertGreater(apart, 1 / 129)
        # A triangle alone is half of its square.
        given = areas(positions(surface).astype(float), triangles)
        squares = [np.prod(high - low) * (0.5 if (component == i).sum() == 1 else 1)
                   for i, (low, high) in enumerate(boxes)]
        shares = np.array([given[component == i].sum() for i in range(4)])
        np.testing.assert_allclose(squares / np.sum(squares), shares / shares.sum(), rtol=1e-6)

    def test_disks_have_no_seams(self):
        for data in sphere(20, EndPhi=90), made(vtkPlaneSource(), XResolution=7, YResolution=5):
            (auto, _), _ = mapped(data)
            (none, _), _ = mapped(data, Seams="None")
            self.assertEqual(auto.GetPointData().GetNumberOfArrays(), none.GetPointData().GetNumberOfArrays())
            self.assertIsNone(auto.GetPointData().GetArray("PointIds"))
            self.assertIsNone(auto.GetCellData().GetArray("Component"))
            np.testing.assert_array_equal(point_array(auto, "AreaPreservingExact"),
                                          point_array(none, "AreaPreservingExact"))

    def test_points_that_are_left_out_and_merged(self):
        """A box of polygons whose sides have points of their own, and a point in none of them."""
        box = made(vtkCubeSource())
        box.GetPoints().InsertNextPoint(7, 7, 7)
        for name in "Normals", "TCoords":
            box.GetPointData().RemoveArray(name)
        made_ = simple.AreaPreservingParameterization(producer(simple, box), Resolution=32)
        reported = Listener(made_.GetClientSideObject())
        made_.UpdatePipeline()
        output = made_.GetClientSideObject().GetOutputDataObject(0)
        self.assertEqual(reported.errors, [])
        self.assertIn("1 point in no polygon left out, 16 points merged with others", reported.warnings[0])
        np.testing.assert_array_equal(point_array(output, "AreaPreservingExact")[24], [0, 0])
        self.assertEqual(output.GetNumberOfCells(), 12)
        self.assertEqual(cell_array(output, "Component").max(), 0)

    def test_two_hundred_holes(self):
        """A triangle takes at most three times as long as one of a sheet with none, and few are flipped."""
        seconds = []
        for count in (0, 14):
            places, triangles = sheet(84, count)
            begin = time.process_time()
            (surface, _), reported = mapped(of_triangles(places, triangles))
            seconds.append((time.process_time() - begin) / len(triangles))
            self.assertEqual((reported.errors, reported.warnings), ([], []))
            self.assertLessEqual(cell_array(surface, "Flipped").sum(), 0.01 * len(triangles))
            self.assertLess(surface.GetFieldData().GetArray("AreaDistortionRMS").GetValue(0), 0.05)
        self.assertLess(seconds[1], 5 * seconds[0])  # 2 on an idle machine, 30 and more along seams

    def test_repeated_triangles(self):
        """A triangle that is there twice counts once, in either direction, with points of its own or not."""
        places, triangles = sheet(10)
        alone, _ = mapped(of_triangles(places, triangles))
        own = len(places) + np.arange(3)
        for repeated, more in ((triangles[77], 0), (triangles[77][::-1], 0), (triangles[0][[1, 2, 0]], 0),
                               (own, 3)):
            data = of_triangles(np.concatenate([places, places[triangles[77]][:more]]),
                                np.concatenate([triangles, [repeated]]))
            for seams in "Auto", "None":
                with self.subTest(repeated=repeated, seams=seams):
                    (surface, _), reported = mapped(data, Seams=seams)
                    self.assertEqual(reported.errors, [])
                    self.assertIn("1 repeated triangle left out", reported.warnings[0])
                    np.testing.assert_array_equal(point_array(surface, "AreaPreservingExact")[:len(places)],
                                                  point_array(alone[0], "AreaPreservingExact"))
                    first = 0 if repeated[0] == triangles[0][1] else 77
                    for name in "AreaDistortion", "AngleDistortion", "Flipped":
                        values = cell_array(surface, name)
                        np.testing.assert_array_equal(values[:-1], cell_array(alone[0], name))
                        self.assertEqual(values[-1], values[first])
            for method in "Relaxation", "Flow":
                sampled = simple.SampleSurface(producer(simple, data), NumberOfParticles=200, Method=method)
                sampled.UpdatePipeline()
                output = sampled.GetClientSideObject().GetOutput()
                self.assertAlmostEqual(output.GetFieldData().GetArray("TotalMass").GetValue(0),
                                       areas(places, triangles).sum(), 12)
                self.assertLess(vtk_to_numpy(output.GetPointData().GetArray("CellId")).max(), len(triangles))

    def test_sheets_part(self):
        """Two spheres, and a triangle at an edge of each."""
        append = vtkAppendPolyData()
        ball = sphere(12)
        fin = vtkPolyData()
        fin.DeepCopy(ball)
        edge = corners(ball)[40][:2]
        tip = fin.GetPoints().InsertNextPoint(2, 2, 2)
        fin.GetPointData().Initialize()
        fin.GetPolys().InsertNextCell(3, [int(edge[0]), int(edge[1]), tip])
        append.AddInputData(fin)
        (surface, _), reported = mapped(made(append))
        self.assertEqual(reported.errors, [])
        self.assertIn("1 edge of more than two triangles parted", reported.warnings[0])
        self.assertGreaterEqual(cell_array(surface, "Component").max(), 1)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Solids that others bring: thin parts, edges of four triangles, seams of rounding, open surfaces; and that
what the error advises closes them."""
import os
import unittest

import numpy as np
from rt_testing import SOURCE, Listener, load_plugin, main, output_of, positions, producer, surface
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonComputationalGeometry import (vtkParametricEllipsoid, vtkParametricKlein,
                                                       vtkParametricSuperToroid, vtkParametricTorus)
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkParametricFunctionSource, vtkTexturedSphereSource

simple = load_plugin()


def box(*bounds):
    source = vtkCubeSource()
    source.SetBounds(*bounds)
    source.SetOutputPointsPrecision(1)
    source.Update()
    return source.GetOutput()


def together(*surfaces):
    append = vtkAppendPolyData()
    append.SetOutputPointsPrecision(1)
    for surface in surfaces:
        append.AddInputData(surface)
    append.Update()
    return append.GetOutput()


def parametric(function, count=50):
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(function)
    source.SetUResolution(count)
    source.SetVResolution(count)
    source.Update()
    return source.GetOutput()


def voxels(labels):
    """An image with these values on its cells."""
    image = vtkImageData()
    image.SetDimensions(*(n + 1 for n in labels.shape[::-1]))
    array = numpy_to_vtk(np.ascontiguousarray(labels.astype(np.uint8)).ravel(), deep=1)
    array.SetName("Label")
    image.GetCellData().SetScalars(array)
    return producer(simple, image)


def solid_volume(source, **properties):
    solid = simple.SolidDensity(Input=source, **properties)
    image = output_of(solid)
    values = vtk_to_numpy(image.GetPointData().GetArray("Density"))
    assert values.min() >= 0 and values.max() <= 1
    return values.sum() * np.prod(image.GetSpacing())


def by_triangles(source):
    """The volume by vtkMassProperties, which takes triangles as they are."""
    source.UpdatePipeline()
    triangles = vtkTriangleFilter()
    triangles.SetInputData(source.GetClientSideObject().GetOutputDataObject(0))
    mass = vtkMassProperties()
    mass.SetInputConnection(triangles.GetOutputPort())
    mass.Update()
    return mass.GetVolume()


class Solids(unittest.TestCase):
    def check(self, source, right, relative=1e-9, **properties):
        self.assertLess(abs(solid_volume(source, **properties) / right - 1), relative)

    def test_beams_plates_and_rods(self):
        """The sides are exact in float."""
        for sides in ((10, 1, 1), (1, 10, 1), (10, 3, .5), (7, 1, 1.25), (1, 1, 1), (8, 8, 2**-10),
                      (8, 2**-10, 8), (2**-10, 8, 8), (8, 2**-12, 2**-11), (2**-12, 8, 2**-11),
                      (2**-12, 2**-11, 8)):
            for options in ({}, dict(Resolution=1, Padding=0), dict(Supersampling=1, Resolution=7)):
                source = simple.Box(XLength=sides[0], YLength=sides[1], ZLength=sides[2])
                self.check(source, np.prod(sides), **options)
        for thin in (1e-3, 1e-6, 1e-8):
            for axis in range(3):
                high = [1.0, 1.0, 1.0]
                high[axis] = thin
                self.check(producer(simple, box(0, high[0], 0, high[1], 0, high[2])), thin, 1e-7)

    def test_profiles_of_beams(self):
        flange, web = box(0, 10, 0, 10, 1, 1.02), box(0, 10, 4.99, 5.01, -5, 1)
        self.check(producer(simple, together(flange, web)), 2 + 10 * .02 * 6)
        profile = [(0, 0), (10, 0), (10, .02), (5.01, .02), (5.01, 6), (4.99, 6), (4.99, .02), (0, .02)]
        outline = surface(np.c_[profile, np.zeros(len(profile))], [range(len(profile))])
        beam = simple.LinearExtrusion(Input=producer(simple, outline), Vector=[0, 0, 1], ScaleFactor=20)
        self.check(beam, 20 * (10 * .02 + .02 * 5.98), 1e-5)
        # Overlapping ones are sampled where they overlap.
        self.check(producer(simple, together(box(0, 1, 0, 10, 0, 5), box(0, 5, 0, 10, 0, 1))), 90, .01)

    def test_voxels_that_touch(self):
        for seed in range(5):
            random = np.random.default_rng(seed)
            labels = random.random((6, 5, 7)) < .2 + .15 * seed
            parts = simple.Threshold(Input=voxels(labels), Scalars=["CELLS", "Label"],
                                     LowerThreshold=1, UpperThreshold=1)
            self.check(simple.ExtractSurface(Input=parts), labels.sum(), 1e-12)

    def test_two_labels_that_share_faces(self):
        labels = np.random.default_rng(8).integers(0, 3, (5, 5, 5))
        surfaces = [simple.ExtractSurface(Input=simple.Threshold(
            Input=voxels(labels), Scalars=["CELLS", "Label"], LowerThreshold=label, UpperThreshold=label))
            for label in (1, 2)]
        self.check(simple.AppendGeometry(Input=surfaces), (labels > 0).sum(), 1e-12)

    def test_contours_at_values_of_the_data(self):
        for seed in range(4):
            values = np.pad(np.random.default_rng(seed).integers(0, 4, (7, 7, 7)), 1)
            image = vtkImageData()
            image.SetDimensions(*values.shape)
            array = numpy_to_vtk(values.astype(float).ravel(), deep=1)
            array.SetName("Value")
            image.GetPointData().SetScalars(array)
            contour = simple.Contour(Input=producer(simple, image), ContourBy=["POINTS", "Value"],
                                     Isosurfaces=[1 + seed % 3])
            self.check(contour, by_triangles(contour), 1e-5)

    def test_seams(self):
        torus, ellipsoid = vtkParametricTorus(), vtkParametricEllipsoid()
        self.check(producer(simple, parametric(torus, 200)), .5 * np.pi**2, 1e-3)
        self.check(producer(simple, parametric(ellipsoid, 200)), 4 / 3 * np.pi, 1e-3)
        textured = vtkTexturedSphereSource()
        textured.SetThetaResolution(40)
        textured.SetPhiResolution(30)
        textured.Update()
        surfaces = [producer(simple, data) for data in (
            parametric(torus), parametric(ellipsoid), parametric(vtkParametricSuperToroid()), textured.GetOutput())]
        for source in surfaces:
            self.check(source, by_triangles(source), 1e-5)
            # Turned in float, both ends of the seam are rounded anew.
            turned = simple.Transform(Input=source)
            turned.Transform.Rotate = [31, 47, 12]
            self.check(turned, by_triangles(source), 1e-5)
            turned.Transform.Translate = [100, -50, 20]
            self.check(turned, by_triangles(source), 1e-4)

    def test_extrusions(self):
        plane = simple.Plane(Origin=[1, 0, 0], Point1=[2, 0, 0], Point2=[1, 0, 1])
        for angle in (90, 360):
            ring = simple.RotationalExtrusion(Input=plane, Resolution=100, Angle=angle)
            self.check(ring, 3 * np.pi * angle / 360, 1e-2)
        self.check(simple.LinearExtrusion(Input=simple.a3DText(Text="8g&"), Vector=[0, 0, 1]),
                   by_triangles(simple.LinearExtrusion(Input=simple.a3DText(Text="8g&"), Vector=[0, 0, 1])), 1e-5)

    def message(self, source):
        solid = simple.SolidDensity(Input=source)
        reported = Listener(solid.GetClientSideObject())
        self.assertEqual(output_of(solid).GetNumberOfPoints(), 0)
        return reported.errors[0].strip().splitlines()[-1]

    def test_open_scans(self):
        """A cow with five holes is as large as the whole one; a closed one is the same with both."""
        whole = simple.XMLPolyDataReader(FileName=[os.path.join(SOURCE, "Testing", "Data", "spot.vtp")])
        right = solid_volume(whole)
        self.assertEqual(solid_volume(whole, OpenSurfaces="WindingNumber"), right)
        scan = whole
        low, high = np.reshape(whole.GetDataInformation().GetBounds(), (3, 2)).T
        for side in np.array([[.5, 0, .5], [.5, 1, .4], [0, .5, .5], [1, .5, .5], [.5, .5, 1]]):
            scan.UpdatePipeline()
            points = positions(scan.GetClientSideObject().GetOutputDataObject(0))
            place = points[np.linalg.norm(points - low - side * (high - low), axis=1).argmin()]
            hole = dict(ClipType="Sphere", Invert=0, Crinkleclip=1)
            clip = simple.Clip(scan, **hole)
            clip.ClipType.Center = list(place)
            clip.ClipType.Radius = .08 * (high - low).max()
            scan = simple.ExtractSurface(clip)
        self.assertIn("OpenSurfaces WindingNumber takes this surface with its holes. The input", self.message(scan))
        self.assertLess(abs(solid_volume(scan, OpenSurfaces="WindingNumber") / right - 1), .01)

    def test_klein_bottle(self):
        """Its seam gapes by more than rounding."""
        self.assertIn("one side only", self.message(producer(simple, parametric(vtkParametricKlein()))))

    def test_what_the_error_advises(self):
        """Word by word: each closes the surface."""
        ball = simple.Sphere(ThetaResolution=30, PhiResolution=30)
        half = simple.ExtractSurface(Input=simple.Clip(Input=ball, ClipType="Plane"))
        message = self.message(half)
        self.assertIn("112 open edges", message)
        right = .5 * by_triangles(ball)
        self.assertIn("Clip Closed Surface in place of Clip", message)
        self.check(simple.ClipClosedSurface(Input=ball), right, 1e-5)
        self.assertIn("or with a plane that cuts off the rim of the hole", message)
        capped = simple.ClipClosedSurface(Input=simple.Sphere(
            ThetaResolution=30, PhiResolution=30, StartPhi=20))
        capped.ClippingPlane.Origin, capped.ClippingPlane.Normal = [0, 0, 0.45], [0, 0, -1]
        self.check(capped, 2 * right, 0.03)
        self.assertIn("Delaunay 3D and Extract Surface for the convex hull", message)
        self.check(simple.ExtractSurface(Input=simple.Delaunay3D(Input=half)), right, 1e-3)
        self.assertIn("vtkFillHolesFilter in a Programmable Filter", message)
        # The script of the page.
        with open(os.path.join(SOURCE, "Documentation", "SolidDensity.md"), encoding="utf-8") as page:
            script = page.read().split('Script="""')[1].split('"""')[0]
        self.check(simple.ProgrammableFilter(Input=half, Script=script), right, 1e-5)
        self.assertIn("Capping of sources and extrusions", message)
        self.assertIn("open edges", self.message(simple.Cylinder(Capping=0)))
        self.check(simple.Cylinder(Capping=1), by_triangles(simple.Cylinder()), 1e-6)
        self.assertIn("open edges", self.message(simple.Plane()))
        self.check(simple.LinearExtrusion(Input=simple.Plane(), Vector=[0, 0, 1], Capping=1), 1, 1e-6)
        self.assertIn("Clean with a Tolerance where seams gape", message)
        soup = self.soup(1e-5)
        self.assertIn("open edges", self.message(soup))
        self.check(simple.Clean(Input=soup, Tolerance=1e-3), by_triangles(ball), 1e-3)
        self.assertIn("after Subdivide if one of their sides has fewer points", message)
        gaping = self.gaping_prism(0.05)
        self.assertIn("open edges", self.message(gaping))
        self.assertIn("open edges", self.message(simple.Clean(Input=gaping, Tolerance=0.02)))
        self.check(simple.Clean(Input=simple.Subdivide(Input=gaping, NumberofSubdivisions=1), Tolerance=0.02),
                   3, 0.05)

    @staticmethod
    def gaping_prism(gap):
        """Over three squares in an L; at the top, edges are half as long, and their own points higher."""
        corners, faces = [], []

        def add(number, place):
            grid = np.linspace(0, 1, number + 1)
            first = len(corners)
            corners.extend(place(u, v) for v in grid for u in grid)
            for j in range(number):
                for i in range(number):
                    a = first + j * (number + 1) + i
                    faces.extend([(a, a + 1, a + number + 2), (a, a + number + 2, a + number + 1)])

        def top(x, y):
            is_own = (4 * x) % 1 + (4 * y) % 1 > 0
            is_rim = x in (0, 2) or y in (0, 2) or (x == 1 <= y) or (y == 1 <= x)
            return x, y, 1 + gap * (is_own and is_rim)

        for x, y in ((0, 0), (1, 0), (0, 1)):
            add(4, lambda u, v, x=x, y=y: (x + u, y + v, 0))
            add(8, lambda u, v, x=x, y=y: top(x + u, y + v))
        rim = np.array([(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 1), (0, 0)])
        for a, b in zip(rim, rim[1:]):
            add(4, lambda u, v, a=a, b=b: (*(a + u * (b - a)), v))
        return producer(simple, surface(np.array(corners, float), faces))

    @staticmethod
    def soup(gap):
        """A sphere of triangles that do not quite meet."""
        ball = output_of(simple.Sphere(ThetaResolution=30, PhiResolution=30))
        random = np.random.default_rng(1)
        corners = positions(ball)[vtk_to_numpy(ball.GetPolys().GetConnectivityArray())]
        return producer(simple, surface((corners + random.uniform(-gap, gap, corners.shape)).astype(np.float32),
                                        np.arange(len(corners)).reshape(-1, 3)))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""A closed surface as a density: what it encloses, whatever arrays it has. Particles are inside, evenly."""
import os
import tempfile
import unittest

import numpy as np
from rt_filters import with_property
from rt_testing import Listener, load_plugin, main, output_of, positions, producer, surface
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkSelectEnclosedPoints
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter

simple = load_plugin()


def ball(x=0.0, radius=1.0, points=40):
    source = vtkSphereSource()
    source.SetCenter(x, 0, 0)
    source.SetRadius(radius)
    source.SetThetaResolution(points)
    source.SetPhiResolution(points // 2)
    source.Update()
    return source.GetOutput()


def dumbbell():
    """A ball and one of an eighth of its volume."""
    append = vtkAppendPolyData()
    for data in (ball(), ball(2.0, 0.5)):
        append.AddInputData(data)
    append.Update()
    return append.GetOutput()


def opened(data):
    """Without its first polygon."""
    data.BuildCells()
    data.DeleteCell(0)
    data.RemoveDeletedCells()
    return data


def volume_of(data):
    triangles = vtkTriangleFilter()
    triangles.SetInputData(data)
    measure = vtkMassProperties()
    measure.SetInputConnection(triangles.GetOutputPort())
    return measure.GetVolume()


def outside(particles, data):
    """How many particles VTK has outside."""
    enclosed = vtkSelectEnclosedPoints()
    points = vtkPolyData()
    points.SetPoints(vtkPoints())
    points.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(particles), deep=1))
    enclosed.SetInputData(points)
    enclosed.SetSurfaceData(data)
    enclosed.SetTolerance(1e-9)
    enclosed.Update()
    return sum(enclosed.IsInside(i) == 0 for i in range(len(particles)))


def sampled(data, **properties):
    proxy = simple.SampleDensity(data if hasattr(data, "SMProxy") else producer(simple, data),
                                 **{"NumberOfParticles": 3000, "DensityResolution": 48, **properties})
    reported = Listener(proxy.GetClientSideObject())
    output = output_of(proxy)
    return output, reported


class ClosedSurfaces(unittest.TestCase):
    def test_particles_fill_the_solid(self):
        data = dumbbell()
        particles, reported = sampled(data)
        self.assertEqual(reported.errors + reported.warnings, [])
        places = positions(particles)
        self.assertEqual(len(places), 3000)
        self.assertEqual(outside(places, data), 0)
        self.assertAlmostEqual(np.mean(places[:, 0] > 1.25), 1 / 9, delta=0.004)
        fields = particles.GetFieldData()
        self.assertAlmostEqual(fields.GetArray("TotalMass").GetValue(0) / volume_of(data), 1, 9)
        # Halves along each axis, and shells of equal volume, have equal parts.
        large = places[places[:, 0] < 1.25]
        for axis in range(3):
            self.assertAlmostEqual(np.mean(large[:, axis] > 0), 0.5, delta=0.01)
        self.assertAlmostEqual(np.mean(np.linalg.norm(large, axis=1) < 0.5 ** (1 / 3)), 0.5, delta=0.02)

    def test_coarse_cells(self):
        """Most cells are covered in part, and still no particle is outside."""
        data = dumbbell()
        particles, _ = sampled(data, DensityResolution=6)
        self.assertEqual(outside(positions(particles), data), 0)

    def test_no_array_is_read(self):
        """Colours, normals, short arrays and a chosen name change nothing."""
        plain, _ = sampled(surface_alone(ball()))
        data = ball()
        colours = numpy_to_vtk(np.random.default_rng(1).integers(
            0, 255, (data.GetNumberOfPoints(), 3)).astype(np.uint8), deep=1)
        colours.SetName("RGB")
        data.GetPointData().SetScalars(colours)
        short = numpy_to_vtk(np.ones(7), deep=1)
        short.SetName("Short")
        data.GetCellData().AddArray(short)
        for array in (["POINTS", "RGB"], ["POINTS", "Normals"], ["POINTS", "None"]):
            with self.subTest(array):
                particles, reported = sampled(data, DensityArray=array)
                self.assertEqual(reported.errors, [])
                np.testing.assert_array_equal(positions(particles), positions(plain))
                arrays = particles.GetPointData()
                self.assertEqual({arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())},
                                 {"SeedId", "SeedPosition", "Displacement", "Mass"})
                self.assertEqual(
                    particles.GetFieldData().GetAbstractArray("DensityArrayName").GetValue(0), "")

    def test_files(self):
        """Of a reader, in the order of its menu: a file without arrays, and one with colours."""
        with tempfile.TemporaryDirectory() as folder:
            for writer, ending, reader in ((vtkSTLWriter(), "stl", simple.STLReader),
                                           (vtkPLYWriter(), "ply", simple.PLYReader)):
                with self.subTest(ending):
                    path = os.path.join(folder, "ball." + ending)
                    writer.SetFileName(path)
                    writer.SetInputData(ball())
                    writer.Write()
                    source = reader(FileNames=[path])
                    source.UpdatePipeline()
                    proxy = simple.SampleDensity(source, NumberOfParticles=500, DensityResolution=32)
                    # What the window asks before it offers the filter, and shows DensityArray.
                    self.assertTrue(proxy.SMProxy.GetProperty("Input").IsInDomains())
                    self.assertEqual(around_solid(proxy), 1)
                    places = positions(output_of(proxy))
                    self.assertEqual(len(places), 500)
                    self.assertEqual(outside(places, ball()), 0)

    def test_where_an_array_is_shown(self):
        for data, expected in ((simple.Sphere(), 1), (simple.Plane(), 0),
                               (simple.Slice(simple.Wavelet(), SliceType="Plane"), 0),
                               (simple.Plane(Point1=[0.4, 0.1, 0.2], Point2=[-0.5, 0.7, 0.9]), 0),
                               (simple.Wavelet(), 0), (simple.PointSource(), 0)):
            data.UpdatePipeline()
            for filter_ in with_property("DensityArray"):
                if list(filter_.inputs.values())[0] not in ("density", "densities"):
                    continue
                with self.subTest(filter_.label, data=data):
                    given = {name: data for name in filter_.inputs if name != "Input"}
                    proxy = getattr(simple, filter_.name)(data, **given)
                    self.assertEqual(around_solid(proxy), expected)

    def test_open_surfaces(self):
        _, reported = sampled(opened(ball()))
        self.assertEqual(len(reported.errors), 1)
        for part in ("3 open edges", "Sample Surface puts particles on",
                     "Solid Density with OpenSurfaces WindingNumber"):
            self.assertIn(part, reported.errors[0])
        # As it says:
        density = simple.SolidDensity(producer(simple, opened(ball())), OpenSurfaces="WindingNumber")
        particles = positions(output_of(simple.SampleDensity(density, NumberOfParticles=500)))
        self.assertLess(np.linalg.norm(particles, axis=1).max(), 1.05)

    def test_blocks_are_one_solid(self):
        """Those of a file of parts."""
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, ball())
        blocks.SetBlock(2, ball(2.0, 0.5))
        apart, _ = sampled(blocks)
        together, _ = sampled(dumbbell())
        np.testing.assert_array_equal(positions(apart), positions(together))

    def test_other_surfaces(self):
        """Curved ones of another type have no inside that is read; flat ones are densities as before."""
        _, reported = sampled(output_of(simple.AppendDatasets(Input=[producer(simple, ball())])))
        self.assertIn("lie in no plane", reported.errors[0])
        self.assertIn("Extract Surface", reported.errors[0])
        plane = simple.Elevation(simple.Plane(XResolution=9, YResolution=9))
        flat, reported = sampled(plane, DensityArray=["POINTS", "Elevation"])
        self.assertEqual(reported.errors, [])
        self.assertEqual(np.ptp(positions(flat)[:, 2]), 0)

    def test_odd_points(self):
        """Those of no polygon make a flat surface no solid; those of a solid must be finite."""
        data = output_of(simple.Elevation(simple.Plane(XResolution=9, YResolution=9)))
        expected, _ = sampled(data, DensityArray=["POINTS", "Elevation"])
        odd = vtkPolyData()
        odd.DeepCopy(data)
        odd.GetPoints().InsertNextPoint(0, 0, 5)
        odd.GetPointData().GetArray("Elevation").InsertNextValue(1)
        for name in ("Normals", "TextureCoordinates"):
            odd.GetPointData().RemoveArray(name)
        found, reported = sampled(odd, DensityArray=["POINTS", "Elevation"])
        self.assertEqual(reported.errors, [])
        np.testing.assert_array_equal(positions(found), positions(expected))
        for wrong in (np.nan, np.inf):
            broken = surface_alone(ball())
            broken.GetPoints().SetPoint(7, 0, wrong, 0)
            self.assertIn("must be finite", sampled(broken)[1].errors[0])

    def test_rules(self):
        """Inverted, the density is what the solid leaves of its box."""
        data = ball(points=60)
        particles, _ = sampled(data, InvertDensity=1)
        self.assertAlmostEqual(particles.GetFieldData().GetArray("TotalMass").GetValue(0)
                               / (np.prod(np.ptp(np.array(data.GetBounds()).reshape(3, 2), axis=1))
                                  - volume_of(data)), 1, 1)
        self.assertGreater(outside(positions(particles), data), 2900)

    def test_a_cube_and_its_cavity(self):
        """Cells that are covered as a whole give the bits of a uniform density; a cavity stays empty."""
        def box(half, inward=False):
            low, high = -half, half
            corners = np.array([[x, y, z] for z in (low, high) for y in (low, high) for x in (low, high)])
            faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2],
                              [1, 3, 7, 5]])
            return corners, faces[:, ::-1] if inward else faces
        (outer, faces), (inner, holes) = box(2.0), box(1.0, inward=True)
        hollow = surface(np.vstack([outer, inner]), [*faces, *(holes + 8)])
        places = positions(sampled(hollow)[0])
        self.assertEqual((abs(places).max(axis=1) < 1).sum(), 0)
        self.assertLessEqual(abs(places).max(), 2)

    def test_only_changes_are_read_again(self):
        """The tables are kept while the surface is the same."""
        proxy = simple.SampleDensity(producer(simple, ball()), DensityResolution=16, NumberOfParticles=50)
        sampler = proxy.GetClientSideObject()
        output_of(proxy)
        built = sampler.GetTableBuildTime()
        proxy.FlowTime = 0.5
        output_of(proxy)
        self.assertEqual(sampler.GetTableBuildTime(), built)
        proxy.DensityResolution = 20
        output_of(proxy)
        self.assertGreater(sampler.GetTableBuildTime(), built)

    def test_other_filters(self):
        """What follows: the same surface is the density of what relaxes and measures the particles."""
        source = producer(simple, ball())
        dots = simple.SampleDensity(source, NumberOfParticles=800, DensityResolution=24)
        relaxed = simple.RelaxBlueNoise(dots, Density=source, DensityResolution=24, MaximumIterations=5)
        self.assertEqual(output_of(relaxed).GetNumberOfPoints(), 800)
        quality = output_of(simple.TransportQuality(dots, Density=source, DensityResolution=24))
        self.assertLess(quality.GetColumnByName("DensityError").GetValue(0), 0.1)
        cube = vtkCubeSource()
        cube.Update()
        morph = simple.MorphDensities(source, Target=producer(simple, cube.GetOutput()),
                                      DensityResolution=16, Parameter=0.5)
        self.assertGreater(output_of(morph).GetNumberOfPoints(), 1000)


def surface_alone(data):
    plain = vtkPolyData()
    plain.CopyStructure(data)
    return plain


def around_solid(proxy):
    proxy.SMProxy.UpdatePropertyInformation()
    return proxy.SMProxy.GetProperty("InputIsAroundSolid").GetElement(0)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""The errors that a user of pvpython reads when the input is wrong: one line each, and no output."""
import unittest

import numpy as np
from rt_filters import FILTERS
from rt_testing import Listener, density_image, load_plugin, main, output_of, producer, size_of

simple = load_plugin()


class Errors(unittest.TestCase):
    def check(self, sampler, *parts):
        """The filter's first error holds all the parts, in one line; the output is empty."""
        reported = Listener(sampler.GetClientSideObject())
        result = output_of(sampler)
        self.assertEqual(result.GetClassName(), "vtkPolyData")
        self.assertEqual(result.GetNumberOfPoints(), 0)
        self.assertTrue(reported.errors)
        message = reported.errors[0].strip().splitlines()[-1]
        for part in parts:
            self.assertIn(part, message)

    def sampler(self, values, **properties):
        shape = (4, len(values) // 4)
        image = density_image(shape, values=np.asarray(values))
        return simple.SampleDensity(Input=producer(simple, image), **properties)

    def test_nan(self):
        self.check(self.sampler([1, 1, np.nan, 1, 1, 1, np.inf, 1.0]), "Density", "2")

    def test_negative(self):
        self.check(self.sampler([1, -1, 1, 1, 1, 1, -3, 1.0]), "Density", "2", "1")

    def test_negative_clamped(self):
        sampler = self.sampler([1, -1, 1, 1, 1, 1, -3, 1.0], NegativeValues="Clamp")
        self.assertEqual(output_of(sampler).GetNumberOfPoints(), 8192)

    def test_nothing(self):
        self.check(self.sampler([0.0] * 8), "Density", "zero")

    def test_missing_array(self):
        sampler = self.sampler([1.0] * 8)
        sampler.DensityArray = ["CELLS", "Mass"]
        self.check(sampler, "Mass")

    def test_component(self):
        self.check(self.sampler([1.0] * 8, Component=3), "Component", "3")

    def test_particles(self):
        self.check(self.sampler([1.0] * 8, NumberOfParticles=0), "NumberOfParticles", "0")

    def test_flow_time(self):
        self.check(self.sampler([1.0] * 8, FlowTime=1.5), "FlowTime", "1.5")

    def test_empty_input_is_no_error(self):
        from vtkmodules.vtkCommonDataModel import vtkImageData
        source = simple.TrivialProducer()
        source.GetClientSideObject().SetOutput(vtkImageData())
        sampler = simple.SampleDensity(Input=source)
        reported = Listener(sampler.GetClientSideObject())
        self.assertEqual(output_of(sampler).GetNumberOfPoints(), 0)
        self.assertEqual(reported.errors, [])

    def test_seeds_outside_warn(self):
        seeds = simple.UniformSeeds(NumberOfPoints=100, Bounds=[-6, 6, 0, 20, 0, 1])
        image = density_image((12, 10))
        sampler = simple.SampleDensity(Input=producer(simple, image), Seeds=seeds)
        reported = Listener(sampler.GetClientSideObject())
        result = output_of(sampler)
        outside = int((np.array([seeds.GetClientSideObject().GetOutput().GetPoint(i)[0]
                                 for i in range(100)]) < 0).sum())
        self.assertEqual(result.GetNumberOfPoints(), 100)
        self.assertEqual(len(reported.warnings), 1)
        self.assertIn(str(outside), reported.warnings[0])

    def test_warp(self):
        values = np.array([1, -1, 1, 1, 1, 1, 1, 1.0])
        image = producer(simple, density_image((4, 2), values=values))
        warp = simple.DensityEqualizingWarp(Input=simple.Plane(), Density=image)
        self.check(warp, "Density", "1 negative value")
        warp.NegativeValues = "Clamp"
        self.assertEqual(output_of(warp).GetNumberOfPoints(), 4)
        warp.Blend = -0.5
        self.check(warp, "Blend", "-0.5", "from 0 to 1")

    def test_blends(self):
        """Of which input it is; both outputs are then empty."""
        good = producer(simple, density_image((4, 2)))
        bad = producer(simple, density_image((4, 2), values=np.array([1, 1, 1, -1, 1, 1, 1, 1.0])))
        flat = producer(simple, density_image((4, 2, 3)))
        for proxy, message in (
                (simple.MorphDensities(Input=good, Target=bad), "Target: The density array"),
                (simple.MorphDensities(Input=bad, Target=good), "Source: The density array"),
                (simple.MorphDensities(Input=good, Target=flat), "Source has the axes x and y, "),
                (simple.MorphDensities(Input=good, Target=good, Parameter=2), "Parameter is 2; "),
                (simple.MorphDensities(Input=good, Target=good, ParticlesPerCell=-1),
                 "ParticlesPerCell is -1; it must be at least 1, or 0 for Auto"),
                (simple.DensityBarycenter(Input=[good, bad, good]), "Input 2 of 3: The density"),
                (simple.DensityBarycenter(Input=[good, flat]), "Input 2 of 2 has the axes"),
                (simple.DensityBarycenter(Input=[good, good], Weights=[1, 2, 3]),
                 "The number of Weights is 3"),
                (simple.DensityBarycenter(Input=[good, good], Weights=[1, -1]),
                 "Weight 1 of the Weights is -1; weights must be finite and at least 0"),
                (simple.DensityBarycenter(Input=[good, good], Weights=[0, 0]),
                 "All Weights are 0")):
            with self.subTest(message=message):
                reported = Listener(proxy.GetClientSideObject())
                self.assertEqual(output_of(proxy).GetNumberOfPoints(), 0)
                particles = proxy.GetClientSideObject().GetOutputDataObject(1)
                self.assertEqual(particles.GetNumberOfPoints(), 0)
                self.assertIn(message, reported.errors[0])

    def test_quality(self):
        image = producer(simple, density_image())
        quality = simple.TransportQuality(Input=simple.Plane(), Density=image, BlockSize=-1)
        reported = Listener(quality.GetClientSideObject())
        self.assertEqual(output_of(quality).GetNumberOfRows(), 0)
        self.assertIn("BlockSize is -1; it must be at least 1, or 0 ", reported.errors[0])
        quality.BlockSize = 3
        self.assertEqual(output_of(quality).GetValueByName(0, "Outside").ToInt(), 3)

    def test_relaxation(self):
        relaxed = simple.RelaxBlueNoise(Input=simple.Plane(Point1=[0.5, -0.5, 0]),
                                        Density=producer(simple, density_image((4, 1))))
        for settings, message in (
                ({"MaximumIterations": -1}, "MaximumIterations is -1; it must be at least 0"),
                ({"MaximumIterations": 2, "Tolerance": 1.0},
                 "Tolerance is 1; it must be at least 0 and less than 1"),
                ({"Tolerance": 0.0, "Method": "OptimalTransport",
                  "Density": producer(simple, density_image((4, 3, 2)))},
                 "The density has 3 dimensions; Method OptimalTransport needs 2 (use"),
                ({"Density": producer(simple, density_image((4,)))},
                 "The density has 1 dimension; Relax Blue Noise needs 2 or 3")):
            with self.subTest(message=message):
                for name, value in settings.items():
                    setattr(relaxed, name, value)
                self.check(relaxed, message)
        relaxed.Density = producer(simple, density_image((4, 3)))
        reported = Listener(relaxed.GetClientSideObject())
        output = output_of(relaxed)
        self.assertEqual(output.GetNumberOfPoints(), 4)
        self.assertEqual(output.GetFieldData().GetArray("Energy").GetNumberOfTuples(), 3)
        self.assertEqual(len(reported.warnings), 1)
        self.assertIn("3 of 4 points outside the domain of the density moved to its border",
                      reported.warnings[0])

    def test_second_input(self):
        """ParaView's dialog goes on without it: one error, and a later choice is taken."""
        found = [filter_ for filter_ in FILTERS if len(filter_.inputs) > 1]
        self.assertEqual(len(found), 4)
        for filter_ in found:
            with self.subTest(filter_.label):
                image = producer(simple, density_image((6, 5)))
                first, second = filter_.inputs
                source = image if filter_.inputs[first] == "density" else simple.Plane()
                made = getattr(simple, filter_.name)(source, **filter_.quick)
                reported = Listener(made.GetClientSideObject())
                self.assertEqual(size_of(output_of(made)), 0)
                self.assertEqual(len(reported.errors), 1)
                self.assertIn("The second input, Target or Density, is missing; choose it", reported.errors[0])
                setattr(made, second, image)
                self.assertGreater(size_of(output_of(made)), 0)

    def test_solid(self):
        solid = simple.SolidDensity(Input=simple.Plane(XResolution=3))
        reported = Listener(solid.GetClientSideObject())
        self.assertEqual(output_of(solid).GetNumberOfPoints(), 0)
        self.assertIn("8 open edges and 0 non-manifold edges", reported.errors[0])
        solid.Input = simple.Box()  # its sides have points of their own, which are merged
        self.assertEqual(output_of(solid).GetDimensions(), (64, 64, 64))
        solid.Supersampling = 17
        self.assertEqual(output_of(solid).GetNumberOfPoints(), 0)
        self.assertIn("Supersampling is 17; it must be from 1 to 16", reported.errors[-1])

    def test_parameterization(self):
        made = simple.AreaPreservingParameterization(Input=simple.Sphere(), Resolution=16, Seams="None")
        for settings, message in (
                ({}, "The input surface is closed: it has no boundary"),
                ({"Input": simple.Box()}, "The input surface is closed"),
                ({"Input": simple.Disk()}, "The input surface has 2 boundary loops"),
                ({"Seams": "Auto", "Corners": [0, 1, 2, 3]},
                 "; or give no Corners, which only a disk can have: then it is cut along seams"),
                ({"Input": simple.Plane(), "Corners": [0, 1, 3]}, "Corners are 3 points; they must"),
                ({"Corners": [0, 1, 3, 4]}, "Corners have the point 4; there are points 0 to 3"),
                ({"Corners": [], "Resolution": 0}, "Resolution is 0; it must be from 1 to 16384")):
            with self.subTest(message=message):
                for name, value in settings.items():
                    setattr(made, name, value)
                reported = Listener(made.GetClientSideObject())
                self.assertEqual(output_of(made).GetNumberOfPoints(), 0)
                self.assertIn(message, reported.errors[0])
        made.Resolution = 16
        self.assertEqual(output_of(made).GetNumberOfPoints(), 4)

    def test_surface(self):
        plane = simple.Calculator(Input=simple.Plane(XResolution=4), ResultArrayName="Height",
                                  Function="coordsX")
        sampled = simple.SampleSurface(Input=simple.Sphere(), Method="Flow", Resolution=16,
                                       NumberOfParticles=9)
        for settings, message in (
                ({}, "The input surface is closed: it has no boundary"),
                ({"Input": plane, "DensityArray": ["POINTS", "Height"]},
                 "The density array 'Height' has 4 negative values, the first at index 0 (-0.5)"),
                ({"DensityArray": ["POINTS", "Normals"]},
                 "The density array 'Normals' has 3 components; it must have 1"),
                ({"DensityArray": ["CELLS", "Gone"]},
                 "The input surface has no density array 'Gone'; it has "),
                ({"DensityArray": ["POINTS", "None"], "NumberOfParticles": 0},
                 "NumberOfParticles is 0; it must be at least 1")):
            with self.subTest(message=message):
                for name, value in settings.items():
                    setattr(sampled, name, value)
                reported = Listener(sampled.GetClientSideObject())
                self.assertEqual(output_of(sampled).GetNumberOfPoints(), 0)
                self.assertIn(message, reported.errors[0])
        sampled.NumberOfParticles = 9
        self.assertEqual(output_of(sampled).GetNumberOfPoints(), 9)

    def test_splat(self):
        splat = simple.SplatMass(Input=simple.Plane(), Radius=0)
        reported = Listener(splat.GetClientSideObject())
        self.assertEqual(output_of(splat).GetNumberOfPoints(), 0)
        self.assertIn("Radius is 0; it must be above 0 and at most 10000 cells", reported.errors[0])
        splat.Radius = 1
        splat.MassArray = ["POINTS", "Weight"]
        reported = Listener(splat.GetClientSideObject())
        self.assertEqual(output_of(splat).GetNumberOfPoints(), 0)
        self.assertIn("no mass array 'Weight'", reported.errors[0])
        splat.MassArray = ["POINTS", "None"]
        self.assertEqual(output_of(splat).GetNumberOfPoints(), 4)  # as many cells as points

    def test_splat_outside_warns(self):
        splat = simple.SplatMass(Input=simple.Plane(),
                                 Reference=producer(simple, density_image()))
        reported = Listener(splat.GetClientSideObject())
        self.assertEqual(output_of(splat).GetNumberOfPoints(), 13 * 11)
        self.assertIn("2 of 4 points are outside", reported.warnings[0])

    def test_warp_outside_warns(self):
        warp = simple.DensityEqualizingWarp(Input=simple.Plane(Point1=[0.5, -0.5, 1]),
                                            Density=producer(simple, density_image()))
        reported = Listener(warp.GetClientSideObject())
        self.assertEqual(output_of(warp).GetNumberOfPoints(), 4)
        self.assertEqual(len(reported.warnings), 1)
        self.assertIn("3 of 4 points outside", reported.warnings[0])


if __name__ == "__main__":
    main()

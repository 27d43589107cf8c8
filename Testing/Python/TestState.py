# SPDX-License-Identifier: BSD-3-Clause
"""A pipeline comes back from a state file, a Python state and a Python trace."""
import os
import subprocess
import unittest

from rt_testing import OUTPUT, SOURCE, digest, load_plugin, main, output_of

simple = load_plugin()


KINDS = ("TransportSampler", "TransportMap", "DensityEqualizingWarp", "TransportQuality",
         "EqualMassCells", "SolidDensity", "TransportInterpolator", "TransportBarycenter",
         "MassSplatter", "AreaPreservingParameterization", "SurfaceSampler", "BlueNoiseRelaxation")


def pipeline():
    """A photograph, seeds of its own, and filters with settings that are not the defaults."""
    photograph = simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data",
                                                                "ascent.png")])
    seeds = simple.UniformSeeds(Bounds=[0, 511, 0, 511, 0, 0], NumberOfPoints=500,
                                Pattern="Jittered")
    sampler = simple.SampleDensity(registrationName="Sampler", Input=photograph, Seeds=seeds,
                                   InvertDensity=1, FlowTime=0.75, Integrator="RungeKutta4",
                                   NumberOfSteps=12)
    simple.TransportMap(registrationName="Map", Input=photograph, InvertDensity=1,
                        Direction="DensityToUniform", SampleDimensions=[20, 30, 1],
                        Integrator="Adaptive", Tolerance=0.5)
    simple.DensityEqualizingWarp(registrationName="Warp", Input=seeds, Density=photograph,
                                 InvertDensity=1, Blend=0.25, NumberOfSteps=9)
    simple.TransportQuality(registrationName="Quality", Input=sampler, Density=photograph,
                            InvertDensity=1, BlockSize=32)
    simple.RelaxBlueNoise(registrationName="Relaxation", Input=sampler, Density=photograph,
                          InvertDensity=1, Method="OptimalTransport", MaximumIterations=3,
                          Tolerance=0.001)
    simple.SplatMass(registrationName="Splat", Input=sampler, Dimensions=[30, 20, 1],
                     MassArray=["POINTS", "Mass"], Kernel="Gaussian", Radius=1.5,
                     Boundary="Drop", Association="Cells")
    simple.EqualMassCells(registrationName="Cells", Input=seeds, Domain=photograph, Resolution=60,
                          CostExponent=4, NumberOfSteps=20)
    simple.SolidDensity(registrationName="Solid", Input=simple.Sphere(), Resolution=20,
                        Supersampling=3, Padding=0.25, Association="Cells", Threading="Serial")
    simple.AreaPreservingParameterization(
        registrationName="Parameterization", Input=simple.Plane(XResolution=6, YResolution=5),
        Corners=[2, 13, 39, 21], Resolution=24, Polish=0, Threading="Serial")
    sheet = simple.Calculator(Input=simple.Plane(XResolution=6, YResolution=5),
                              ResultArrayName="Height", Function="2+coordsX")
    simple.SampleSurface(registrationName="OnSurface", Input=sheet, NumberOfParticles=321,
                         DensityArray=["POINTS", "Height"], SeedPattern="Jittered", RandomSeed=7,
                         Corners=[2, 13, 39, 21], Resolution=24, NumberOfSteps=9)
    parts = [simple.ExtractSubset(Input=photograph, VOI=[first, first + 40, 0, 30, 0, 0])
             for first in (100, 200, 300)]
    simple.MorphDensities(registrationName="Morph", Input=parts[0], Target=parts[1], Parameter=0.25,
                          MassMode="Geometric", Kernel="Gaussian", Radius=2, ParticlesPerCell=2,
                          Dimensions=[30, 0, 0], PublishTime=1, NumberOfTimeSteps=7)
    simple.DensityBarycenter(registrationName="Barycenter", Input=parts, Weights=[1, 0.5, 2],
                             MassMode="Normalize", InvertDensity=1)


def digests():
    """The hashes of the outputs of the pipeline's filters by their kinds."""
    found = {source.GetXMLName(): source for source in simple.GetSources().values()}
    return [kind + "=" + digest(output_of(found[kind])) for kind in KINDS]


def in_a_process(script, path):
    """Runs a saved script in a new pvpython; what is added prints the hashes of its filters."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("import sys; sys.path.insert(0, %r)\n" % os.path.dirname(__file__))
        file.write("import TestState\n" + script)
        file.write("\nprint('HASHES', *TestState.digests())\n")
    done = subprocess.run([os.environ.get("RT_PVPYTHON", "pvpython"), path],
                          stdout=subprocess.PIPE, universal_newlines=True, check=True)
    return [line for line in done.stdout.splitlines() if line.startswith("HASHES")][0].split()[1:]


class State(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()

    def test_state_file(self):
        pipeline()
        expected = digests()
        self.assertEqual(len(set(expected)), len(KINDS))
        path = os.path.join(OUTPUT, "state.pvsm")
        simple.SaveState(path)
        simple.ResetSession()
        simple.LoadState(path)
        sampler = simple.FindSource("Sampler")
        self.assertEqual(sampler.Integrator, "RungeKutta4")
        self.assertEqual(sampler.NumberOfSteps, 12)
        transport = simple.FindSource("Map")
        self.assertEqual(transport.Direction, "DensityToUniform")
        self.assertEqual(list(transport.SampleDimensions), [20, 30, 1])
        self.assertEqual(simple.FindSource("Warp").Blend, 0.25)
        self.assertEqual(simple.FindSource("Quality").BlockSize, 32)
        relaxed = simple.FindSource("Relaxation")
        self.assertEqual((relaxed.Method, relaxed.MaximumIterations, relaxed.Tolerance),
                         ("OptimalTransport", 3, 0.001))
        splat = simple.FindSource("Splat")
        self.assertEqual((splat.Radius, splat.Boundary, list(splat.MassArray)),
                         (1.5, "Drop", ["POINTS", "Mass"]))
        cells = simple.FindSource("Cells")
        self.assertEqual((cells.Resolution, cells.CostExponent, cells.NumberOfSteps), (60, 4, 20))
        solid = simple.FindSource("Solid")
        self.assertEqual((solid.Resolution, solid.Supersampling, solid.Padding, solid.Association,
                          solid.Threading), (20, 3, 0.25, "Cells", "Serial"))
        made = simple.FindSource("Parameterization")
        self.assertEqual((list(made.Corners), made.Resolution, made.Polish, made.Threading),
                         ([2, 13, 39, 21], 24, 0, "Serial"))
        sampled = simple.FindSource("OnSurface")
        self.assertEqual((sampled.NumberOfParticles, list(sampled.DensityArray), sampled.SeedPattern,
                          sampled.RandomSeed, list(sampled.Corners), sampled.Resolution,
                          sampled.NumberOfSteps),
                         (321, ["POINTS", "Height"], "Jittered", 7, [2, 13, 39, 21], 24, 9))
        morph = simple.FindSource("Morph")
        self.assertEqual((morph.Parameter, morph.MassMode, morph.Kernel, morph.Radius),
                         (0.25, "Geometric", "Gaussian", 2))
        self.assertEqual((morph.ParticlesPerCell, list(morph.Dimensions)), (2, [30, 0, 0]))
        self.assertEqual((morph.PublishTime, morph.NumberOfTimeSteps), (1, 7))
        barycenter = simple.FindSource("Barycenter")
        self.assertEqual(list(barycenter.Weights), [1, 0.5, 2])
        self.assertEqual(len(barycenter.Input), 3)
        self.assertEqual(digests(), expected)

    def test_state_of_before(self):
        """A state without the properties and defaults of now gives what it gave."""
        path = os.path.join(SOURCE, "Testing", "Data", "before-sample-arrays.pvsm")
        with open(path, encoding="utf-8") as file:
            state = file.read().replace("@SOURCE@", SOURCE)
        path = os.path.join(OUTPUT, "before-sample-arrays.pvsm")
        with open(path, "w", encoding="utf-8") as file:
            file.write(state)
        simple.LoadState(path)
        quality = simple.FindSource("Quality")
        self.assertEqual(quality.BlockSize, 8)
        row = output_of(quality)
        self.assertAlmostEqual(row.GetValueByName(0, "DensityError").ToDouble(),
                               0.6272852234266574, 12)
        self.assertAlmostEqual(row.GetValueByName(0, "MeanSpacing").ToDouble(),
                               0.8476155747182829, 12)
        particles = output_of(simple.FindSource("Sampler"))
        self.assertEqual(particles.GetNumberOfPoints(), 3000)
        expected = (358.728611330922, 103.61377915596726, 0.0)
        for found, coordinate in zip(particles.GetPoint(1234), expected):
            self.assertAlmostEqual(found, coordinate, 9)
        arrays = particles.GetPointData()
        self.assertEqual([arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())],
                         ["SeedId", "SeedPosition", "Displacement", "Mass", "PNGImage"])

    def test_python_state(self):
        from paraview import smstate
        pipeline()
        expected = digests()
        script = smstate.get_state()
        self.assert_calls(script)
        self.assertEqual(in_a_process(script, os.path.join(OUTPUT, "state.py")), expected)

    def test_trace(self):
        from paraview import smtrace
        smtrace.start_trace()
        pipeline()
        expected = digests()
        script = smtrace.stop_trace()
        self.assert_calls(script)
        self.assertEqual(in_a_process(script, os.path.join(OUTPUT, "trace.py")), expected)

    def assert_calls(self, script):
        for call in ("SampleDensity(", "TransportMap(", "DensityEqualizingWarp(",
                     "TransportQuality(", "EqualMassCells(", "SolidDensity(", "MorphDensities(",
                     "DensityBarycenter(",
                     "SplatMass(", "AreaPreservingParameterization(", "SampleSurface(",
                     "RelaxBlueNoise("):
            self.assertIn(call, script)


if __name__ == "__main__":
    main()

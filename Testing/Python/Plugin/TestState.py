# SPDX-License-Identifier: BSD-3-Clause
"""A pipeline comes back from a state file, a Python state and a Python trace."""
import os
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from rt_filters import FILTERS
from rt_testing import OUTPUT, SOURCE, digest, load_plugin, main, output_of, size_of

simple = load_plugin()


def sources():
    """One for each kind of input, small ones: each filter runs on them up to seven times."""
    photograph = simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data",
                                                                "ascent.png")])
    parts = [simple.ExtractSubset(Input=photograph, VOI=[first, first + 40, 0, 30, 0, 0])
             for first in (100, 200, 300)]
    density = simple.ExtractSubset(Input=photograph, VOI=[100, 340, 0, 60, 0, 0])
    seeds = simple.UniformSeeds(Bounds=[100, 340, 0, 60, 0, 0], NumberOfPoints=400)
    particles = simple.SampleDensity(Input=density, InvertDensity=1, NumberOfParticles=500)
    plane = simple.Plane(XResolution=6, YResolution=5)
    sheet = simple.Calculator(Input=plane, ResultArrayName="Height", Function="2+coordsX")
    sphere = simple.Sphere()
    regions = simple.Calculator(Input=plane, AttributeType="Cell Data", ResultArrayName="Mass", Function="3")
    alike = [parts[0], *(simple.Calculator(Input=parts[0], ResultArrayName="Lit", Function=function)
                         for function in ("coordsX", "coordsY"))]
    return {"density": density, "densities": parts, "alike": alike, "image": parts[0], "mesh": seeds,
            "points": particles, "disk": sheet, "solid": sphere, "map": regions}


def pipeline():
    """Every filter, with all inputs and settings that are not the defaults."""
    given = sources()
    for filter_ in FILTERS:
        inputs = {kind: (lambda source=source: source) for kind, source in given.items()}
        if "Target" in filter_.inputs:  # small ones, that differ
            inputs.update(Input=lambda: given["densities"][0], Target=lambda: given["densities"][1])
        if filter_.one_box:
            inputs.update(densities=lambda: given["alike"])
        # Dimensions count where there is no reference.
        filter_.make(simple, inputs, optional="Reference" not in filter_.optional,
                     registrationName=filter_.label, **filter_.saved)


def digests():
    """The hashes of the outputs of the pipeline's filters."""
    outputs = [output_of(simple.FindSource(filter_.label)) for filter_ in FILTERS]
    assert all(size_of(output) > 0 for output in outputs)
    return [digest(output) for output in outputs]


def in_a_process(script, path):
    """Runs a saved script in a new pvpython; what is added prints the hashes of its filters."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("import sys; sys.path.insert(0, %r)\n" % os.path.dirname(__file__))
        file.write("import TestState\n" + script)
        file.write("\nprint('HASHES', *TestState.digests())\n")
    done = subprocess.run([os.environ.get("RT_PVPYTHON", "pvpython"), path],
                          stdout=subprocess.PIPE, universal_newlines=True, check=True)
    return [line for line in done.stdout.splitlines() if line.startswith("HASHES")][0].split()[1:]


def load_data(name):
    """Loads a state of the tests' data."""
    with open(os.path.join(SOURCE, "Testing", "Data", name), encoding="utf-8") as file:
        state = file.read().replace("@SOURCE@", SOURCE)
    path = os.path.join(OUTPUT, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(state)
    simple.LoadState(path)


def load_without(kind, *names):
    """Saves the state and loads it as it was before its proxies of a kind had properties."""
    path = os.path.join(OUTPUT, "former.pvsm")
    simple.SaveState(path)
    state = ElementTree.parse(path)
    for proxy in state.iter("Proxy"):
        for new in list(proxy) if proxy.get("type") == kind else []:
            if new.get("name") in names:
                proxy.remove(new)
    state.write(path)
    simple.ResetSession()
    simple.LoadState(path)


class State(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()

    def test_state_file(self):
        pipeline()
        expected = digests()
        self.assertEqual(len(set(expected)), len(FILTERS))
        path = os.path.join(OUTPUT, "state.pvsm")
        simple.SaveState(path)
        simple.ResetSession()
        simple.LoadState(path)
        for filter_ in FILTERS:
            loaded = simple.FindSource(filter_.label)
            for name, value in filter_.saved.items():
                with self.subTest(filter_.label, property=name):
                    found = getattr(loaded, name)
                    self.assertEqual(list(found) if isinstance(value, list) else found, value)
            for name, kind in filter_.inputs.items():
                if kind == "densities":
                    self.assertEqual(len(getattr(loaded, name)), 3)
        self.assertEqual(digests(), expected)

    def test_saved_values_are_no_defaults(self):
        for filter_ in FILTERS:
            fresh = getattr(simple, filter_.name)()
            for name, value in filter_.saved.items():
                with self.subTest(filter_.label, property=name):
                    found = getattr(fresh, name)
                    self.assertNotEqual(list(found) if isinstance(value, list) else found, value)

    def test_state_of_before(self):
        """A state without the properties and defaults of now gives what it gave."""
        load_data("before-sample-arrays.pvsm")
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

    def test_state_before_renames(self):
        """A state with the names and numbers of before gives what it gave."""
        load_data("before-renames.pvsm")
        part, masses = simple.FindSource("Part"), simple.FindSource("Masses")
        crops = [simple.FindSource(name) for name in ("Crop0", "Lit0", "Lit1")]
        now = {
            "Tracked": simple.TransportTemporalInterpolator(
                part, Method="RectifiedFlow", ResampleFactor=3, TrackParticles=1, AdvectArrays=0),
            "Usual": simple.TransportTemporalInterpolator(part, ResampleFactor=2),
            "Distances": simple.TransportDistance(Input=crops, NumberOfCoordinates=3),
            "Regions": simple.Cartogram(masses, MassArray=["CELLS", "Mass"], Resolution=60, MinimumShare=0.2,
                                        EmptyCells="Minimum"),
        }
        self.assertEqual(now["Usual"].Method, "Optimal")
        for name, expected in now.items():
            found = simple.FindSource(name)
            for filter_ in (found, expected):
                filter_.UpdatePipeline(0.4)
            # The state's filters have no DensityArray, and keep none.
            others = {"Input", "Overlay", "InputNames", "DensityArray", "InputIsAroundSolid"}
            for key in set(expected.ListProperties()) - others:
                with self.subTest(name, property=key):
                    self.assertEqual(str(getattr(found, key)), str(getattr(expected, key)))
            with self.subTest(name):
                outputs = [[filter_.GetClientSideObject().GetOutputDataObject(port)
                            for port in range(filter_.GetNumberOfOutputPorts())]
                           for filter_ in (found, expected)]
                self.assertEqual(*[[digest(output) for output in ports[1:]] for ports in outputs])
                self.assertGreater(size_of(outputs[0][1]), 0)
        self.assertEqual(len(simple.FindSource("Tracked").TimestepValues), 4)

    def test_state_before_empty_cells(self):
        """A warp of a state without EmptyCells counts empty cells as nothing, as then; any other state
        keeps what it has."""
        plane = simple.Plane(XResolution=9, YResolution=9)
        wavelet = simple.Wavelet(WholeExtent=[-9, 9, -9, 9, 0, 0])
        gaps = simple.Threshold(Input=wavelet, Scalars=["POINTS", "RTData"], LowerThreshold=150,
                                UpperThreshold=1000)
        points = simple.Transform(Input=plane)
        points.Transform.Scale = [16, 16, 1]
        warp = simple.DensityEqualizingWarp(points, Density=gaps, registrationName="Warp")
        expected = {}
        for rule in ("Zero", "Minimum", "Mean"):
            warp.EmptyCells = rule
            expected[rule] = digest(output_of(warp))
        self.assertEqual(len(set(expected.values())), 3)
        self.assertEqual(simple.DensityEqualizingWarp(points, Density=gaps).EmptyCells, "Mean")
        for rule in ("Minimum", "Mean"):
            warp.EmptyCells = rule
            for then, kept in ((rule, True), ("Zero", False)):
                load_without("DensityEqualizingWarp", *(() if kept else (
                    "EmptyCells", "EmptyValue", "Margin", "NaNValues", "ValidRange")))
                found = simple.FindSource("Warp")
                with self.subTest(rule, kept=kept):
                    self.assertEqual(found.EmptyCells, then)
                    self.assertEqual(digest(output_of(found)), expected[then])
            warp = simple.FindSource("Warp")

    def test_state_before_the_method_of_surfaces(self):
        """Sample Surface of a state without Method takes the flow, as then."""
        dome = simple.Sphere(EndPhi=90)
        dots = simple.SampleSurface(dome, NumberOfParticles=50, Resolution=32, registrationName="Dots")
        self.assertEqual(dots.Method, "Relaxation")
        relaxed = digest(output_of(dots))
        dots.Method = "Flow"
        flowed = digest(output_of(dots))
        self.assertNotEqual(relaxed, flowed)
        for method, removed, expected in (("Relaxation", False, relaxed), ("Flow", False, flowed),
                                          ("Relaxation", True, flowed)):
            simple.FindSource("Dots").Method = method
            load_without("SurfaceSampler", *(("Method", "RelaxationIterations") if removed else ()))
            with self.subTest(method, removed=removed):
                self.assertEqual(digest(output_of(simple.FindSource("Dots"))), expected)

    def test_state_before_the_name_of_a_blend(self):
        """Blends of a state without ResultArrayName call their density Density, as then."""
        for kind in ("TransportInterpolator", "TransportBarycenter"):
            simple.ResetSession()
            parts = sources()["densities"]
            if kind == "TransportBarycenter":
                simple.DensityBarycenter(Input=parts, registrationName="Blend")
            else:
                simple.MorphDensities(parts[0], Target=parts[1], registrationName="Blend")
            for given, names, expected in (("", (), "PNGImage"), ("rho", (), "rho"),
                                           ("", ("ResultArrayName",), "Density")):
                simple.FindSource("Blend").ResultArrayName = given
                load_without(kind, *names)
                blend = simple.FindSource("Blend")
                blend.UpdatePipeline()
                with self.subTest(kind, given=given, removed=names):
                    self.assertEqual(blend.ResultArrayName, "Density" if names else given)
                    self.assertEqual(list(blend.PointData.keys()), [expected])

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
        for filter_ in FILTERS:
            self.assertIn(filter_.name + "(", script)


if __name__ == "__main__":
    main()

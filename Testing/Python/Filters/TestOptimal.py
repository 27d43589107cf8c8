# SPDX-License-Identifier: BSD-3-Clause
"""Method Optimal and Certify: what the bound, the gap and the slack of three filters say, that the map is
kept and shared, and inputs at the edge of what there can be."""
import math
import time
import unittest

import numpy as np
from rt_testing import (Listener, density_image, digest, load_plugin, main, output_of, points_in,
                        producer)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools

simple = load_plugin()
import rectifiedtransport as rt  # noqa: E402, isort: skip

FIELDS = ("TransportCost", "TransportCostLowerBound", "OptimalityGap")


def landscape(shape, spread=30.0):
    """Two hills over a plain: the grid resolves it."""
    axes = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in shape[::-1]], indexing="ij")
    hills = (np.exp(-spread * sum((x - 0.3) ** 2 for x in axes)) +
             0.5 * np.exp(-2 * spread * sum((x - 0.75) ** 2 for x in axes)))
    image = density_image(shape, values=(0.05 + hills).ravel())
    image.SetSpacing(0.5, 0.5, 0.5)
    return image


def field(data, name):
    array = data.GetFieldData().GetArray(name)
    return None if array is None else array.GetValue(0)


def figures(data):
    return [field(data, name) for name in FIELDS]


def slack_of(data):
    array = data.GetPointData().GetArray("Slack")
    return None if array is None else vtk_to_numpy(array)


def sampler(image, **properties):
    return set_all(rt.vtkTransportSampler(), [image], properties)


def transport_map(image, **properties):
    return set_all(rt.vtkTransportMap(), [image], properties)


def warp(image, **properties):
    return set_all(rt.vtkDensityEqualizingWarp(), [points_in(image, 100), image], properties)


def set_all(algorithm, inputs, properties):
    for port, data in enumerate(inputs):
        algorithm.SetInputData(port, data)
    for name, value in properties.items():
        getattr(algorithm, "Set" + name)(value)
    return algorithm


def run(algorithm):
    """The output, and what was reported."""
    reported = Listener(algorithm)
    algorithm.Update()
    return algorithm.GetOutputDataObject(0), reported.errors, reported.warnings


def seconds(algorithm):
    begin = time.process_time()
    algorithm.Update()
    return time.process_time() - begin


MAKERS = {"sampler": sampler, "map": transport_map, "warp": warp}


class Optimal(unittest.TestCase):
    def sound(self, algorithm):
        output, errors, warnings = run(algorithm)
        self.assertEqual((errors, warnings), ([], []))
        return output

    def test_properties(self):
        simple.ResetSession()
        for make in (simple.SampleDensity, simple.TransportMap):
            proxy = make(Input=producer(simple, density_image()))
            self.assertEqual(proxy.Method, "RectifiedFlow")
            self.assertEqual(proxy.OptimalityTolerance, 0.001)
            self.assertEqual(proxy.Certify, 0)
            proxy.Method = "Optimal"
            proxy.UpdatePipeline()
            self.assertEqual(proxy.GetClientSideObject().GetMethodAsString(), "Optimal")
            for name in FIELDS:
                self.assertIsNotNone(proxy.FieldData[name], name)
        self.assertEqual(simple.GetSources() and len(simple.GetSources()), 4)

    def test_nothing_new_by_default(self):
        for name, make in MAKERS.items():
            with self.subTest(name):
                output = self.sound(make(landscape((24, 20))))
                self.assertEqual(figures(output)[1:], [None, None])
                self.assertIsNone(slack_of(output))

    def test_bound_and_gap(self):
        for shape in ((48, 40), (24, 20, 22)):
            image = landscape(shape)
            bounds = set()
            for name, make in MAKERS.items():
                for direction in (0, 1) if name == "map" else (0,):
                    extra = dict(Direction=direction) if name == "map" else {}
                    with self.subTest(name, shape=shape, direction=direction):
                        flow = self.sound(make(image, Certify=1, **extra))
                        best = self.sound(make(image, Method=1, **extra))
                        cost, bound, gap = figures(flow)
                        self.assertLess(bound, cost)
                        self.assertAlmostEqual(gap, cost / bound - 1, 12)
                        self.assertGreater(gap, 0.05)
                        least, same, near = figures(best)
                        self.assertEqual(same, bound)
                        self.assertLess(near, 0.02)
                        self.assertLess(abs(least / bound - 1), 0.02)
                        self.assertAlmostEqual(near, max(0, least / bound - 1), 12)
                        bounds.add(bound)
            self.assertEqual(len(bounds), 1)

    def test_certify_changes_no_particle(self):
        image = landscape((48, 40))
        plain = self.sound(sampler(image))
        certified = self.sound(sampler(image, Certify=1))
        self.assertEqual(field(plain, "TransportCost"), field(certified, "TransportCost"))
        certified.GetPointData().RemoveArray("Slack")
        self.assertEqual(digest(plain), digest(certified))

    def test_steps(self):
        for name, make in MAKERS.items():
            with self.subTest(name):
                output = self.sound(make(landscape((24, 20)), Method=1))
                self.assertEqual(field(output, "StepsTaken"), 0)
                self.assertFalse(output.GetFieldData().HasArray("AreaErrorEstimate"))

    def test_slack(self):
        image = landscape((48, 40))
        for properties in (dict(Method=1), dict(Certify=1)):
            with self.subTest(**properties):
                output = self.sound(sampler(image, NumberOfParticles=20000, **properties))
                cost, bound, _ = figures(output)
                slack = slack_of(output)
                self.assertEqual(len(slack), 20000)
                self.assertGreaterEqual(slack.min(), 0)
                self.assertAlmostEqual(2 * slack.mean() / bound, cost / bound - 1, delta=0.005)

    def test_slack_says_where_the_flow_is_not_optimal(self):
        image = landscape((48, 40))
        slack = slack_of(self.sound(sampler(image, Certify=1)))
        best = slack_of(self.sound(sampler(image, Method=1)))
        self.assertLess(best.mean(), 0.1 * slack.mean())

    def test_units(self):
        """Squared lengths, whatever their size."""
        one = landscape((30, 24))
        unit = self.sound(sampler(one, Method=1, NumberOfParticles=500))
        for factor in (2.0 ** -400, 2.0 ** -20, 2.0 ** 9, 2.0 ** 400):
            with self.subTest(factor=factor):
                other = landscape((30, 24))
                other.SetSpacing(*(0.5 * factor for _ in range(3)))
                output = self.sound(sampler(other, Method=1, NumberOfParticles=500))
                for name in FIELDS[:2]:
                    self.assertAlmostEqual(field(output, name) / factor / factor / field(unit, name), 1, 9)
                np.testing.assert_allclose(slack_of(output) / factor / factor, slack_of(unit),
                                           rtol=1e-6, atol=1e-12)

    def test_boxes_of_one_content(self):
        """Values and measures of cells are the same, sides are not."""
        square = landscape((30, 30))
        flat = landscape((30, 30))
        flat.SetSpacing(0.25, 1.0, 0.5)
        algorithm = sampler(square, Method=1)
        first = figures(self.sound(algorithm))
        algorithm.SetInputData(flat)
        second = figures(self.sound(algorithm))
        self.assertGreater(second[1], 1.2 * first[1])
        self.assertLess(abs(second[0] / second[1] - 1), 0.02)
        self.assertEqual(second, figures(self.sound(sampler(flat, Method=1))))

    def test_flow_time(self):
        image = landscape((30, 24))
        end = self.sound(sampler(image, Method=1, NumberOfParticles=500))
        way = self.sound(sampler(image, Method=1, NumberOfParticles=500, FlowTime=0.25))
        self.assertEqual(figures(way)[1:], [None, None])
        self.assertIsNone(slack_of(way))
        start, last, quarter = (vtk_to_numpy(array) for array in (
            end.GetPointData().GetArray("SeedPosition"), end.GetPoints().GetData(),
            way.GetPoints().GetData()))
        np.testing.assert_allclose(quarter, start + 0.25 * (last - start), atol=1e-9)
        certified = self.sound(sampler(image, Certify=1, FlowTime=0.5))
        self.assertEqual(figures(certified)[1:], [None, None])
        seeds = self.sound(sampler(image, Method=1, NumberOfParticles=500, FlowTime=0))
        np.testing.assert_array_equal(vtk_to_numpy(seeds.GetPoints().GetData()), start)

    def test_paths(self):
        image = landscape((30, 24))
        end = self.sound(sampler(image, Method=1, NumberOfParticles=100))
        paths = self.sound(sampler(image, Method=1, NumberOfParticles=100, OutputPaths=1))
        np.testing.assert_allclose(figures(paths), figures(end), rtol=1e-9)
        self.assertIsNone(slack_of(paths))
        points = vtk_to_numpy(paths.GetPoints().GetData()).reshape(100, -1, 3)
        np.testing.assert_allclose(points[:, -1], vtk_to_numpy(end.GetPoints().GetData()), atol=1e-9)
        np.testing.assert_allclose(np.diff(points, 2, axis=1), 0, atol=1e-9)

    def test_given_seeds(self):
        """Each by itself: a subset has the particles that all have."""
        image = landscape((30, 24))
        given = points_in(image, 60)
        fewer = points_in(image, 60)
        fewer.GetPoints().SetNumberOfPoints(20)
        all_, some = (self.sound(set_all(rt.vtkTransportSampler(), [image, seeds], dict(Method=1)))
                      for seeds in (given, fewer))
        np.testing.assert_array_equal(vtk_to_numpy(all_.GetPoints().GetData())[:20],
                                      vtk_to_numpy(some.GetPoints().GetData()))
        np.testing.assert_array_equal(slack_of(all_)[:20], slack_of(some))

    def test_threads(self):
        """The same bits, with a new solution each time."""
        for name, make in MAKERS.items():
            with self.subTest(name):
                found = set()
                for threads in (1, 2):
                    vtkSMPTools.Initialize(threads)
                    for threading in (1, 2):  # VTK, OpenMP
                        output = self.sound(make(landscape((40, 36)), Method=1, Threading=threading))
                        found.add((digest(output), *figures(output)))
                self.assertEqual(len(found), 1)

    def test_kept(self):
        """Another number of particles, another filter and a second run do not solve again."""
        image = landscape((160, 160))
        serial = dict(NumberOfParticles=100, Threading=3)
        first = sampler(image, Method=1, **serial)
        solving = seconds(first)
        first.SetNumberOfParticles(101)
        again = seconds(first)
        self.assertLess(again, 0.3 * solving)
        self.assertLess(seconds(sampler(image, Method=1, **serial)), 0.4 * solving)
        self.assertLess(seconds(transport_map(image, Certify=1, NumberOfSteps=8, Threading=3)),
                        solving)
        first.SetOptimalityTolerance(0.0005)
        self.assertGreater(seconds(first), 0.5 * solving)

    def test_tolerance(self):
        """More iterations give a bound that is no lower."""
        image = landscape((64, 64), 100)
        coarse, fine = (figures(self.sound(sampler(image, Method=1, OptimalityTolerance=tolerance)))[1]
                        for tolerance in (0.9, 1e-9))
        self.assertGreaterEqual(fine, coarse)
        self.assertLess(fine, 1.01 * coarse)

    def test_uniform(self):
        """Without a bound above 0 the gap is 0, as nothing moves but by errors of integration."""
        for shape in ((20, 16), (9, 8, 7)):
            image = density_image(shape, values=np.full(int(np.prod(shape)), 3.0))
            for name, make in MAKERS.items():
                for properties in (dict(Method=1), dict(Certify=1)):
                    with self.subTest(name, shape=shape, **properties):
                        cost, bound, gap = figures(self.sound(make(image, **properties)))
                        self.assertEqual((bound, gap), (0, 0))
                        self.assertLess(cost, 0.01)
        # Noise that the nodes cannot tell from a uniform density.
        noise = density_image((6, 5, 4), seed=2)
        _, bound, gap = figures(self.sound(sampler(noise, Certify=1)))
        self.assertEqual(gap, math.inf if bound == 0 else gap)
        self.assertGreater(gap, 0)

    def test_equal_areas(self):
        image = landscape((128, 96))
        plain = self.sound(transport_map(image, Method=1, Direction=1))
        better = self.sound(transport_map(image, Method=1, Direction=1, EqualizeAreas=1))
        self.assertGreater(field(better, "EqualAreaPasses"), 0)
        errors = [field(output, "LargestBlockError") for output in (plain, better)]
        self.assertLess(errors[1], errors[0])
        self.assertLess(field(better, "OptimalityGap"), 0.02)
        self.assertGreater(field(self.sound(warp(image, Method=1, EqualizeAreas=1)),
                                 "EqualAreaPasses"), 0)

    def test_correction_is_that_of_the_map(self):
        """Filters that share a density, one of which takes the flow."""
        image = landscape((48, 40))
        flow = transport_map(image, Direction=1, EqualizeAreas=1)
        expected = digest(self.sound(flow))
        best = transport_map(image, Method=1, Direction=1, EqualizeAreas=1)
        found = digest(self.sound(best))
        self.assertNotEqual(found, expected)
        flow.SetMethodToOptimal()
        self.assertEqual(digest(self.sound(flow)), found)
        flow.SetMethodToRectifiedFlow()
        self.assertEqual(digest(self.sound(flow)), expected)

    def test_blend(self):
        """The gap is that of the whole map."""
        image = landscape((30, 24))
        self.assertEqual(figures(self.sound(warp(image, Method=1, Blend=0.25))),
                         figures(self.sound(warp(image, Method=1))))
        self.assertEqual(figures(self.sound(warp(image, Method=1, Blend=0))), [None] * 3)

    def test_samples(self):
        """The cost of a warp is that of a map with a sample in each cell."""
        image = landscape((30, 24))
        for properties in (dict(Method=1), dict(Certify=1), dict(Method=1, EqualizeAreas=1)):
            with self.subTest(**properties):
                np.testing.assert_allclose(
                    figures(self.sound(warp(image, **properties))),
                    figures(self.sound(transport_map(image, Direction=1, **properties))), rtol=1e-12)

    def test_what_is_not_resolved(self):
        """A few cells with nearly all mass: the flow's map, and one warning; the bound holds."""
        image = density_image((64, 64), values=np.random.default_rng(1).random(4096) ** -3)
        flow, errors, told = run(sampler(image, Certify=1))
        self.assertEqual(errors, [])
        output, errors, warnings = run(sampler(image, Method=1))
        self.assertEqual(errors, [])
        warnings = [text for text in warnings if "Method Optimal" in text]
        self.assertEqual(len(warnings), 1, warnings)
        self.assertFalse([text for text in told if "Optimal" in text])
        self.assertIn("Method Optimal did not reach the density", warnings[0])
        self.assertIn("the map is that of Method RectifiedFlow", warnings[0])
        self.assertEqual(digest(output), digest(flow))
        self.assertEqual(figures(output), figures(flow))
        self.assertGreater(field(output, "StepsTaken"), 0)

    def test_bound_of_one_cell(self):
        """All mass in a cell or a corner: its uniform part moves by no more than this."""
        n = 32
        for cell in ((0, 0), (n - 1, 0), (20, 9)):
            with self.subTest(cell=cell):
                values = np.zeros((n, n))
                values[cell[::-1]] = 1
                image = density_image((n, n), values=values.ravel())
                sides = np.array([0.5, 2]) * n
                # The mean of |x - y|^2 over a cell x of this measure and y in the box, axis by axis.
                low, high = (sides * (np.array(cell) + k) / n for k in (0, 1))
                optimum = 0
                for side, a, b in zip(sides, low, high):
                    t = (np.arange(20000) + 0.5) / 20000
                    optimum += np.mean((t * side - (a + t * (b - a))) ** 2)
                for properties in (dict(Method=1), dict(Certify=1)):
                    cost, bound, gap = figures(run(sampler(image, SeedPattern=1, **properties))[0])
                    self.assertLessEqual(bound, optimum * (1 + 1e-6))
                    self.assertGreater(bound, 0.97 * optimum)
                    self.assertLess(gap, 0.05)
                    self.assertGreater(cost, 0.97 * bound)

    def test_contrast(self):
        rng = np.random.default_rng(5)
        values = np.where(rng.random(30 * 30) < 0.5, 1e-8, 1e8)
        image = density_image((30, 30), values=values)
        for name, make in MAKERS.items():
            with self.subTest(name):
                output, errors, _ = run(make(image, Method=1))
                self.assertEqual(errors, [])
                cost, bound, gap = figures(output)
                self.assertTrue(0 <= bound < math.inf and 0 <= cost < math.inf and gap >= 0)
                if name != "map":
                    self.assertTrue(np.isfinite(vtk_to_numpy(output.GetPoints().GetData())).all())

    def test_one_pixel(self):
        for shape in ((1, 1), (1, 1, 1), (1,), (1, 6), (5, 1, 1)):
            values = np.linspace(1, 2, int(np.prod(shape)))
            for name, make in MAKERS.items():
                for properties in (dict(Method=1), dict(Certify=1)):
                    with self.subTest(name, shape=shape, **properties):
                        output, errors, _ = run(make(density_image(shape, values=values), **properties))
                        self.assertEqual(errors, [])
                        cost, bound, gap = figures(output)
                        self.assertTrue(0 <= bound < math.inf and gap >= 0, (cost, bound, gap))

    def test_nan(self):
        values = landscape((24, 20)).GetCellData().GetScalars()
        image = landscape((24, 20))
        image.GetCellData().GetScalars().SetValue(17, math.nan)
        for name, make in MAKERS.items():
            with self.subTest(name):
                output, errors, _ = run(make(image, Method=1))
                self.assertEqual(len(errors), 1)
                self.assertIn("NaN", errors[0])
                self.assertEqual(output.GetNumberOfPoints(), 0)
        filled = sampler(image, Method=1)
        filled.SetNaNValuesToEmpty()
        self.assertEqual(len(slack_of(self.sound(filled))), 8192)
        self.assertEqual(values.GetNumberOfTuples(), 480)

    def test_errors(self):
        image = landscape((24, 20))
        for name, make in MAKERS.items():
            for properties, text in (
                    (dict(Method=2), "Method is 2; it must be 0 (RectifiedFlow) or 1 (Optimal)"),
                    (dict(OptimalityTolerance=0), "OptimalityTolerance is 0; it must be above 0 and below 1"),
                    (dict(OptimalityTolerance=1), "OptimalityTolerance is 1; it must be above 0 and below 1"),
                    (dict(OptimalityTolerance=math.nan), "OptimalityTolerance is nan"),
                    (dict(Method=1, Tables=2),
                     "Tables is Tiled, which does not give the optimal map (Method Optimal); Tables = "
                     "Whole does, or Auto"),
                    (dict(Certify=1, Tables=2),
                     "Tables is Tiled, which does not give a bound of the cost (Certify)")):
                with self.subTest(name, **properties):
                    algorithm = make(image, **properties)
                    output, errors, _ = run(algorithm)
                    self.assertIn(text, errors[0])
                    self.assertEqual(output.GetNumberOfPoints(), 0)
                    for key, value in dict(Method=1, OptimalityTolerance=0.01, Tables=1).items():
                        getattr(algorithm, "Set" + key)(value)
                    self.assertGreater(self.sound(algorithm).GetNumberOfPoints(), 0)

    def test_cells_have_no_optimal_map(self):
        """They have the properties of the flow, and not those of the map."""
        cells = rt.vtkEqualMassCells()
        cells.SetInputData(points_in(landscape((24, 20)), 9))
        cells.SetResolution(32)
        cells.SetNumberOfSteps(16)
        self.sound(cells)
        for name in ("Method", "Certify", "OptimalityTolerance", "Tables", "Device", "DeviceName"):
            self.assertFalse(hasattr(cells, "Set" + name), name)


if __name__ == "__main__":
    main()

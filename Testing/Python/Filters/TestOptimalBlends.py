# SPDX-License-Identifier: BSD-3-Clause
"""Morph Densities and Density Barycenter with Method Optimal and Certify: what stands still, bounds against
linear programmes, the functional, and that nothing is solved twice."""
import time
import unittest

import numpy as np
from rt_testing import Listener, density_image, load_plugin, main
from scipy.optimize import linprog
from scipy.sparse import coo_matrix
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools

load_plugin()
import rectifiedtransport as rt  # noqa: E402, isort: skip

LINEAR_PROGRAMMES = 8


def image_of(values, origin=(0, 0, 0), spacing=(1, 1, 1)):
    values = np.asarray(values, dtype=float)
    image = density_image(values.shape[::-1], values=values.ravel())
    image.SetOrigin(*origin)
    image.SetSpacing(*spacing)
    return image


def centres(n):
    y, x = np.mgrid[0:n, 0:n]
    return (x + 0.5) / n, (y + 0.5) / n


def disks(n, places, radius=0.12, background=0.0):
    x, y = centres(n)
    inside = np.zeros((n, n))
    for a, b in places:
        inside = np.maximum(inside, np.hypot(x - a, y - b) < radius)
    return inside + background


def gaussians(n, places, width=0.05):
    x, y = centres(n)
    return sum(np.exp(-((x - a) ** 2 + (y - b) ** 2) / (2 * width ** 2)) for a, b in places)


def morph(source, target, **properties):
    filter_ = rt.vtkTransportInterpolator()
    filter_.SetInputData(0, source)
    filter_.SetInputData(1, target)
    return set_all(filter_, properties)


def barycenter(images, weights=(), **properties):
    filter_ = rt.vtkTransportBarycenter()
    for image in images:
        filter_.AddInputDataObject(image)
    for i, weight in enumerate(weights):
        filter_.SetWeight(i, weight)
    return set_all(filter_, properties)


def set_all(filter_, properties):
    for name, value in properties.items():
        getattr(filter_, "Set" + name)(value)
    return filter_


def fields(data):
    arrays = data.GetFieldData()
    return {arrays.GetArrayName(i): vtk_to_numpy(arrays.GetArray(i)).tolist()
            for i in range(arrays.GetNumberOfArrays()) if arrays.GetArray(i)}


def points(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def least_cost_of_cells(source, target):
    """Of a plan between cells, from centre to centre: the transport problem, by SciPy's HiGHS."""
    n = source.size
    y, x = np.divmod(np.arange(n), source.shape[1])
    cost = (x[:, None] - x[None, :]) ** 2 + (y[:, None] - y[None, :]) ** 2
    pair = np.arange(n * n)
    rows = np.concatenate([pair // n, n + pair % n])
    equations = coo_matrix((np.ones(2 * n * n), (rows, np.concatenate([pair, pair]))))
    masses = np.concatenate([source.ravel() / source.sum(), target.ravel() / target.sum()])
    solution = linprog(cost.ravel(), A_eq=equations.tocsr(), b_eq=masses, method="highs")
    assert solution.status == 0, solution.message
    return solution.fun


class OptimalBlends(unittest.TestCase):
    def sound(self, filter_):
        reported = Listener(filter_)
        filter_.Update()
        self.assertEqual((reported.errors, reported.warnings), ([], []))
        return filter_.GetDensity(), filter_.GetParticles()

    def test_what_stands_still_stays(self):
        n = 128
        pairs = {"void": (disks, 0.1), "gaussians": (gaussians, 0.1)}
        for name, (make, most) in pairs.items():
            still, away, there = (0.25, 0.25), (0.7, 0.7), (0.7, 0.45)
            filter_ = morph(image_of(make(n, (still, away))), image_of(make(n, (still, there))), Method=1)
            _, particles = self.sound(filter_)
            moves = np.linalg.norm(points(particles, "Displacement"), axis=1)
            start = points(particles, "SourcePosition")
            rest, moved = (np.hypot(start[:, 0] - x * n, start[:, 1] - y * n) < 0.12 * n
                           for x, y in (still, away))
            with self.subTest(name):
                self.assertLess(moves[rest].mean(), most)
                self.assertLess(np.quantile(moves[rest], 0.99), 0.1)
                self.assertAlmostEqual(moves[moved].mean(), 0.25 * n, delta=0.01 * n)
                flow = morph(filter_.GetInputDataObject(0, 0), filter_.GetInputDataObject(1, 0))
                _, others = self.sound(flow)
                others = np.linalg.norm(points(others, "Displacement"), axis=1)
                self.assertGreater(others[rest].mean(), 2.0)

    def test_bound_gap_and_slack(self):
        n = 64
        source = image_of(gaussians(n, ((0.3, 0.3), (0.7, 0.6))) + 0.02)
        target = image_of(gaussians(n, ((0.6, 0.2), (0.4, 0.8)), 0.08) + 0.02)
        _, best = self.sound(morph(source, target, Method=1))
        _, flow = self.sound(morph(source, target, Certify=1))
        for name, particles, most in (("best", best, 0.01), ("flow", flow, 1.0)):
            with self.subTest(name):
                found = fields(particles)
                cost, bound = found["TransportCost"][0], found["TransportCostLowerBound"][0]
                gap = found["OptimalityGap"][0]
                self.assertAlmostEqual(gap, max(0, cost / bound - 1), 12)
                self.assertLess(gap, most)
                slack = points(particles, "Slack")
                self.assertGreaterEqual(slack.min(), 0.0)
                self.assertAlmostEqual((bound + 2 * slack.mean()) / cost, 1, delta=0.03)
        self.assertGreater(fields(flow)["OptimalityGap"][0], 0.02)
        self.assertNotIn("Functional", fields(best))

    def test_linear_programmes(self):
        random = np.random.RandomState(3)
        for i in range(LINEAR_PROGRAMMES):
            n = 8 if i < 4 else 10
            source, target = random.rand(2, n, n)
            if i % 2 == 0:
                source[source < 0.4] = 0
                target[target < 0.4] = 0
            if i % 4 == 3:
                source[:] = 1
            exact = least_cost_of_cells(source, target)
            _, particles = self.sound(morph(image_of(source), image_of(target), Certify=1))
            bound = fields(particles)["TransportCostLowerBound"][0]
            with self.subTest(i):
                self.assertLessEqual(bound, exact * (1 + 1e-9))
                self.assertGreater(bound, exact - 0.45)

    def test_boxes_that_differ(self):
        values = gaussians(48, ((0.4, 0.4), (0.6, 0.7)), 0.1)
        source = image_of(values, spacing=(0.5, 0.5, 1))
        target = image_of(2 * values, origin=(30, 10, 0), spacing=(0.5, 0.5, 1))
        _, particles = self.sound(morph(source, target, Method=1))
        moves = points(particles, "Displacement")
        self.assertLess(np.abs(moves - (30, 10, 0)).mean(), 0.1)
        bound = fields(particles)["TransportCostLowerBound"][0]
        self.assertLessEqual(bound, 1000 * (1 + 1e-9))
        self.assertGreater(bound, 998)

    def test_equal_densities(self):
        image = image_of(gaussians(32, ((0.4, 0.4),), 0.2))
        for properties in (dict(Method=1), dict(Certify=1)):
            _, particles = self.sound(morph(image, image, **properties))
            found = fields(particles)
            self.assertEqual(found["TransportCostLowerBound"], [0.0])
            self.assertEqual(found["OptimalityGap"], [0.0])
            self.assertLess(np.abs(points(particles, "Displacement")).max(), 1e-12)

    def test_a_density_and_its_multiples(self):
        values = np.clip(np.random.default_rng(1).random((24, 24)) - 0.3, 0, 1)
        _, particles = self.sound(morph(image_of(values), image_of(3 * values), Method=1))
        self.assertLess(np.abs(points(particles, "Displacement")).max(), 1e-3)
        self.assertEqual(fields(particles)["OptimalityGap"], [0.0])
        images = [image_of(factor * values) for factor in (1, 2, 3)]
        _, particles = self.sound(barycenter(images, (1, 2, 1), Method=1))
        found = fields(particles)
        self.assertEqual(found["Functional"], [0.0])
        self.assertEqual(found["OptimalityGap"], [0.0])

    def test_functional_of_barycenters(self):
        n = 64
        shapes = [disks(n, ((0.3, 0.3), (0.7, 0.7))), disks(n, ((0.35, 0.6), (0.7, 0.3)), 0.15),
                  gaussians(n, ((0.5, 0.5),), 0.1)]
        images = [image_of(s) for s in shapes]
        _, particles = self.sound(barycenter(images, (1, 2, 1), Method=1, OptimalityTolerance=1e-4))
        found = fields(particles)
        functional = found["Functional"]
        self.assertGreaterEqual(len(functional), 2)
        self.assertTrue(all(a > b for a, b in zip(functional, functional[1:])), functional)
        self.assertLess(found["OptimalityGap"][0], 0.02)
        certified = barycenter(images, (1, 2, 1), Certify=1)
        certified.Update()  # which warns of particles that the flow leaves in voids
        flow = certified.GetParticles()
        self.assertNotIn("Functional", fields(flow))
        self.assertGreater(fields(flow)["OptimalityGap"][0], found["OptimalityGap"][0])
        for weights in ((0, 1, 0), (1, 0, 0)):
            density, particles = self.sound(
                barycenter(images, weights, Method=1, Kernel=0, ParticlesPerCell=4))
            values = vtk_to_numpy(density.GetCellData().GetScalars()).reshape(n, n)
            expected = shapes[weights.index(1)]
            error = np.abs(values - expected).sum() / expected.sum()
            with self.subTest(weights):
                self.assertLess(error, 0.25)
                self.assertEqual(fields(particles)["Functional"], [0.0])

    def test_barycenter_of_two_is_between(self):
        n = 80
        images = [image_of(disks(n, ((a, 0.5),))) for a in (0.25, 0.75)]
        density, _ = self.sound(barycenter(images, Method=1, Kernel=0))
        values = vtk_to_numpy(density.GetCellData().GetScalars()).reshape(n, n)
        expected = disks(n, ((0.5, 0.5),))
        self.assertLess(np.abs(values - expected).sum() / expected.sum(), 0.2)

    def test_nothing_is_solved_twice(self):
        n = 96
        filter_ = morph(image_of(gaussians(n, ((0.3, 0.3),))), image_of(gaussians(n, ((0.6, 0.7),))), Method=1)
        times = []
        for parameter in (0.2, 0.4, 0.6):
            filter_.SetParameter(parameter)
            begin = time.process_time()
            filter_.Update()
            times.append(time.process_time() - begin)
        self.assertLess(max(times[1:]), 0.5 * times[0])
        before = fields(filter_.GetParticles())
        filter_.SetOptimalityTolerance(1e-2)
        filter_.Update()
        self.assertLessEqual(fields(filter_.GetParticles())["TransportCostLowerBound"][0],
                             before["TransportCostLowerBound"][0] * (1 + 1e-6))
        filter_.SetMethod(0)
        filter_.Update()
        self.assertNotIn("TransportCostLowerBound", fields(filter_.GetParticles()))
        self.assertIsNone(filter_.GetParticles().GetPointData().GetArray("Slack"))

    def test_threads_and_volumes(self):
        n = 20
        axis = (np.arange(n) + 0.5) / n
        z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
        make = lambda a, b: image_of(  # noqa: E731
            0.05 + np.exp(-30 * ((x - a) ** 2 + (y - b) ** 2 + (z - a) ** 2)))
        results = []
        for threads in (1, 2):
            vtkSMPTools.Initialize(threads)
            _, particles = self.sound(morph(make(0.3, 0.4), make(0.7, 0.5), Method=1))
            results.append((points(particles, "TargetPosition").tobytes(), fields(particles)))
        self.assertEqual(*results)
        self.assertLess(results[0][1]["OptimalityGap"][0], 0.03)

    def test_wrong_inputs(self):
        good = image_of(gaussians(16, ((0.4, 0.4),)))
        bad = gaussians(16, ((0.4, 0.4),))
        bad[3, 4] = np.nan
        for target in (image_of(bad), image_of(np.zeros((16, 16)))):
            filter_ = morph(good, target, Method=1)
            reported = Listener(filter_)
            filter_.Update()
            self.assertEqual(len(reported.errors), 1, reported.errors)
            self.assertIn("Target", reported.errors[0])
        filter_ = morph(good, good, Method=1, OptimalityTolerance=0.0)
        reported = Listener(filter_)
        filter_.Update()
        self.assertIn("OptimalityTolerance", reported.errors[0])


if __name__ == "__main__":
    main()

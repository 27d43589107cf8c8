# SPDX-License-Identifier: BSD-3-Clause
"""The tables are built anew when the density changes, and only then."""
import unittest

import numpy as np
from rt_testing import density_image, digest, main, points_in

from rectifiedtransport import (vtkBlueNoiseRelaxation, vtkDensityEqualizingWarp, vtkTransportMap,
                                vtkTransportQuality, vtkTransportSampler, vtkUniformSeedSource)


class Caching(unittest.TestCase):
    def setUp(self):
        self.image = density_image((40, 30))
        self.sampler = vtkTransportSampler()
        self.sampler.SetInputData(self.image)
        self.sampler.SetNumberOfParticles(300)
        self.sampler.Update()
        self.built = self.sampler.GetTableBuildTime()
        self.before = digest(self.sampler.GetOutput())

    def assert_kept(self):
        self.sampler.Update()
        self.assertEqual(self.sampler.GetTableBuildTime(), self.built)
        self.assertNotEqual(digest(self.sampler.GetOutput()), self.before)

    def assert_rebuilt(self):
        self.sampler.Update()
        self.assertGreater(self.sampler.GetTableBuildTime(), self.built)
        self.assertNotEqual(digest(self.sampler.GetOutput()), self.before)

    def test_nothing_changed(self):
        self.sampler.Update()
        self.assertEqual(digest(self.sampler.GetOutput()), self.before)
        self.assertEqual(self.sampler.GetTableBuildTime(), self.built)

    def test_flow_time(self):
        self.sampler.SetFlowTime(0.5)
        self.assert_kept()

    def test_pattern(self):
        self.sampler.SetSeedPatternToJittered()
        self.assert_kept()

    def test_number(self):
        self.sampler.SetNumberOfParticles(301)
        self.assert_kept()

    def test_random_seed(self):
        self.sampler.SetRandomSeed(2)
        self.assert_kept()

    def test_steps(self):
        self.sampler.SetNumberOfSteps(16)
        self.assert_kept()

    def test_seeds(self):
        seeds = vtkUniformSeedSource()
        seeds.SetBounds(0, 20, 0, 60, 0, 0)
        self.sampler.SetSeedsConnection(seeds.GetOutputPort())
        self.assert_kept()
        self.before = digest(self.sampler.GetOutput())
        seeds.SetRandomSeed(2)
        self.assert_kept()

    def test_values(self):
        array = self.image.GetCellData().GetScalars()
        array.SetValue(7, 100)
        array.Modified()
        self.image.Modified()
        self.assert_rebuilt()

    def test_invert(self):
        self.sampler.InvertDensityOn()
        self.assert_rebuilt()

    def test_array(self):
        other = density_image((40, 30), seed=1).GetCellData().GetScalars()
        other.SetName("Other")
        self.image.GetCellData().AddArray(other)
        self.sampler.SetInputArrayToProcess(0, 0, 0, 1, "Other")
        self.assert_rebuilt()

    def test_image(self):
        self.sampler.SetInputData(density_image((40, 30), seed=1))
        self.assert_rebuilt()

    def test_kept_result_is_a_fresh_one(self):
        self.sampler.SetFlowTime(0.5)
        self.sampler.Update()
        fresh = vtkTransportSampler()
        fresh.SetInputData(self.image)
        fresh.SetNumberOfParticles(300)
        fresh.SetFlowTime(0.5)
        fresh.Update()
        self.assertEqual(digest(self.sampler.GetOutput()), digest(fresh.GetOutput()))

    def test_times_lie_on_one_path(self):
        self.sampler.SetFlowTime(0)
        self.sampler.Update()
        moved = self.sampler.GetOutput().GetPointData().GetArray("Displacement")
        self.assertEqual(np.abs(moved.GetRange(-1)).max(), 0)


class OtherFilters(unittest.TestCase):
    """The filters that keep tables beside the sampler; each on the port of its density."""

    KEPT = {
        vtkTransportMap: [
            lambda f: f.SetDirectionToDensityToUniform(),
            lambda f: f.SetSampleDimensions(7, 90, 1),
            lambda f: f.SetNumberOfSteps(16),
            lambda f: f.SetIntegratorToAdaptive(),
        ],
        vtkDensityEqualizingWarp: [
            lambda f: f.SetBlend(0.5),
            lambda f: f.SetTableLookupToNearest(),
            lambda f: f.SetInputData(0, points_in(f.GetInputDataObject(1, 0), seed=4)),
            lambda f: f.SetInputData(0, density_sampler(f).GetOutput()),
        ],
        vtkTransportQuality: [
            lambda f: f.SetBlockSize(3),
            lambda f: f.SetInputData(0, points_in(f.GetInputDataObject(1, 0), seed=4)),
        ],
        vtkBlueNoiseRelaxation: [
            lambda f: f.SetMaximumIterations(3),
            lambda f: f.SetInputData(0, points_in(f.GetInputDataObject(1, 0), seed=4)),
        ],
    }

    def check(self, kind, port):
        image = density_image((40, 30))
        algorithm = kind()
        if port == 1:
            algorithm.SetInputData(0, points_in(image))
        algorithm.SetInputData(port, image)

        def run():
            algorithm.Update()
            return algorithm.GetTableBuildTime(), digest(algorithm.GetOutput())

        built, before = run()
        self.assertGreater(built, 0)
        self.assertEqual(run(), (built, before))
        for change in self.KEPT[kind]:
            change(algorithm)
            now, after = run()
            self.assertEqual(now, built)
            self.assertNotEqual(after, before)
            before = after
        # The image alone is new, its values are not.
        image.Modified()
        self.assertEqual(run()[0], built)
        # What a kept table gives is what a new one gives.
        array = image.GetCellData().GetScalars()
        value = array.GetValue(7)
        array.SetValue(7, 50)
        array.Modified()
        self.assertGreater(run()[0], built)
        array.SetValue(7, value)
        array.Modified()
        rebuilt, after = run()
        self.assertGreater(rebuilt, built)
        self.assertEqual(after, before)
        # Modified() without a change costs a comparison of the values.
        array.Modified()
        self.assertEqual(run(), (rebuilt, before))
        array.SetValue(7, 100)
        array.Modified()
        last, after = run()
        self.assertGreater(last, rebuilt)
        self.assertNotEqual(after, before)
        algorithm.SetInputData(port, density_image((30, 40), seed=1))
        self.assertGreater(run()[0], last)

    def test_map(self):
        self.check(vtkTransportMap, 0)

    def test_warp(self):
        self.check(vtkDensityEqualizingWarp, 1)

    def test_quality(self):
        self.check(vtkTransportQuality, 1)

    def test_relaxation(self):
        self.check(vtkBlueNoiseRelaxation, 1)


def density_sampler(filter_of_two):
    """Particles of the density of a filter's second input."""
    sampler = vtkTransportSampler()
    sampler.SetInputData(filter_of_two.GetInputDataObject(1, 0))
    sampler.SetNumberOfParticles(100)
    sampler.Update()
    return sampler


if __name__ == "__main__":
    main()

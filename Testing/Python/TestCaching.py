# SPDX-License-Identifier: BSD-3-Clause
"""The tables are built anew when the density changes, and only then."""
import unittest

import numpy as np
from rt_testing import density_image, digest, main

from rectifiedtransport import vtkTransportSampler, vtkUniformSeedSource


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


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""The package rectifiedtransport in Python, without ParaView."""
import re
import unittest

import numpy as np
from rt_testing import density_image, main, positions
from vtkmodules.util.numpy_support import vtk_to_numpy

import rectifiedtransport
from rectifiedtransport import vtkTransportSampler, vtkUniformSeedSource


def has_text(wrapped, method):
    """Whether the documentation of a method is more than its signatures."""
    text = getattr(wrapped, method).__doc__
    return bool(re.sub(r"^(C\+\+: .*|%s\(.*)$" % method, "", text, flags=re.MULTILINE).strip())


class Wrapping(unittest.TestCase):
    def test_version(self):
        self.assertRegex(rectifiedtransport.__version__, r"^\d+\.\d+\.\d+$")

    def test_only_what_is_public(self):
        classes = {name for name in dir(rectifiedtransport) if name.startswith("vtk")}
        self.assertLessEqual(
            {"vtkTransportMap", "vtkTransportSampler", "vtkUniformSeedSource"}, classes)
        self.assertFalse([name for name in dir(rectifiedtransport) if "Bridge" in name])

    def test_abstract_classes_have_no_instances(self):
        for base in (rectifiedtransport.vtkDensityAlgorithm,
                     rectifiedtransport.vtkDiskAlgorithm,
                     rectifiedtransport.vtkFlowAlgorithm,
                     rectifiedtransport.vtkTransportAlgorithm):
            with self.assertRaises((TypeError, NotImplementedError)):
                base()

    def test_setters_have_text(self):
        """Help() says what a setter does, or of SetMethodToEuler what SetMethod does."""
        for name in (name for name in dir(rectifiedtransport) if name.startswith("vtk")):
            wrapped = getattr(rectifiedtransport, name)
            for setter in (setter for setter in vars(wrapped) if setter.startswith("Set")):
                with self.subTest("%s.%s" % (name, setter)):
                    described = setter if has_text(wrapped, setter) else \
                        re.sub("To[A-Z].*", "", setter)
                    self.assertTrue(has_text(wrapped, described))

    def test_source_feeds_sampler(self):
        seeds = vtkUniformSeedSource()
        seeds.SetBounds(0, 6, 0, 20, 0, 0)
        seeds.SetNumberOfPoints(200)
        sampler = vtkTransportSampler()
        sampler.SetInputData(density_image())
        sampler.SetSeedsConnection(seeds.GetOutputPort())
        sampler.Update()
        particles = sampler.GetOutput()
        self.assertEqual(particles.GetNumberOfPoints(), 200)
        start = vtk_to_numpy(particles.GetPointData().GetArray("SeedPosition"))
        np.testing.assert_array_equal(start, positions(seeds.GetOutput()))
        moved = vtk_to_numpy(particles.GetPointData().GetArray("Displacement"))
        np.testing.assert_allclose(positions(particles), start + moved, atol=1e-12)


if __name__ == "__main__":
    main()

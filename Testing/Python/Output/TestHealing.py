# SPDX-License-Identifier: BSD-3-Clause
"""A view shows a filter again once its error is corrected, and what is made of it; meanwhile nothing."""
import unittest

from rt_filters import FILTERS, by_label
from rt_testing import density_image, load_plugin, main, need_display, producer

simple = load_plugin()


def image():
    return producer(simple, density_image((12, 10)))


SOURCES = {"density": image, "densities": lambda: [image(), image()], "image": image,
           "mesh": lambda: simple.UniformSeeds(Bounds=[0, 12, 0, 10, 0, 0], NumberOfPoints=40),
           "points": lambda: simple.UniformSeeds(Bounds=[0, 12, 0, 10, 0, 0], NumberOfPoints=40),
           "solid": simple.Sphere, "disk": simple.Plane,
           "map": lambda: simple.Calculator(Input=simple.Plane(), AttributeType="Cell Data",
                                            ResultArrayName="Mass", Function="3")}


class Healing(unittest.TestCase):
    def setUp(self):
        self.view = simple.CreateView("RenderView", ViewSize=[64, 64])
        self.addCleanup(simple.Delete, self.view)

    def sizes(self, chain):
        simple.Render(self.view)
        return [source.GetDataInformation().GetNumberOfPoints() > 0 for source in chain]

    def check(self, chain, refused):
        """The last of the chain alone is shown."""
        name, wrong, right = refused
        simple.Show(chain[-1], self.view)
        every = [True] * len(chain)
        self.assertEqual(self.sizes(chain), every)
        for _ in range(2):
            setattr(chain[0], name, wrong)
            self.assertEqual(self.sizes(chain), [False] * len(chain))
            setattr(chain[0], name, right)
            self.assertEqual(self.sizes(chain), every)
        simple.Hide(chain[-1], self.view)

    def test_chains(self):
        for filter_ in FILTERS:
            if filter_.gives_table:
                continue
            with self.subTest(filter_.label):
                made = filter_.make(simple, SOURCES)
                second = simple.Calculator(made, Function="1")
                self.check([made, second], filter_.refused)
                self.check([made, second, simple.Calculator(second, Function="2")], filter_.refused)

    def test_filters_of_filters(self):
        density = image()
        sampler = simple.SampleDensity(density, NumberOfParticles=60)
        relaxed = simple.RelaxBlueNoise(sampler, Density=density, MaximumIterations=1)
        splat = simple.SplatMass(relaxed, Dimensions=[9, 9, 1])
        refused = ("NumberOfParticles", 0, 50)
        self.check([sampler, relaxed], refused)
        self.check([sampler, relaxed, splat], by_label("Sample Density").refused)


if __name__ == "__main__":
    need_display()
    main()

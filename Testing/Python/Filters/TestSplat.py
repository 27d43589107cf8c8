# SPDX-License-Identifier: BSD-3-Clause
"""Splat Mass in ParaView: mass by ParaView's own integral, arrays to choose, the reference."""
import os
import tempfile
import unittest

import numpy as np
from rt_testing import (OUTPUT, Listener, density_image, load_plugin, main, output_of, points_in,
                        producer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

simple = load_plugin()


def cloud(number=400, masses=True):
    """Points in the bounds of a volume, with an array Weight and vectors beside it."""
    points = points_in(density_image((6, 5, 4)), number)
    if masses:
        random = np.random.default_rng(1)
        for name, values in (("Weight", random.random(number)),
                             ("Way", random.random((number, 3)))):
            array = numpy_to_vtk(values, deep=1)
            array.SetName(name)
            points.GetPointData().AddArray(array)
    return points


def weight_of(points):
    return vtk_to_numpy(points.GetPointData().GetArray("Weight")).sum()


def values_of(splat):
    output = output_of(splat)
    owner = output.GetPointData() if splat.Association == "Points" else output.GetCellData()
    return vtk_to_numpy(owner.GetScalars())


def total(splat):
    return output_of(splat).GetFieldData().GetArray("TotalMass").GetValue(0)


class Splat(unittest.TestCase):
    def test_mass_is_paraviews_integral(self):
        points = cloud()
        for kernel in ("CloudInCell", "NearestCell", "TriangularShapedCloud", "Gaussian"):
            splat = simple.SplatMass(Input=producer(simple, points), Association="Cells",
                                     Dimensions=[9, 8, 7], Kernel=kernel,
                                     MassArray=["POINTS", "Weight"])
            integral = output_of(simple.IntegrateVariables(Input=splat))
            mass = integral.GetCellData().GetArray("Density").GetValue(0)
            self.assertAlmostEqual(mass / weight_of(points), 1, delta=1e-12)
            self.assertAlmostEqual(total(splat) / weight_of(points), 1, delta=1e-12)

    def test_no_mass_array_is_chosen_by_itself(self):
        """Whatever arrays there are, and whether or not the points have been made before."""
        image = producer(simple, density_image((6, 5, 4)))
        for updated in (True, False):
            for make, count in ((lambda: simple.SampleDensity(image, NumberOfParticles=100), 100),
                                (lambda: producer(simple, cloud()), 400),
                                (lambda: producer(simple, cloud(masses=False)), 400)):
                points = make()
                if updated:
                    points.UpdatePipeline()
                splat = simple.SplatMass(Input=points, Dimensions=[4, 4, 4])
                self.assertEqual(list(splat.MassArray), ["POINTS", "None"])
                points.UpdatePipeline()
                self.assertEqual(list(splat.MassArray), ["POINTS", "None"])
                reported = Listener(splat.GetClientSideObject())
                self.assertAlmostEqual(total(splat), count, delta=1e-9)
                self.assertEqual(reported.errors, [])

    def test_masses_of_a_sampled_density(self):
        image = producer(simple, density_image((6, 5, 4)))
        for updated in (True, False):
            dots = simple.SampleDensity(image, NumberOfParticles=100)
            if updated:
                dots.UpdatePipeline()
            splat = simple.SplatMass(dots, Dimensions=[4, 4, 4], MassArray=["POINTS", "Mass"])
            mass = output_of(dots).GetFieldData().GetArray("TotalMass").GetValue(0)
            self.assertAlmostEqual(total(splat) / mass, 1, delta=1e-12)

    def test_a_choice_of_no_mass_is_kept(self):
        """In a script, and in a state, as those of before the default have it."""
        image = simple.Wavelet(WholeExtent=[0, 5, 0, 5, 0, 5])
        dots = simple.SampleDensity(image, NegativeValues="Clamp", NumberOfParticles=100)
        splat = simple.SplatMass(dots, Dimensions=[4, 4, 4], MassArray=["POINTS", "None"],
                                 registrationName="Splat")
        self.assertAlmostEqual(total(splat), 100, delta=1e-9)
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            simple.ResetSession()
            simple.LoadState(path)
        loaded = simple.FindSource("Splat")
        self.assertEqual(loaded.MassArray[1], "None")
        self.assertAlmostEqual(total(loaded), 100, delta=1e-9)

    def test_mass_arrays_to_choose_have_one_component(self):
        splat = simple.SplatMass(Input=producer(simple, cloud()))
        domain = splat.GetProperty("MassArray").GetDomain("array_list")
        names = [domain.GetString(i) for i in range(domain.GetNumberOfStrings())]
        self.assertEqual(names, ["None", "Weight"])

    def test_automatic_dimensions(self):
        """About as many cells as points, nearly cubes, at most 128 an axis."""
        for number in (30, 5000):
            splat = simple.SplatMass(Input=producer(simple, points_in(density_image((60, 50, 40)), number)))
            image = output_of(splat)
            self.assertAlmostEqual(np.prod(image.GetDimensions()) / number, 1, delta=.4)
            self.assertLess(max(image.GetSpacing()) / min(image.GetSpacing()), 1.4)
        splat = simple.SplatMass(Input=producer(simple, points_in(density_image((60, 3)), 40000)))
        self.assertEqual(max(output_of(splat).GetDimensions()), 128)

    def test_reference_can_be_taken_away(self):
        points = producer(simple, cloud())
        image = density_image((6, 5, 4))
        splat = simple.SplatMass(Input=points, Reference=producer(simple, image),
                                 Dimensions=[3, 3, 3])
        self.assertEqual(output_of(splat).GetDimensions(), image.GetDimensions())
        splat.Reference = None
        self.assertEqual(output_of(splat).GetDimensions(), (3, 3, 3))
        self.assertAlmostEqual(total(splat), 400, delta=1e-9)

    def test_contour(self):
        splat = simple.SplatMass(Input=producer(simple, cloud(5000)), Dimensions=[20, 20, 20],
                                 Kernel="Gaussian", Radius=2)
        middle = 0.5 * (values_of(splat).min() + values_of(splat).max())
        contour = simple.Contour(Input=splat, Isosurfaces=[middle])
        self.assertEqual(contour.ContourBy[1], "Density")
        self.assertGreater(output_of(contour).GetNumberOfCells(), 10)

    def test_splat_of_the_particles_of_a_density(self):
        """Blocks of the splat hold the mass of the density's blocks."""
        values = np.zeros((40, 40))
        values[:20, 10:] = 2
        values[25:, 25:] = 7
        image = producer(simple, density_image((40, 40), values=values.ravel()))
        dots = simple.SampleDensity(Input=image, NumberOfParticles=50000)
        # Wider kernels carry mass over the edges of the shape.
        splat = simple.SplatMass(Input=dots, Reference=image, Association="Cells",
                                 MassArray=["POINTS", "Mass"], Kernel="NearestCell")
        found = values_of(splat).reshape(8, 5, 8, 5).mean(axis=(1, 3))
        wanted = values.reshape(8, 5, 8, 5).mean(axis=(1, 3))
        self.assertLess(np.abs(found - wanted).max(), 0.05)
        self.assertAlmostEqual(total(splat), values.sum(), delta=1e-6)

    def test_blocks_of_a_pipeline(self):
        """ParaView's executive goes through blocks one by one, and through changed ones again."""
        spheres = [simple.Sphere(Center=[3 * i, 0, 0]) for i in range(2)]
        blocks = simple.GroupDatasets(Input=spheres)
        for proxy in (simple.SplatMass(Input=blocks, Dimensions=[4, 4, 4]),
                      simple.SolidDensity(Input=blocks, Resolution=8)):
            reported = Listener(proxy.GetClientSideObject())
            ends = []
            for radius in (0.5, 1):
                spheres[0].Radius = radius
                proxy.UpdatePipeline()
                ends.append(proxy.GetDataInformation().GetBounds()[4])
            self.assertAlmostEqual(ends[1] / ends[0], 2, delta=1e-6)
            self.assertEqual(reported.errors, [])
            spheres[0].Radius = 0.5

    def test_dimension(self):
        splat = simple.SplatMass(Input=simple.Plane(), Dimensions=[5, 6, 7])
        self.assertEqual(output_of(splat).GetDimensions(), (5, 6, 1))
        self.assertAlmostEqual(values_of(splat).sum() / 30, 4, delta=1e-12)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""What Show gives of an output that is shown for the first time: the representation and the colours."""
import os
import tempfile
import unittest

from rt_testing import (OUTPUT, density_image, load_plugin, main, need_display, points_in,
                        producer)

simple = load_plugin()


class FirstDisplay(unittest.TestCase):
    def setUp(self):
        self.view = simple.CreateView("RenderView")
        self.addCleanup(simple.Delete, self.view)

    def shown(self, source, port=0):
        source.UpdatePipeline()
        return simple.Show(simple.OutputPort(source, port), self.view)

    def assert_like(self, representation, kind, array):
        self.assertEqual(representation.Representation, kind)
        self.assertEqual(representation.ColorArrayName[1], array)

    @staticmethod
    def image(dimension):
        return producer(simple, density_image((9, 8, 7)[:dimension]))

    def test_map_is_coloured_by_displacement(self):
        for dimension, kind in ((2, "Slice"), (3, "Surface")):
            with self.subTest(dimension=dimension):
                shown = self.shown(simple.TransportMap(self.image(dimension)))
                self.assert_like(shown, kind, "Displacement")

    def test_densities_in_space_are_volumes(self):
        for dimension, kind in ((2, "Slice"), (3, "Volume")):
            image = self.image(dimension)
            dots = simple.SampleDensity(image, NumberOfParticles=100)
            for source in (simple.MorphDensities(image, Target=image),
                           simple.DensityBarycenter(Input=[image, image]),
                           simple.SplatMass(dots, Dimensions=[9, 8, 7])):
                with self.subTest(dimension=dimension, filter=source.GetXMLLabel()):
                    self.assert_like(self.shown(source), kind, "Density")

    def test_solid_is_a_volume(self):
        solid = simple.SolidDensity(simple.Sphere(), Resolution=12)
        self.assert_like(self.shown(solid), "Volume", "Density")

    def test_paths_are_lines(self):
        sampler = simple.SampleDensity(self.image(2), NumberOfParticles=20, OutputPaths=1)
        self.assert_like(self.shown(sampler), "Wireframe", "Time")

    def test_paths_are_followed(self):
        """Lines as soon as there are paths, and dots again after, as long as nobody chose another."""
        sampler = simple.SampleDensity(self.image(2), NumberOfParticles=20)
        shown = self.shown(sampler)
        self.assertEqual(shown.Representation, "Point Gaussian")
        sampler.OutputPaths = 1
        sampler.UpdatePipeline()
        self.assert_like(shown, "Wireframe", "Time")
        sampler.OutputPaths = 0
        sampler.UpdatePipeline()
        self.assertEqual(shown.Representation, "Point Gaussian")
        self.assertNotEqual(shown.ColorArrayName[1], "Time")
        shown.Representation = "Points"
        sampler.OutputPaths = 1
        sampler.UpdatePipeline()
        self.assertEqual(shown.Representation, "Points")

    def test_cells_differ_from_their_neighbours(self):
        for dimension in (2, 3):
            with self.subTest(dimension=dimension):
                seeds = simple.UniformSeeds(NumberOfPoints=20, Dimension=dimension)
                cells = simple.EqualMassCells(seeds, Resolution=24)
                labels = self.shown(cells)
                self.assert_like(labels, "Surface", "SiteColor")
                table = simple.GetColorTransferFunction("SiteColor")
                self.assertEqual(table.InterpretValuesAsCategories, 1)
                highest = cells.CellData["SiteColor"].GetRange()[1]
                self.assertEqual(list(table.Annotations[::2]),
                                 [str(i) for i in range(int(highest) + 1)])
                self.assertEqual(cells[0].CellData.GetArray("SiteColor").GetNumberOfComponents(), 1)
                self.assertIn("SiteId", cells[0].CellData.keys())
                outlines = self.shown(cells, 2)
                self.assert_like(outlines, "Feature Edges" if dimension == 3 else "Surface", "")
                self.assertEqual(list(outlines.AmbientColor), [0, 0, 0])

    def test_a_choice_is_kept(self):
        """Only what is shown for the first time is set up."""
        source = simple.TransportMap(self.image(3))
        shown = self.shown(source)
        shown.Representation = "Outline"
        simple.ColorBy(shown, ("CELLS", "Divergence"))
        simple.Hide(source, self.view)
        self.assertIs(self.shown(source).SMProxy, shown.SMProxy)
        self.assert_like(shown, "Outline", "Divergence")

    def test_a_state_is_kept(self):
        volume = simple.Wavelet(WholeExtent=[0, 5, 0, 5, 0, 5])
        source = simple.TransportMap(volume, registrationName="Map")
        simple.ColorBy(self.shown(source), ("POINTS", "JacobianDeterminant"))
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            simple.ResetSession()
            simple.LoadState(path)
        self.view = simple.GetViews()[0]
        self.assert_like(simple.GetRepresentation(simple.FindSource("Map"), self.view),
                         "Surface", "JacobianDeterminant")

    def test_other_sources_are_shown_as_before(self):
        self.assertEqual(self.shown(simple.Wavelet()).Representation, "Outline")

    def test_views_of_other_kinds(self):
        points = producer(simple, points_in(density_image((5, 4)), 10))
        quality = simple.TransportQuality(points, Density=self.image(2))
        quality.UpdatePipeline()
        self.assertIsNotNone(simple.Show(quality, simple.CreateView("SpreadSheetView")))


if __name__ == "__main__":
    need_display()
    main()

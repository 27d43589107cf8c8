# SPDX-License-Identifier: BSD-3-Clause
"""What Show gives of an output that is shown for the first time: the representation and the colours."""
import os
import subprocess
import tempfile
import unittest

import numpy as np
from PIL import Image
from rt_checkerboard import (RECTANGLE, SQUARE, is_checkered, look_at, parameterized, picture,
                             tones)
from rt_testing import (OUTPUT, SOURCE, Listener, density_image, load_plugin, main, need_display, points_in,
                        producer)

OPENS = os.path.join(os.path.dirname(__file__), "checkerboard_script.py")
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

    def test_map_to_a_target_is_coloured_by_its_cost(self):
        """Also where the target is chosen later, and on points as on cells."""
        for shape, kind in (((9, 8), "Slice"), ((9, 8, 7), "Surface")):
            for cells in (True, False):
                image, target = (producer(simple, density_image(shape, cells=cells, seed=seed)) for seed in (1, 2))
                source = simple.TransportMap(image)
                shown = self.shown(source)
                for given, array in ((target, "CostDensity"), (None, "Displacement"), (target, "CostDensity")):
                    with self.subTest(shape=shape, cells=cells, array=array):
                        source.Target = given
                        source.UpdatePipeline()
                        self.assert_like(shown, kind, array)
                        other = simple.TransportMap(image, Target=given)
                        self.assert_like(self.shown(other), kind, array)

    def test_densities_in_space_are_volumes(self):
        for dimension, kind in ((2, "Slice"), (3, "Volume")):
            image = self.image(dimension)
            dots = simple.SampleDensity(image, NumberOfParticles=100)
            for source in (simple.MorphDensities(image, Target=image),
                           simple.DensityBarycenter(Input=[image, image]),
                           simple.SplatMass(dots, Dimensions=[9, 8, 7])):
                with self.subTest(dimension=dimension, filter=source.GetXMLLabel()):
                    self.assert_like(self.shown(source), kind, "Density")
            image = simple.Wavelet(WholeExtent=[0, 9, 0, 8, 0, 7 if dimension == 3 else 0])
            for blend in (simple.MorphDensities(image, Target=image, NegativeValues="Clamp"),
                          simple.DensityBarycenter(Input=[image, image], NegativeValues="Clamp")):
                self.assert_like(self.shown(blend), kind, "RTData")

    def test_series_in_space_is_a_volume(self):
        for dimension, kind in ((2, "Slice"), (3, "Volume")):
            with self.subTest(dimension=dimension):
                self.assert_like(self.shown(simple.TransportTemporalInterpolator(self.image(dimension))), kind,
                                 "Density")

    def test_distances_are_a_scatter_plot(self):
        """The points of the densities, one axis over the other, and nothing else of the table."""
        inputs = [producer(simple, density_image((12, 10), seed=seed)) for seed in range(4)]
        distances = simple.TransportDistance(Input=inputs)
        distances.UpdatePipeline()
        chart = simple.CreateView("XYPointChartView")
        self.addCleanup(simple.Delete, chart)
        shown = simple.Show(simple.OutputPort(distances, 2), chart)
        self.assertEqual(shown.UseIndexForXAxis, 0)
        self.assertEqual(shown.XArrayName, "Coordinate0")
        self.assertEqual(list(shown.SeriesVisibility), ["Coordinate1"])
        self.assertEqual((chart.BottomAxisTitle, chart.LeftAxisTitle), ("Coordinate0", "Coordinate1"))
        bounds = simple.Show(simple.OutputPort(distances, 1), chart)
        self.assertEqual(bounds.UseIndexForXAxis, 1)

    def test_solid_is_a_volume(self):
        solid = simple.SolidDensity(simple.Sphere(), Resolution=12)
        self.assert_like(self.shown(solid), "Volume", "Density")

    def picture(self):
        """The view's pixels, as rows of RGB."""
        path = os.path.join(OUTPUT, "first-display.png")
        simple.SaveScreenshot(path, self.view, ImageResolution=[600, 450])
        with Image.open(path) as image:
            return np.asarray(image.convert("RGB")).astype(float)

    def background(self, colour):
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [colour] * 3

    def photograph(self, **properties):
        path = os.path.join(SOURCE, "Testing", "Data", "raccoon.png")
        return simple.SampleDensity(simple.PNGSeriesReader(FileNames=[path]), InvertDensity=1,
                                    **properties)

    def test_flat_particles_are_a_picture_at_once(self):
        """Plain circles, dark on light and light on dark, as large as is right for the ink: the picture
        has the tones of the photograph. That follows the background."""
        self.view.OrientationAxesVisibility = 0
        self.background(1)
        sampler = self.photograph()
        shown = self.shown(sampler)
        self.assert_like(shown, "Point Gaussian", "")
        self.assertEqual(shown.ShaderPreset, "Plain circle")
        self.view.CameraParallelProjection = 1
        simple.ResetCamera(self.view)
        low, high = (np.array(sampler.GetDataInformation().GetBounds()).reshape(3, 2)[:2].T)
        self.view.CameraFocalPoint = [*(low + high) / 2, 0]
        self.view.CameraPosition = [*(low + high) / 2, 1000]
        self.view.CameraParallelScale = (high - low)[1] / 2
        dark = 1 - self.picture().mean(axis=2) / 255
        with Image.open(os.path.join(SOURCE, "Testing", "Data", "raccoon.png")) as image:
            ink = 1 - np.asarray(image.convert("L").resize((600, 450))).astype(float) / 255

        def blocks(values):
            return values.reshape(15, 30, 20, 30).mean(axis=(1, 3)).ravel()
        self.assertGreater(np.corrcoef(blocks(dark), blocks(ink))[0, 1], 0.98)
        self.assertAlmostEqual(dark.mean() / ink.mean(), 0.75, delta=0.1)
        self.background(0)
        light = self.picture().mean(axis=2) / 255
        self.assertLess(np.abs(light - dark).mean(), 0.02)
        self.background(1)
        self.assertLess(np.abs(1 - self.picture().mean(axis=2) / 255 - dark).mean(), 0.01)

    def test_palette_is_followed(self):
        shown = self.shown(self.photograph(NumberOfParticles=100))
        for palette, colour in (("WhiteBackground", 0), ("BlackBackground", 1), ("BlueGrayBackground", 1)):
            simple.LoadPalette(palette)
            self.assertEqual(list(shown.DiffuseColor), [colour] * 3, palette)
            self.assertEqual(list(shown.AmbientColor), [colour] * 3, palette)
        shown.DiffuseColor = shown.AmbientColor = [1, 0, 0]
        simple.LoadPalette("WhiteBackground")
        self.assertEqual(list(shown.DiffuseColor), [1, 0, 0])
        simple.LoadPalette("BlueGrayBackground")

    def test_colours_of_a_state(self):
        """Black dots on white, as they were when the state was saved under another palette than the first."""
        simple.LoadPalette("BlueGrayBackground")
        shown = self.shown(self.photograph(NumberOfParticles=100, registrationName="Dots"))
        self.assertEqual(list(shown.DiffuseColor), [1] * 3)
        simple.LoadPalette("WhiteBackground")
        self.assertEqual(list(shown.DiffuseColor), [0] * 3)
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            simple.ResetSession()
            simple.LoadState(path)
        self.view = simple.GetViews()[0]
        shown = simple.GetRepresentation(simple.FindSource("Dots"), self.view)
        self.assertEqual([*shown.DiffuseColor, *shown.AmbientColor], [0] * 6)
        simple.LoadPalette("BlueGrayBackground")

    def test_radius_follows_the_spacing(self):
        """Half the distance of neighbours, again where there are others; not that of a user."""
        seeds = simple.UniformSeeds(Bounds=[0, 8, 0, 8, 0, 0], NumberOfPoints=64, Pattern="Lattice")
        shown = self.shown(seeds)
        self.assertAlmostEqual(shown.GaussianRadius, 0.5)
        seeds.NumberOfPoints = 1024
        seeds.UpdatePipeline()
        self.assertAlmostEqual(shown.GaussianRadius, 0.125)
        seeds.Bounds = [0, 80, 0, 80, 0, 0]
        seeds.UpdatePipeline()
        self.assertAlmostEqual(shown.GaussianRadius, 1.25)
        shown.GaussianRadius = 0.7
        seeds.NumberOfPoints = 64
        seeds.UpdatePipeline()
        self.assertEqual(shown.GaussianRadius, 0.7)

    def test_radius_follows_the_points(self):
        sampler = self.photograph(NumberOfParticles=500)
        relaxed = simple.RelaxBlueNoise(sampler, Density=sampler.Input, MaximumIterations=2)
        shown = self.shown(relaxed)
        before = shown.GaussianRadius
        for filter_ in sampler, relaxed:
            filter_.InvertDensity = 0
        relaxed.UpdatePipeline()
        other = simple.CreateView("RenderView")
        self.addCleanup(simple.Delete, other)
        self.assertNotEqual(shown.GaussianRadius, before)
        self.assertEqual(shown.GaussianRadius, simple.Show(relaxed, other).GaussianRadius)

    def test_particles_in_space_are_spheres(self):
        shown = self.shown(simple.UniformSeeds(Dimension=3, NumberOfPoints=512, Pattern="Lattice"))
        self.assert_like(shown, "Point Gaussian", "")
        self.assertEqual(shown.ShaderPreset, "Sphere")
        self.assertAlmostEqual(shown.GaussianRadius, 1 / 16)

    def test_particles_without_a_spacing(self):
        """One alone, all at one place, none: each is shown without an error."""
        for count in (1, 5, 0):
            points = points_in(density_image((5, 4)), count)
            for i in range(count):
                points.GetPoints().SetPoint(i, 1, 1, 0)
            relaxed = simple.RelaxBlueNoise(producer(simple, points), Density=self.image(2),
                                            MaximumIterations=0)
            self.assertGreater(self.shown(relaxed).GaussianRadius, 0)

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
        self.assertEqual(shown.ShaderPreset, "Plain circle")
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

    def checkered(self, box, view=None):
        view = view or self.view
        found = tones(picture(simple, view, "first-checkerboard.png"), view, box)
        return is_checkered(found)

    def test_map_of_a_surface_is_a_checkerboard(self):
        """Its squares are where the coordinates say, also under the colours of an array; Surface has
        none, and a texture replaces them."""
        mapped = parameterized(simple)
        shown = self.shown(mapped)
        look_at(self.view, RECTANGLE)
        self.assert_like(shown, "Checkerboard", "")
        self.assertTrue(self.checkered(RECTANGLE))
        simple.ColorBy(shown, ("CELLS", "Flipped"))
        self.assertTrue(self.checkered(RECTANGLE))
        shown.Representation = "Surface"
        self.assertFalse(self.checkered(RECTANGLE))
        shown.Representation = "Checkerboard"
        shown.Texture = simple.CreateTexture(os.path.join(SOURCE, "Testing", "Data", "raccoon.png"))
        self.assertFalse(self.checkered(RECTANGLE))
        shown.Texture = None
        self.assertTrue(self.checkered(RECTANGLE))
        mapped.Corners = [4, 24, 20, 0]  # the square is turned: the lower left becomes dark
        self.assertFalse(self.checkered(RECTANGLE))

    def test_flat_surface_has_edges(self):
        shown = self.shown(parameterized(simple), 1)
        look_at(self.view, SQUARE)
        self.assert_like(shown, "Checkerboard With Edges", "")
        found = tones(picture(simple, self.view, "first-flat.png"), self.view, SQUARE)
        i, j = np.indices(found.shape)
        crossed = (i + j) % 6 == 5  # dark squares, by the diagonals of the mesh
        between = found[~crossed & ((i + j) % 2 == 1)]
        self.assertLess(found[crossed].max(), between.min() - 10)
        self.assertTrue(is_checkered(np.where(crossed, between.mean(), found)))

    def test_checkerboard_in_states(self):
        """It comes back from a state, a Python state and a trace."""
        from paraview import smstate, smtrace
        simple.ResetSession()  # of other tests' views
        self.view = simple.CreateView("RenderView")
        smtrace.start_trace()
        simple.Show(parameterized(simple), self.view)
        look_at(self.view, RECTANGLE)
        trace = smtrace.stop_trace()
        script = smstate.get_state()
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            paths = [os.path.join(folder, name) for name in ("state.pvsm", "state.py", "trace.py")]
            simple.SaveState(paths[0])
            for path, text in zip(paths[1:], (script, trace)):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            for path in paths:  # each by a program: ParaView 5.13 draws nothing after a second state
                opened = subprocess.run([os.environ["RT_PVPYTHON"], OPENS, path], stdin=subprocess.DEVNULL)
                self.assertEqual(opened.returncode, 0, path)

    def test_checkerboard_without_coordinates(self):
        """Is the surface."""
        plane = simple.Plane(Origin=[0, 0, 0], Point1=[3, 0, 0], Point2=[0, 1, 0])
        bare = simple.Clean(simple.ExtractSurface(simple.AppendDatasets(plane)))
        bare = simple.PassArrays(bare, PointDataArrays=[], CellDataArrays=[])
        shown = self.shown(bare)
        look_at(self.view, RECTANGLE)
        plain = picture(simple, self.view, "first-plain.png")
        shown.Representation = "Checkerboard"
        self.assertTrue((picture(simple, self.view, "first-bare.png") == plain).all())

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
        vertices = simple.MaskPoints(simple.Sphere(), GenerateVertices=1, SingleVertexPerCell=1)
        self.assertEqual(self.shown(vertices).Representation, "Surface")

    def test_filters_of_particles_read_as_these(self):
        """What the particles say of their density, in filters that nobody has set; and a warning where the
        density is another one."""
        for update in (True, False):
            sampler = self.photograph(NumberOfParticles=2000, Component=1, ValidRange=[0, 250])
            if update:
                sampler.UpdatePipeline()
            for make in (simple.RelaxBlueNoise, simple.TransportQuality, simple.DensityEqualizingWarp):
                made = make(sampler, Density=sampler.Input)
                self.assertEqual((made.InvertDensity, made.Component, list(made.ValidRange)),
                                 (1, 1, [0, 250]), (update, made.GetXMLLabel()))
                own = make(sampler, Density=sampler.Input, Component=2)
                self.assertEqual((own.InvertDensity, own.Component), (1, 2))
                other = make(sampler, Density=simple.Wavelet(WholeExtent=[0, 9, 0, 9, 0, 0]))
                self.assertEqual((other.InvertDensity, other.Component), (0, -1))
        for make in (simple.RelaxBlueNoise, simple.TransportQuality):
            for inverted, count in ((1, 0), (0, 1)):
                made = make(sampler, Density=sampler.Input)
                made.InvertDensity = inverted
                reported = Listener(made.GetClientSideObject())
                made.UpdatePipeline()
                found = [line for line in reported.warnings if "switch InvertDensity on" in line]
                self.assertEqual(len(found), count, reported.warnings)

    def test_density_of_particles_is_proposed(self):
        """That of the nearest filter of particles before these; what is given stays."""
        sampler = self.photograph(NumberOfParticles=500)
        image = self.image(2)

        def density(filter_):
            return filter_.Density and filter_.Density.SMProxy
        for make in (simple.RelaxBlueNoise, simple.TransportQuality, simple.DensityEqualizingWarp):
            with self.subTest(make.__name__):
                made = make(simple.Transform(sampler))
                self.assertEqual(density(made), sampler.Input.SMProxy)
                self.assertEqual(made.InvertDensity, 1)
                given = make(sampler, Density=image)
                self.assertEqual(density(given), image.SMProxy)
                if given.GetXMLLabel() != "Transport Quality":  # it gives a table
                    self.assertEqual(density(make(given)), image.SMProxy)
                self.assertIsNone(density(make(simple.UniformSeeds())))
                made.Density = image
                made.UpdatePipeline()
                self.assertEqual(density(made), image.SMProxy)

    def test_what_comes_of_particles_is_dots(self):
        sampler = self.photograph(NumberOfParticles=500)
        path = os.path.join(OUTPUT, "particles.vtp")
        simple.SaveData(path, sampler)
        seeds = simple.UniformSeeds(NumberOfPoints=200)  # without SeedId
        self.shown(seeds)
        for source in (
                simple.Threshold(sampler, Scalars=["POINTS", "SeedId"], LowerThreshold=0, UpperThreshold=250),
                simple.Calculator(sampler, Function="SeedId"), simple.Clip(seeds),
                simple.Transform(simple.MaskPoints(seeds, OnRatio=2)),
                simple.XMLPolyDataReader(FileName=[path])):
            with self.subTest(source.GetXMLLabel()):
                shown = self.shown(source)
                self.assert_like(shown, "Point Gaussian", "")
                self.assertEqual(shown.ShaderPreset, "Plain circle")

    def test_views_of_other_kinds(self):
        points = producer(simple, points_in(density_image((5, 4)), 10))
        quality = simple.TransportQuality(points, Density=self.image(2))
        quality.UpdatePipeline()
        self.assertIsNotNone(simple.Show(quality, simple.CreateView("SpreadSheetView")))


class FirstContour(unittest.TestCase):
    """The isovalue of a Contour that is made of an output, of data that are there."""

    def isovalues(self, source, **properties):
        source.UpdatePipeline()
        return list(simple.Contour(Input=source, **properties).Isosurfaces)

    @staticmethod
    def box(density=1, **properties):
        solid = simple.SolidDensity(simple.Box(**properties), Resolution=24)
        return solid if density == 1 else simple.Calculator(
            solid, ResultArrayName="Density", Function="%g*Density" % density)

    def middle(self, source):
        source.UpdatePipeline()
        return sum(source.PointData["Density"].GetRange()) / 2

    def test_half_of_solids(self):
        """Not half of what the particles reach."""
        round_, box = simple.SolidDensity(simple.Sphere(), Resolution=24), self.box()
        self.assertEqual(self.isovalues(box), [0.5])
        for blend in (simple.MorphDensities(round_, Target=box),
                      simple.MorphDensities(round_, Target=box, Parameter=0.1),
                      simple.DensityBarycenter(Input=[round_, box, box])):
            self.assertNotAlmostEqual(self.middle(blend), 0.5, places=3)
            self.assertEqual(self.isovalues(blend), [0.5])

    def test_half_by_any_name(self):
        """Of densities that are not called so."""
        boxes = [simple.Calculator(self.box(density), ResultArrayName="rho", Function="Density")
                 for density in (2, 3)]
        for box in boxes:
            box.UpdatePipeline()
        for blend in (simple.MorphDensities(boxes[0], Target=boxes[1], DensityArray=["POINTS", "rho"]),
                      simple.DensityBarycenter(Input=boxes, DensityArray=["POINTS", "rho"])):
            self.assertEqual(self.isovalues(blend), [1])
            self.assertEqual(list(blend.PointData.keys()), ["rho"])

    def test_thin_solid(self):
        """Half of what is inside, though no cell is full."""
        thin = self.box(ZLength=0.036)
        self.assertLess(self.middle(thin), 0.45)
        self.assertEqual(self.isovalues(thin), [0.5])

    def test_least_of_inputs(self):
        """The surface is there at every Parameter."""
        for morph in (simple.MorphDensities(self.box(), Target=self.box(5)),
                      simple.MorphDensities(self.box(5), Target=self.box())):
            self.assertEqual(self.isovalues(morph), [0.5])

    def test_what_is_given_holds(self):
        morph = simple.MorphDensities(self.box(), Target=self.box(2))
        self.assertEqual(self.isovalues(morph, Isosurfaces=[0.7]), [0.7])
        morph.MassMode = "Geometric"
        self.assertEqual(self.isovalues(morph), [0.5])
        self.assertEqual(self.isovalues(morph, Isosurfaces=[self.middle(morph)]),
                         [self.middle(morph)])
        contour = simple.Contour(Input=morph, registrationName="Surface")
        contour.Isosurfaces = [0.6, 0.8]
        with tempfile.TemporaryDirectory(dir=OUTPUT) as folder:
            path = os.path.join(folder, "state.pvsm")
            simple.SaveState(path)
            simple.ResetSession()
            simple.LoadState(path)
        self.assertEqual(list(simple.FindSource("Surface").Isosurfaces), [0.6, 0.8])

    def test_as_before(self):
        """Where half has no meaning or is not reached, and of other sources: ParaView's middle."""
        half = dict(Target=self.box(2), Parameter=0.5)
        for source in (simple.MorphDensities(self.box(2), InvertDensity=1, **half),
                       simple.MorphDensities(self.box(), MassMode="Source", **half),
                       simple.DensityBarycenter(Input=[self.box(100)], MassMode="Normalize"),
                       self.box(3), simple.SplatMass(simple.Sphere(), Dimensions=[8, 8, 8])):
            self.assertEqual(self.isovalues(source), [self.middle(source)])
        wavelet = simple.Wavelet()
        wavelet.UpdatePipeline()
        self.assertEqual(self.isovalues(wavelet),
                         [sum(wavelet.PointData["RTData"].GetRange()) / 2])


if __name__ == "__main__":
    need_display()
    main()

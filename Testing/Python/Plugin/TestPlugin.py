# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in ParaView: where its filters are found, and their texts in the panel."""
import os
import unittest

import numpy as np
from PIL import Image
from rt_filters import FILTERS, PROPERTIES, Property, by_label
from rt_proxies import proxies
from rt_testing import OUTPUT, SOURCE, density_image, load_plugin, main, output_of, producer
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

simple = load_plugin()

# VTK 9.6's reader of maps ends the program with a picture that names no coordinate system.
ENDS_WITHOUT_MAP = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 6)


class Plugin(unittest.TestCase):
    def test_labels_are_the_names_in_python(self):
        for proxy in proxies():
            self.assertTrue(hasattr(simple, by_label(proxy.label).name), proxy.label)

    def test_menu_and_representation(self):
        for proxy in proxies():
            hints = simple.servermanager.ProxyManager().GetProxyDefinition(
                proxy.menu, proxy.element.get("name")).FindNestedElementByName("Hints")
            self.assertEqual(
                hints.FindNestedElementByName("ShowInMenu").GetAttribute("category"), "Transport")
            for tag, attributes in by_label(proxy.label).shown:
                if tag == "RepresentationType":
                    representation = hints.FindNestedElementByName(tag)
                    for name, value in attributes.items():
                        self.assertEqual(representation.GetAttribute(name), value, proxy.label)

    def test_every_proxy_and_property_is_documented(self):
        for proxy in proxies():
            documentation = proxy.element.find("Documentation")
            for attribute in ("short_help", "long_help"):
                self.assertTrue(documentation.get(attribute), proxy.label)
            for name, prop in proxy.properties.items():
                with self.subTest(proxy=proxy.label, property=name):
                    self.assertRegex(prop.documentation, r"^[A-Z0-9].*\.$")

    def test_properties_are_named_by_themselves(self):
        for proxy in proxies():
            for name, prop in proxy.properties.items():
                label = prop.element.get("label", name)
                self.assertEqual(label.replace(" ", ""), name)

    def test_integration_is_advanced(self):
        for filter_ in FILTERS:
            made = getattr(simple, filter_.name)()
            for name in filter_.panel:
                if PROPERTIES.get(name, Property()).advanced and name not in filter_.always_shown:
                    with self.subTest(filter_.label, property=name):
                        self.assertEqual(made.GetProperty(name).GetPanelVisibility(), "advanced")

    def test_array_is_chosen_from_points_and_cells(self):
        for cells in (True, False):
            sampler = simple.SampleDensity(Input=producer(simple, density_image(cells=cells)))
            self.assertEqual(list(sampler.DensityArray),
                             ["CELLS" if cells else "POINTS", "Density"])
            self.assertEqual(output_of(sampler).GetNumberOfPoints(), 8192)

    def test_array_of_data_not_seen_yet(self):
        """A reader that has not run names no array to the panel; the filter finds the only one."""
        photograph = simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data",
                                                                    "ascent.png")])
        sampler = simple.SampleDensity(Input=photograph, NumberOfParticles=50)
        self.assertEqual(output_of(sampler).GetNumberOfPoints(), 50)
        photograph = simple.PNGSeriesReader(FileNames=photograph.FileNames)
        warp = simple.DensityEqualizingWarp(Input=simple.Plane(), Density=photograph)
        self.assertEqual(output_of(warp).GetNumberOfPoints(), 4)

    def test_tables_are_kept_behind_a_reader(self):
        """ParaView makes the image anew around the reader's array each time that it updates."""
        photograph = simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data",
                                                                    "ascent.png")])
        sampler = simple.SampleDensity(Input=photograph, NumberOfParticles=50)
        output_of(sampler)
        built = sampler.GetClientSideObject().GetTableBuildTime()
        first = output_of(sampler).GetPoint(7)
        sampler.RandomSeed = 2
        self.assertNotEqual(output_of(sampler).GetPoint(7), first)
        self.assertEqual(sampler.GetClientSideObject().GetTableBuildTime(), built)

    def test_all_data_sets_with_arrays_are_accepted(self):
        image = producer(simple, density_image())
        sampler = simple.SampleDensity(Input=image)
        accepted = sampler.SMProxy.GetProperty("Input")
        self.assertTrue(accepted.IsInDomains())
        blocks = simple.GroupDatasets(Input=[image])
        mesh = simple.Tetrahedralize(Input=image)
        fractal = simple.HierarchicalFractal()
        table = simple.ProgrammableSource(OutputDataSetType="vtkTable")
        for source, right in ((blocks, True), (mesh, True), (fractal, True), (table, False)):
            source.UpdatePipeline()
            accepted.SetUncheckedInputConnection(0, source.SMProxy, 0)
            self.assertEqual(bool(accepted.IsInDomains()), right, source)

    def test_flow_time_is_animateable(self):
        sampler = simple.SampleDensity(Input=producer(simple, density_image()))
        self.assertTrue(sampler.GetProperty("FlowTime").SMProperty.GetAnimateable())
        self.assertFalse(sampler.GetProperty("NumberOfParticles").SMProperty.GetAnimateable())

    def test_seeds_are_optional_and_can_be_taken_away(self):
        seeds = simple.UniformSeeds(NumberOfPoints=77, Bounds=[0, 6, 0, 20, 0, 1])
        sampler = simple.SampleDensity(Input=producer(simple, density_image()))
        self.assertIsNotNone(
            sampler.GetProperty("Seeds").SMProperty.GetHints().FindNestedElementByName("Optional"))
        self.assertEqual(output_of(sampler).GetNumberOfPoints(), 8192)
        sampler.Seeds = seeds
        self.assertEqual(output_of(sampler).GetNumberOfPoints(), 77)
        sampler.Seeds = None
        self.assertEqual(output_of(sampler).GetNumberOfPoints(), 8192)

    def test_warp_reads_the_density_on_its_second_input(self):
        for cells in (True, False):
            image = producer(simple, density_image(cells=cells))
            warp = simple.DensityEqualizingWarp(Input=simple.Plane(), Density=image)
            self.assertEqual(list(warp.DensityArray),
                             ["CELLS" if cells else "POINTS", "Density"])
            self.assertEqual(output_of(warp).GetNumberOfPoints(), 4)
            choice = warp.GetClientSideObject().GetInputArrayInformation(0)
            self.assertEqual(choice.Get(vtkAlgorithm.INPUT_PORT()), 1)
            self.assertTrue(warp.GetProperty("Blend").SMProperty.GetAnimateable())

    def test_particles_are_relaxed(self):
        """Of a reader that has not run, in the plane that the particles are in."""
        photograph = simple.PNGSeriesReader(FileNames=[os.path.join(SOURCE, "Testing", "Data",
                                                                    "ascent.png")])
        sampler = simple.SampleDensity(Input=photograph, NumberOfParticles=300, InvertDensity=1)
        for method in ("GaussianBlueNoise", "OptimalTransport"):
            relaxed = simple.RelaxBlueNoise(Input=sampler, Density=photograph, InvertDensity=1,
                                            Method=method, MaximumIterations=4)
            particles = output_of(relaxed)
            self.assertEqual(particles.GetNumberOfVerts(), 300)
            self.assertEqual(particles.GetPointData().GetArray("SeedId").GetTuple1(299), 299)
            energy = particles.GetFieldData().GetArray("Energy")
            values = [energy.GetValue(i) for i in range(energy.GetNumberOfTuples())]
            self.assertTrue(1 < len(values) <= 5)
            self.assertEqual(values, sorted(values, reverse=True))
            self.assertLess(values[-1], values[0])
            self.assertEqual(relaxed.GetProperty("Tolerance").GetPanelVisibility(), "advanced")

    def test_inputs_accept_what_they_take(self):
        image = producer(simple, density_image())
        sphere = simple.Sphere()
        table = simple.ProgrammableSource(OutputDataSetType="vtkTable")
        sources = {"image": image, "sphere": sphere, "table": table}
        for source in sources.values():
            source.UpdatePipeline()
        taken = {"density": {"image", "sphere"}, "densities": {"image", "sphere"}, "image": {"image"},
                 "map": set()}  # which have no cell array
        for filter_ in FILTERS:
            made = getattr(simple, filter_.name)()
            for name, kind in filter_.ports.items():
                accepted = made.SMProxy.GetProperty(name)
                for kind_of_source, source in sources.items():
                    with self.subTest(filter_.label, input=name, source=kind_of_source):
                        accepted.SetUncheckedInputConnection(0, source.SMProxy, 0)
                        self.assertEqual(bool(accepted.IsInDomains()),
                                         kind_of_source in taken.get(kind, {"sphere"}))

    def test_solid_is_a_density(self):
        """Points are active for Contour and volume rendering, and a density for other filters."""
        solid = simple.SolidDensity(Input=simple.Sphere(), Resolution=24)
        solid.UpdatePipeline()
        contour = simple.Contour(Input=solid, Isosurfaces=[0.5])
        self.assertEqual(list(contour.ContourBy), ["POINTS", "Density"])
        self.assertGreater(output_of(contour).GetNumberOfCells(), 500)
        particles = simple.SampleDensity(Input=solid, NumberOfParticles=300)
        self.assertEqual(output_of(particles).GetNumberOfPoints(), 300)
        self.assertEqual(list(particles.DensityArray), ["POINTS", "Density"])
        solid.Association = "Cells"
        self.assertEqual(output_of(solid).GetNumberOfCells(), 24**3)
        self.assertEqual(solid.GetProperty("Threading").GetPanelVisibility(), "advanced")

    def test_texture_lies_on_a_parameterization(self):
        """The coordinates are the active ones, and the surface's own stay."""
        plane = simple.Plane(XResolution=4, YResolution=3)
        made = simple.AreaPreservingParameterization(Input=plane, Resolution=16)
        data = output_of(made).GetPointData()
        self.assertEqual(data.GetTCoords().GetName(), "AreaPreserving")
        self.assertIsNotNone(data.GetArray("TextureCoordinates"))
        self.assertEqual(list(made.Corners), [])
        for corners in ([0, 4, 19, 15], [19, 15, 0, 4], []):
            made.Corners = corners
            square = output_of(made).GetPointData().GetTCoords()
            places = [square.GetTuple2(point) for point in corners]
            self.assertEqual(places, [(0, 0), (1, 0), (1, 1), (0, 1)][:len(corners)])

    def test_surface_is_sampled(self):
        """None is the density at first; scalars of points and cells are listed."""
        plane = simple.Plane(XResolution=4, YResolution=3)
        lifted = simple.Calculator(Input=plane, ResultArrayName="Height", Function="1+coordsX")
        sampled = simple.SampleSurface(Input=lifted, Resolution=16)
        self.assertEqual(list(sampled.DensityArray), ["POINTS", "None"])
        self.assertAlmostEqual(
            output_of(sampled).GetFieldData().GetArray("TotalMass").GetTuple1(0), 1)
        sampled.DensityArray = ["POINTS", "Height"]
        particles = output_of(sampled)
        self.assertEqual(particles.GetNumberOfPoints(), 8192)
        self.assertAlmostEqual(particles.GetFieldData().GetArray("TotalMass").GetTuple1(0), 1)
        for i in (0, 100, 8191):
            self.assertAlmostEqual(particles.GetPointData().GetArray("Height").GetTuple1(i),
                                   1 + particles.GetPoint(i)[0])
        self.assertEqual(list(sampled.Corners), [])
        again = simple.TransportQuality(
            Input=sampled, Density=simple.SplatMass(Input=sampled, Dimensions=[8, 8, 1]))
        self.assertEqual(output_of(again).GetNumberOfRows(), 1)

    @unittest.skipUnless(hasattr(simple, "GDALRasterReader"), "ParaView is built without GDAL")
    def test_readers_of_photographs(self):
        """What Documentation/Density.md says of them: which ones turn a photograph upside down."""
        rows, columns = np.mgrid[0:24, 0:32]
        photograph = np.stack([8 * rows, 6 * columns, 0 * rows + 99], axis=2).astype(np.uint8)
        for ending, kind, upright in (("png", "PNGSeriesReader", True),
                                      ("jpg", "JPEGSeriesReader", True),
                                      ("tif", "TIFFSeriesReader", False),
                                      ("png", "GDALRasterReader", False),
                                      ("jpg", "GDALRasterReader", False),
                                      ("tif", "GDALRasterReader", False)):
            path = os.path.join(OUTPUT, "photograph." + ending)
            Image.fromarray(photograph).save(path)
            maps = kind == "GDALRasterReader"
            if maps and ENDS_WITHOUT_MAP:
                continue
            reader = getattr(simple, kind)(**{"FileName": path} if maps else {"FileNames": [path]})
            image = output_of(reader)
            data = image.GetCellData() if maps else image.GetPointData()
            read = vtk_to_numpy(data.GetArray("Elevation" if maps else 0)).reshape(24, 32, 3)
            expected = photograph[::-1] if upright else photograph  # VTK's rows go up
            with self.subTest(kind, ending=ending):
                self.assertLess(np.abs(read.astype(int) - expected).max(), 16)


if __name__ == "__main__":
    main()

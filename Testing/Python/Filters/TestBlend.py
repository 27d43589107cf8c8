# SPDX-License-Identifier: BSD-3-Clause
"""Morph Densities and Density Barycenter in ParaView: arrays, inputs, time, blocks."""
import os
import unittest

import numpy as np
from rt_testing import (OUTPUT, SOURCE, Listener, density_image, digest, load_plugin, main,
                        output_of, producer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPartitionedDataSetCollection
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

from rectifiedtransport import vtkTransportBarycenter, vtkTransportInterpolator

simple = load_plugin()


def density_of(data):
    """The values of the density, on cells or on points."""
    attributes = [a for a in (data.GetCellData(), data.GetPointData()) if a.GetScalars()]
    assert len(attributes) == 1
    return vtk_to_numpy(attributes[0].GetScalars()).copy()


def run(proxy):
    return density_of(output_of(proxy))


def particles_of(proxy):
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetParticles()


def built(proxy):
    return proxy.GetClientSideObject().GetTableBuildTime()


def morph_of(source, target, parameter=0.5):
    """What the class itself gives."""
    morph = vtkTransportInterpolator()
    morph.SetInputData(source)
    morph.SetTargetData(target)
    morph.SetParameter(parameter)
    morph.Update()
    return density_of(morph.GetDensity())


def barycenter_of(images, weights=()):
    barycenter = vtkTransportBarycenter()
    for image in images:
        barycenter.AddInputDataObject(image)
    for i, weight in enumerate(weights):
        barycenter.SetWeight(i, weight)
    barycenter.Update()
    return density_of(barycenter.GetDensity())


def add_array(image, name, values, cells=True):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
    array.SetName(name)
    (image.GetCellData() if cells else image.GetPointData()).AddArray(array)


class Blend(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        self.images = [density_image(seed=seed) for seed in range(4)]
        self.sources = [producer(simple, image) for image in self.images]

    def morph(self, **properties):
        return simple.MorphDensities(Input=self.sources[0], Target=self.sources[1], **properties)

    def barycenter(self, count=3, **properties):
        return simple.DensityBarycenter(Input=self.sources[:count], **properties)


class Morph(Blend):
    def test_defaults(self):
        morph = self.morph()
        self.assertEqual(list(morph.DensityArray), ["CELLS", "Density"])
        self.assertEqual(list(morph.TargetArray), ["CELLS", "Density"])
        self.assertEqual((morph.Parameter, morph.ParticlesPerCell), (0.5, 0))
        self.assertEqual(morph.Kernel, "TriangularShapedCloud")
        self.assertEqual(list(morph.GetProperty("MassMode").GetAvailable()),
                         ["Linear", "Geometric", "Source", "Normalize"])
        self.assertEqual(list(morph.GetProperty("Kernel").GetAvailable()),
                         ["CloudInCell", "NearestCell", "TriangularShapedCloud", "Gaussian"])
        self.assertTrue(morph.GetProperty("Parameter").SMProperty.GetAnimateable())
        np.testing.assert_array_equal(run(morph), morph_of(*self.images[:2]))

    def test_no_stripes(self):
        """Even parts stay even by default, between an even density and a disc on a faint ground; not with
        a particle a cell that is spread over two."""
        y, x = np.mgrid[:96, :96] / 96
        disc = 0.2 + 1.0 * ((x - 0.5) ** 2 + (y - 0.5) ** 2 < 0.04)
        inputs = [producer(simple, density_image((96, 96), values=values.ravel()))
                  for values in (np.ones((96, 96)), disc)]

        def unevenness(**properties):
            morph = simple.MorphDensities(inputs[0], Target=inputs[1], **properties)
            values = run(morph).reshape(96, 96)[40:56, 40:56]
            around = sum(np.roll(values, step, axis) for step in (-1, 1) for axis in (0, 1)) / 4
            return (values - around)[1:-1, 1:-1].std() / values.mean()
        self.assertLess(unevenness(), 0.006)
        self.assertGreater(unevenness(ParticlesPerCell=1, Kernel="CloudInCell"), 0.03)

    def test_outputs(self):
        morph = self.morph()
        morph.UpdatePipeline()
        self.assertEqual((morph.GetOutputPort(0).Port, morph["Density"].Port), (0, 0))
        self.assertEqual(morph["Particles"].Port, 1)
        self.assertEqual(list(morph.CellData.keys()), ["Density"])
        self.assertEqual(set(morph["Particles"].PointData.keys()),
                         {"SourcePosition", "TargetPosition", "Displacement", "Mass"})
        image = morph.GetDataInformation()
        self.assertEqual(list(image.GetExtent()), [0, 12, 0, 10, 0, 0])
        self.assertEqual(morph.FieldData["TotalMass"].GetNumberOfComponents(), 1)
        contour = simple.Contour(Input=simple.CellDatatoPointData(Input=morph["Density"]),
                                 ContourBy=["POINTS", "Density"], Isosurfaces=[0.6])
        self.assertGreater(output_of(contour).GetNumberOfCells(), 0)

    def test_parameter_alone_builds_nothing(self):
        """ParaView makes the images anew around their arrays each time that it updates."""
        photograph = os.path.join(SOURCE, "Testing", "Data", "ascent.png")
        small = [simple.ExtractSubset(Input=simple.PNGSeriesReader(FileNames=[photograph]),
                                      VOI=[first, first + 40, 0, 30, 0, 0])
                 for first in (100, 300)]
        morph = simple.MorphDensities(Input=small[0], Target=small[1])
        first, when = run(morph), built(morph)
        self.assertGreater(when, 0)
        for name, value in (("Parameter", 0.25), ("MassMode", "Normalize"), ("Kernel", "Gaussian"),
                            ("Radius", 2)):
            setattr(morph, name, value)
            after = run(morph)
            self.assertTrue((after != first).any(), name)
            self.assertEqual(built(morph), when, name)
            first = after
        small[1].VOI = [50, 90, 0, 30, 0, 0]
        self.assertFalse(np.array_equal(run(morph), first))
        self.assertGreater(built(morph), when)

    def test_arrays_of_other_names(self):
        add_array(self.images[0], "A", 1.0 + np.arange(120.0))
        add_array(self.images[1], "B", 1.0 + np.arange(143.0)[::-1] ** 2, cells=False)
        morph = self.morph(DensityArray=["CELLS", "A"], TargetArray=["POINTS", "B"])
        alone = [density_image(values=1.0 + np.arange(120.0)),
                 density_image((13, 11), cells=False, values=1.0 + np.arange(143.0)[::-1] ** 2)]
        np.testing.assert_array_equal(run(morph), morph_of(*alone))
        morph.TargetArray = ["CELLS", "Density"]
        np.testing.assert_array_equal(run(morph), morph_of(alone[0], self.images[1]))
        morph.DensityArray = ["CELLS", "Density"]
        np.testing.assert_array_equal(run(morph), morph_of(*self.images[:2]))
        # One name, on cells of the one and on points of the other.
        add_array(self.images[1], "A", 1.0 + np.arange(143.0)[::-1] ** 2, cells=False)
        morph.DensityArray, morph.TargetArray = ["CELLS", "A"], ["POINTS", "A"]
        np.testing.assert_array_equal(run(morph), morph_of(*alone))
        morph.TargetArray = ["CELLS", "Missing"]
        reported = Listener(morph.GetClientSideObject())
        self.assertEqual(output_of(morph).GetNumberOfPoints(), 0)
        self.assertIn("Target: The input image has no density array 'Missing'", reported.errors[0])

    def test_arrays_of_data_not_seen_yet(self):
        photograph = os.path.join(SOURCE, "Testing", "Data", "ascent.png")
        morph = simple.MorphDensities(Input=simple.PNGSeriesReader(FileNames=[photograph]),
                                      Target=simple.PNGSeriesReader(FileNames=[photograph]),
                                      Dimensions=[20, 20, 0], NumberOfSteps=4)
        self.assertEqual(len(run(morph)), 400)
        for array in (morph.DensityArray, morph.TargetArray):
            self.assertEqual(list(array), ["POINTS", "PNGImage"])

    def test_target_array_has_the_name_of_the_density_array(self):
        """Until another one is chosen. A target without that name gives its active scalars."""
        for image in self.images[:2]:
            add_array(image, "A", 1.0 + np.arange(120.0))
        add_array(self.images[1], "B", 1.0 + np.arange(120.0))
        self.assertEqual(list(self.morph(DensityArray=["CELLS", "A"]).TargetArray), ["CELLS", "A"])
        morph = self.morph()
        for name, target in (("Density", "Density"), ("A", "A"), ("Density", "Density")):
            morph.DensityArray = ["CELLS", name]
            self.assertEqual(list(morph.TargetArray), ["CELLS", target])
        morph.TargetArray = ["CELLS", "B"]
        morph.DensityArray = ["CELLS", "A"]
        self.assertEqual(list(morph.TargetArray), ["CELLS", "B"])
        without = simple.MorphDensities(self.sources[0], Target=self.sources[2], DensityArray=["CELLS", "A"])
        self.assertEqual(list(without.TargetArray), ["CELLS", "Density"])

    def test_first_choice_follows_the_input(self):
        """It is made anew for an input that lacks it; what was chosen stays."""
        add_array(self.images[0], "A", 1.0 + np.arange(120.0))
        wavelet = simple.Wavelet(WholeExtent=[0, 9, 0, 9, 0, 0])
        wavelet.UpdatePipeline()
        morph = self.morph()
        morph.Input = wavelet
        self.assertEqual(list(morph.DensityArray), ["POINTS", "RTData"])
        chosen = self.morph(DensityArray=["CELLS", "A"])
        chosen.Input = wavelet
        self.assertEqual(list(chosen.DensityArray), ["CELLS", "A"])

    def test_components(self):
        rng = np.random.default_rng(7)
        for image in self.images[:2]:
            add_array(image, "Colour", 0.1 + rng.random((120, 3)))
        morph = self.morph(DensityArray=["CELLS", "Colour"], TargetArray=["CELLS", "Colour"],
                           Component=1)
        alone = [density_image(values=vtk_to_numpy(image.GetCellData().GetArray("Colour"))[:, 1])
                 for image in self.images[:2]]
        np.testing.assert_array_equal(run(morph), morph_of(*alone))
        morph.Component = -3
        norms = [density_image(values=np.linalg.norm(
            vtk_to_numpy(image.GetCellData().GetArray("Colour")), axis=1)) for image in self.images[:2]]
        np.testing.assert_allclose(run(morph), morph_of(*norms), rtol=1e-9)
        morph.Component = -2
        grey = [density_image(values=vtk_to_numpy(image.GetCellData().GetArray("Colour"))
                              @ [0.2126, 0.7152, 0.0722]) for image in self.images[:2]]
        np.testing.assert_allclose(run(morph), morph_of(*grey), rtol=1e-9)

    def test_change_input(self):
        morph = self.morph()
        run(morph)
        morph.Target = self.sources[2]
        np.testing.assert_array_equal(run(morph), morph_of(self.images[0], self.images[2]))
        morph.Input = self.sources[1]
        np.testing.assert_array_equal(run(morph), morph_of(self.images[1], self.images[2]))
        when = built(morph)
        morph.Input, morph.Target = self.sources[2], self.sources[1]
        np.testing.assert_array_equal(run(morph), morph_of(self.images[2], self.images[1]))
        self.assertEqual(built(morph), when)

    def test_only_data_sets_are_accepted(self):
        morph = self.morph()
        table = simple.ProgrammableSource(OutputDataSetType="vtkTable")
        table.UpdatePipeline()
        for name in ("Input", "Target"):
            accepted = morph.SMProxy.GetProperty(name)
            self.assertTrue(accepted.IsInDomains())
            accepted.SetUncheckedInputConnection(0, table.SMProxy, 0)
            self.assertFalse(accepted.IsInDomains())

    def test_arrays_that_inputs_share_are_made_once(self):
        """Two places of one field are no two times of it."""
        wavelet = simple.TemporalShiftScale(simple.Wavelet(WholeExtent=[0, 6, 0, 6, 0, 0]))
        moved = simple.Transform(wavelet, TransformAllInputVectors=0)
        moved.Transform.Translate = [3, 0, 0]
        morph = simple.MorphDensities(wavelet, Target=moved, DensityArray=["POINTS", "RTData"],
                                      TargetArray=["POINTS", "RTData"], DensityResolution=8)
        cost = output_of(morph).GetFieldData().GetArray("TransportCost").GetValue(0)
        self.assertGreater(cost, 0)

    def test_play(self):
        """Playing the animation morphs, with kept maps."""
        morph = self.morph(PublishTime=1, NumberOfTimeSteps=5)
        morph.UpdatePipelineInformation()
        self.assertEqual(list(morph.TimestepValues), [0, 0.25, 0.5, 0.75, 1])
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        keeper = simple.GetTimeKeeper()
        self.assertEqual(list(keeper.TimestepValues), [0, 0.25, 0.5, 0.75, 1])
        scene.PlayMode = "Snap To TimeSteps"
        scene.GoToFirst()
        when = None
        for time in (0, 0.25, 0.5, 0.75, 1):
            self.assertEqual(keeper.Time, time)
            morph.UpdatePipeline(keeper.Time)
            image = morph.GetClientSideObject().GetDensity()
            np.testing.assert_array_equal(density_of(image), morph_of(*self.images[:2], time))
            self.assertEqual(image.GetInformation().Get(image.DATA_TIME_STEP()), time)
            when = when or built(morph)
            self.assertEqual(built(morph), when)
            scene.GoToNext()
        morph.PublishTime = 0
        morph.UpdatePipelineInformation()
        self.assertFalse(morph.TimestepValues)

    def test_times_stay_away_from_the_inputs(self):
        """A series of images stays at its first while the morph is animated."""
        paths = []
        for i, image in enumerate(self.images[:3]):
            paths.append(os.path.join(OUTPUT, "blend%d.vti" % i))
            writer = vtkXMLImageDataWriter()
            writer.SetFileName(paths[-1])
            writer.SetInputData(image)
            writer.SetDataModeToBinary()  # appended: see Testing/Data/README.md
            writer.Write()
        series = simple.XMLImageDataReader(FileName=paths)
        series.UpdatePipelineInformation()
        self.assertEqual(list(series.TimestepValues), [0, 1, 2])
        morph = simple.MorphDensities(Input=series, Target=self.sources[3], PublishTime=1)
        morph.UpdatePipelineInformation()
        self.assertEqual(len(morph.TimestepValues), 11)
        # The scene has them in place of its input's, beside those of another series.
        keeper = simple.GetTimeKeeper()
        self.assertEqual(list(keeper.TimestepValues), list(morph.TimestepValues))
        other = simple.XMLImageDataReader(FileName=paths)
        other.UpdatePipelineInformation()
        self.assertEqual(list(keeper.TimestepValues), [*morph.TimestepValues, 2])
        simple.Delete(other)
        when = None
        for time in (0.0, 0.5, 1.0):
            morph.UpdatePipeline(time)
            found = density_of(morph.GetClientSideObject().GetDensity())
            np.testing.assert_array_equal(found, morph_of(self.images[0], self.images[3], time))
            when = when or built(morph)
            self.assertEqual(built(morph), when)
        # Off, the time is that of the series.
        morph.PublishTime = 0
        morph.UpdatePipelineInformation()
        self.assertEqual(list(morph.TimestepValues), [0, 1, 2])
        self.assertEqual(list(keeper.TimestepValues), [0, 1, 2])
        morph.UpdatePipeline(2.0)
        found = density_of(morph.GetClientSideObject().GetDensity())
        np.testing.assert_array_equal(found, morph_of(self.images[2], self.images[3]))


class Barycenter(Blend):
    def test_weights(self):
        barycenter = self.barycenter()
        self.assertEqual(len(barycenter.Weights), 0)
        self.assertTrue(barycenter.GetProperty("Weights").SMProperty.GetAnimateable())
        np.testing.assert_array_equal(run(barycenter), barycenter_of(self.images[:3]))
        when = built(barycenter)
        for weights in ((1, 2, 3), (1, 0, 0), (0.5, 0.25, 0.25)):
            barycenter.Weights = weights
            np.testing.assert_array_equal(run(barycenter), barycenter_of(self.images[:3], weights))
        np.testing.assert_array_equal(run(barycenter), barycenter_of(self.images[:3], weights))
        barycenter.Weights = []
        np.testing.assert_array_equal(run(barycenter), barycenter_of(self.images[:3]))
        self.assertEqual(built(barycenter), when)

    def test_inputs_are_changed(self):
        barycenter = self.barycenter(Weights=[1, 2, 3])
        run(barycenter)
        when = built(barycenter)
        barycenter.Input = [self.sources[2], self.sources[0]]
        reported = Listener(barycenter.GetClientSideObject())
        self.assertEqual(output_of(barycenter).GetNumberOfPoints(), 0)
        self.assertIn("The number of Weights is 3 and that of inputs 2", reported.errors[0])
        barycenter.Weights = [3, 1]
        np.testing.assert_array_equal(run(barycenter),
                                      barycenter_of([self.images[2], self.images[0]], (3, 1)))
        self.assertEqual(built(barycenter), when)
        barycenter.Input = [self.sources[2], self.sources[0], self.sources[3]]
        barycenter.Weights = [1, 1, 2]
        images = [self.images[i] for i in (2, 0, 3)]
        np.testing.assert_array_equal(run(barycenter), barycenter_of(images, (1, 1, 2)))
        self.assertGreater(built(barycenter), when)

    def test_blocks(self):
        blocks = vtkMultiBlockDataSet()
        collection = vtkPartitionedDataSetCollection()
        for i, image in enumerate(self.images[:3]):
            blocks.SetBlock(i, image)
            collection.SetPartition(i, 0, image)
        expected = barycenter_of(self.images[:3], (1, 2, 3))
        for composite in (blocks, collection):
            barycenter = simple.DensityBarycenter(Input=producer(simple, composite),
                                                  Weights=[1, 2, 3])
            self.assertEqual(list(barycenter.DensityArray), ["CELLS", "Density"])
            np.testing.assert_array_equal(run(barycenter), expected)
            self.assertEqual(output_of(barycenter).GetClassName(), "vtkImageData")
        grouped = simple.GroupDatasets(Input=self.sources[:3])
        barycenter = simple.DensityBarycenter(Input=grouped, Weights=[1, 2, 3])
        np.testing.assert_array_equal(run(barycenter), expected)
        both = simple.DensityBarycenter(Input=[grouped, self.sources[3]])
        np.testing.assert_array_equal(run(both), barycenter_of(self.images))

    def test_downstream_of_blocks(self):
        """A filter downstream is updated alone, after the weights have changed."""
        grouped = simple.GroupDatasets(Input=self.sources[:2])
        barycenter = simple.DensityBarycenter(Input=grouped)
        points = simple.CellDatatoPointData(Input=barycenter)
        contour = simple.Contour(Input=points, ContourBy=["POINTS", "Density"], Isosurfaces=[0.6])
        seen = set()
        for weights in ((1, 0), (1, 1), (0, 1)):
            barycenter.Weights = weights
            found = output_of(contour)
            self.assertGreater(found.GetNumberOfCells(), 0)
            seen.add(digest(found))
        self.assertEqual(len(seen), 3)

    def test_particles(self):
        particles = particles_of(self.barycenter())
        self.assertEqual(particles.GetNumberOfPoints(), 4 * 120)
        self.assertEqual(particles.GetPointData().GetNumberOfArrays(), 1)


class ResultArrayName(Blend):
    """The name of the output's array."""

    def test_name(self):
        """That of the inputs' arrays, Density where they differ, or what is asked for."""
        for image, names in zip(self.images, ("AB", "AB", "B")):
            for name in names:
                add_array(image, name, 1.0 + np.arange(120.0))
        choices = (({}, "Density"), (dict(DensityArray=["CELLS", "A"]), "A"),
                   (dict(DensityArray=["CELLS", "A"], ResultArrayName="C"), "C"))
        for make in self.morph, lambda **choice: self.barycenter(2, **choice):
            for choice, expected in choices:
                proxy = make(**choice)
                proxy.UpdatePipeline()
                self.assertEqual(list(proxy.CellData.keys()), [expected])
        morph = self.morph(DensityArray=["CELLS", "A"], TargetArray=["CELLS", "B"])
        morph.UpdatePipeline()
        self.assertEqual(list(morph.CellData.keys()), ["Density"])
        morph.ResultArrayName = "C"
        morph.UpdatePipelineInformation()
        morph.UpdatePipeline()
        self.assertEqual(list(morph.CellData.keys()), ["C"])


class State(Blend):
    def test_array_choices_and_weights_come_back(self):
        photograph = os.path.join(SOURCE, "Testing", "Data", "ascent.png")
        readers = [simple.PNGSeriesReader(FileNames=[photograph]) for _ in range(2)]
        # Arrays whose names differ on the two inputs.
        shares = [simple.Calculator(Input=reader, Function=function, ResultArrayName=name)
                  for reader, name, function in zip(readers, "AB", ("PNGImage + 1",
                                                                    "300 - PNGImage"))]
        simple.MorphDensities(registrationName="M", Input=shares[0], Target=shares[1],
                              DensityArray=["POINTS", "A"], TargetArray=["POINTS", "B"],
                              Dimensions=[30, 20, 0], Parameter=0.25, NumberOfSteps=5)
        expected = digest(output_of(simple.FindSource("M")))
        path = os.path.join(OUTPUT, "blend.pvsm")
        simple.SaveState(path)
        simple.ResetSession()
        simple.LoadState(path)
        morph = simple.FindSource("M")
        self.assertEqual(list(morph.DensityArray), ["POINTS", "A"])
        self.assertEqual(list(morph.TargetArray), ["POINTS", "B"])
        self.assertEqual(digest(output_of(morph)), expected)
        morph.Input, morph.Target = morph.Target, morph.Input
        morph.DensityArray = ["POINTS", "B"]
        morph.TargetArray = ["POINTS", "A"]
        morph.Parameter = 0.75
        reverse = density_of(output_of(morph))
        self.assertEqual(len(reverse), 600)


if __name__ == "__main__":
    main()

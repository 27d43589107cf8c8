# SPDX-License-Identifier: BSD-3-Clause
"""The tutorial's states open from a copy of the project elsewhere, and hold and draw what the tutorial
says; its script remakes them."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
from rt_testing import OUTPUT, SOURCE, load_plugin, main, need_display, output_of, positions
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

simple = load_plugin()
FOLDER = os.path.join("Examples", "Tutorial")
SIDE = 600  # pixels of the pictures, as in the tutorial: the legend keeps its size


def picture(path):
    """The rows, columns and colours of a PNG, from 0 to 1."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height = reader.GetOutput().GetDimensions()[:2]
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[..., :3] / 255


def means(pixels, blocks=20):
    """Means over blocks, so that one dot here or there does not count."""
    height, width = pixels.shape[:2]
    return pixels.reshape(blocks, height // blocks, blocks, width // blocks, 3).mean(axis=(1, 3))


def smoke(moment):
    """The values of a moment of the simulation and where they are."""
    reader = vtkXMLImageDataReader()
    reader.SetFileName(os.path.join(SOURCE, FOLDER, "plume-%d.vti" % moment))
    reader.Update()
    image = reader.GetOutput()
    places = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    return vtk_to_numpy(image.GetPointData().GetScalars()).astype(float), places


class States(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()
        self.folder = tempfile.mkdtemp(dir=OUTPUT)
        self.addCleanup(shutil.rmtree, self.folder)
        for name in (FOLDER, os.path.join("Testing", "Data")):
            shutil.copytree(os.path.join(SOURCE, name), os.path.join(self.folder, name),
                            ignore=shutil.ignore_patterns("Baseline"))

    def opened(self, name):
        """What a state draws; all of its data are those of the copy."""
        place = os.path.join(self.folder, FOLDER)
        simple.LoadState(os.path.join(place, name + ".pvsm"), data_directory=place)
        for source in simple.GetSources().values():
            files = getattr(source, "FileName", None) or []
            for path in [files] if isinstance(files, str) else files:
                self.assertTrue(path.startswith(self.folder), path)
        view = simple.FindView("View")
        self.assertIsNotNone(simple.GetLayout(view), "the window would not show the view")
        path = os.path.join(OUTPUT, "tutorial-state-%s.png" % name)
        simple.SaveScreenshot(path, view, ImageResolution=[SIDE, SIDE])
        drawn = picture(path)
        self.assertGreater((drawn.min(axis=2) < 0.8).mean(), 0.03, "nothing is drawn: " + path)
        return drawn

    def check_picture(self, drawn, name, most=0.2):
        shown = picture(os.path.join(SOURCE, "Documentation", "Images", name))
        self.assertLess(np.abs(means(drawn) - means(shown)).max(), most)

    def test_slice(self):
        self.check_picture(self.opened("slice"), "tutorial-slice.png")
        dots = simple.FindSource("Dots")
        self.assertEqual(output_of(dots).GetNumberOfPoints(), 20000)
        integral = output_of(simple.IntegrateVariables(Input=simple.FindSource("Slice")))
        expected = integral.GetPointData().GetArray("Smoke").GetValue(0)
        total = dots.FieldData["TotalMass"].GetRange()[0]
        self.assertLess(abs(total / expected - 1), 0.005)
        self.assertAlmostEqual(total / 255, 0.7846, 3)
        off = (positions(output_of(dots)) - [2, 2, 4]) @ [0.5, 1, 0]
        self.assertLess(np.abs(off).max(), 1e-6)

    def test_morph(self):
        middle = self.opened("morph")
        morph = simple.FindSource("Morph")
        np.testing.assert_allclose(morph.TimestepValues, np.arange(25) / 24)
        scene = simple.GetAnimationScene()
        self.assertEqual(scene.AnimationTime, 0.5)
        brain = simple.FindSource("Brain")
        values = vtk_to_numpy(output_of(brain).GetPointData().GetArray("T1")).astype(float)
        cell = np.prod(output_of(brain).GetSpacing())
        np.testing.assert_allclose(morph.FieldData["TotalMass"].GetRange()[0], values.sum() * cell,
                                   rtol=1e-9)
        scene.AnimationTime = 1
        path = os.path.join(OUTPUT, "tutorial-state-cow.png")
        simple.SaveScreenshot(path, simple.FindView("View"), ImageResolution=[SIDE, SIDE])
        self.assertGreater(np.abs(means(picture(path)) - means(middle)).max(), 0.2)
        # At the end it is the cow, to within two cells.
        found = simple.FindSource("Surface").GetDataInformation().GetBounds()
        cow = simple.FindSource("Place").GetDataInformation().GetBounds()
        np.testing.assert_allclose(found, cow, atol=5)

    def test_between(self):
        middle = self.opened("between")
        between = simple.FindSource("Between")
        np.testing.assert_allclose(between.TimestepValues, np.arange(25) / 24)
        scene = simple.GetAnimationScene()
        self.assertEqual(scene.AnimationTime, 0.5)
        self.assertGreater(np.abs(means(middle) - 1).max(), 0.2)
        for moment in (0, 1):
            scene.AnimationTime = moment
            between.UpdatePipeline(moment)
            values = vtk_to_numpy(output_of(between).GetPointData().GetArray("Smoke"))
            np.testing.assert_array_equal(values, smoke(moment)[0])

    def test_compare(self):
        self.check_picture(self.opened("compare"), "tutorial-compare.png")
        morph = simple.FindSource("Between")
        cost = output_of(morph).GetFieldData().GetArray("TransportCost").GetValue(0)
        self.assertAlmostEqual(cost, 1.76, 2)
        centres = [(places * values[:, None]).sum(axis=0) / values.sum()
                   for values, places in (smoke(0), smoke(1))]
        apart = np.linalg.norm(centres[1] - centres[0])
        self.assertAlmostEqual(apart, 1.27, 3)
        self.assertLess(apart, cost ** 0.5)
        self.assertGreater(simple.FindSource("Arrows").GetDataInformation().GetNumberOfPoints(), 999)

    def test_runs(self):
        self.check_picture(self.opened("runs"), "tutorial-runs.png", 0.3)  # the legend is dark
        differences = simple.FindSource("Differences")
        cost, least = (differences.FieldData[name].GetRange()[0]
                       for name in ("TransportCost", "TransportCostLowerBound"))
        self.assertAlmostEqual(cost ** 0.5, 0.60, 2)
        self.assertAlmostEqual(least ** 0.5, 0.598, 3)
        density = output_of(differences).GetPointData().GetArray("CostDensity")
        self.assertAlmostEqual(vtk_to_numpy(density).sum(), cost, 9)
        # On average the smoke moves with the wind, along x.
        points = output_of(simple.FindSource("Smoke")).GetPointData()
        ways = vtk_to_numpy(points.GetArray("Displacement"))
        self.assertGreater(ways[:, 0].mean(), 2 * np.abs(ways[:, 1:].mean(axis=0)).max())

    def test_people(self):
        self.check_picture(self.opened("people"), "tutorial-people.png")
        people = simple.FindSource("People")
        errors = vtk_to_numpy(output_of(people).GetCellData().GetArray("AreaError"))
        self.assertLess(np.abs(errors).max(), 0.0025)
        shown = simple.GetRepresentation(people, simple.FindView("View"))
        self.assertEqual(shown.Representation, "Filled Outlines With Edges")

    def test_mesh(self):
        self.check_picture(self.opened("mesh"), "tutorial-mesh.png")
        dots = output_of(simple.FindSource("Dots"))
        self.assertEqual(dots.GetNumberOfPoints(), 20000)
        integral = output_of(simple.IntegrateVariables(Input=simple.FindSource("Ink")))
        expected = integral.GetPointData().GetArray("Ink").GetValue(0)
        total = dots.GetFieldData().GetArray("TotalMass").GetValue(0)
        self.assertAlmostEqual(total / expected, 1, 6)
        self.assertAlmostEqual(total, 2.0394, 4)
        # Each disc is around its dot, flat along the normal and 0.016 wide across it.
        discs = positions(output_of(simple.FindSource("Discs"))).reshape(20000, -1, 3)
        off = discs - positions(dots)[:, None]
        normals = vtk_to_numpy(dots.GetPointData().GetArray("Normal"))
        along = np.abs((off * normals[:, None]).sum(axis=2))
        np.testing.assert_allclose(along.max(axis=1), 0.2 * 0.008, rtol=0.1)
        np.testing.assert_allclose(np.linalg.norm(off, axis=2).max(axis=1), 0.008, rtol=0.1)


class Script(unittest.TestCase):
    def test_script(self):
        printed = subprocess.run(
            [os.environ.get("RT_PVPYTHON", "pvpython"), os.path.join(SOURCE, FOLDER, "run.py"),
             "--output", OUTPUT, "--pixels", "200", "--frames", "3", "--resolution", "24"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True).stdout
        self.assertIn("20000 dots, 0.7846 m²", printed)
        self.assertEqual(printed.count("3 time steps"), 2)
        self.assertRegex(printed, re.escape("tutorial-compare.png: 1.327 m"))
        self.assertRegex(printed, re.escape("tutorial-runs.png: 0.599 m"))
        for name in ("morph", "between"):
            with open(os.path.join(OUTPUT, "tutorial-%s.ogv" % name), "rb") as film:
                data = film.read()
            self.assertEqual(data[:4], b"OggS")
            self.assertGreater(len(data), 4000)
        self.assertIn("tutorial-people.png: areas within 0.18 %", printed)
        self.assertIn("tutorial-mesh.png: 20000 dots, 2.0394 of ink", printed)
        for name in ("slice", "compare", "runs", "people", "mesh"):
            shown = picture(os.path.join(SOURCE, "Documentation", "Images",
                                         "tutorial-%s.png" % name))
            drawn = picture(os.path.join(OUTPUT, "tutorial-%s.png" % name))
            # Small pictures have wide lines, and the legend a third of the width.
            most = 0.06 if name in ("people", "runs") else 0.03
            self.assertLess(np.abs(means(drawn) - means(shown)).mean(), most)
        self.assertEqual(picture(os.path.join(OUTPUT, "tutorial-morph.png")).shape[1], 390)


if __name__ == "__main__":
    need_display()
    main()

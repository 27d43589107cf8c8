# SPDX-License-Identifier: BSD-3-Clause
"""The examples run, take a user's own file, and draw what their reference pictures show.

Call with --update to draw the reference pictures anew.
"""
import os
import re
import shutil
import subprocess
import sys
import unittest

import numpy as np
from rt_testing import OUTPUT, SOURCE, main, need_display
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkJPEGWriter, vtkPNGReader

DATA = os.path.join(SOURCE, "Testing", "Data")
SMALL = {"StippleImage": ["--particles", "5000", "--pixels", "800"],
         "Cartogram": ["--pixels", "480"],
         "SampleVolume": ["--particles", "50000", "--pixels", "400"]}


def run(example, *arguments):
    """What an example prints with arguments, and its exit code; its pictures go to OUTPUT."""
    script = os.path.join(SOURCE, "Examples", example, "run.py")
    done = subprocess.run([os.environ.get("RT_PVPYTHON", "pvpython"), script, "--output", OUTPUT,
                           *SMALL[example], *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True)
    return done.stdout, done.returncode


def read(path):
    """A PNG as rows, columns and RGB, and the image itself."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    width, height = image.GetDimensions()[:2]
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    return pixels[..., :3].astype(float), image


def blurred(pixels, block=4):
    """Means over blocks: what a rasteriser does at the edges of dots evens out."""
    height, width = (n - n % block for n in pixels.shape[:2])
    shape = (height // block, block, width // block, block, pixels.shape[2])
    return pixels[:height, :width].reshape(shape).mean(axis=(1, 3))


class Examples(unittest.TestCase):
    def check_picture(self, name):
        reference = os.path.join(DATA, "Baseline", name)
        drawn = os.path.join(OUTPUT, name)
        if "--update" in sys.argv:
            shutil.copy(drawn, reference)
        expected, found = read(reference)[0], read(drawn)[0]
        self.assertEqual(found.shape, expected.shape)
        difference = np.abs(blurred(found) - blurred(expected))
        self.assertLess(difference.mean(), 1, drawn)
        self.assertLess((difference > 40).mean(), 0.002, drawn)

    def test_stipple_image(self):
        said, code = run("StippleImage")
        self.assertEqual(code, 0, said)
        self.check_picture("stipple-raccoon.png")

    def test_stipple_has_the_tone_of_the_photograph(self):
        """The dots' discs overlap a little, so that the drawing is somewhat lighter."""
        said, code = run("StippleImage", os.path.join(DATA, "ascent.png"))
        self.assertEqual(code, 0, said)
        drawn = 1 - read(os.path.join(OUTPUT, "stipple-ascent.png"))[0].mean() / 255
        ink = 1 - read(os.path.join(DATA, "ascent.png"))[0].mean() / 255
        self.assertLess(abs(drawn - ink), 0.1)

    def test_svg(self):
        said, code = run("StippleImage", os.path.join(DATA, "ascent.png"))
        self.assertEqual(code, 0, said)
        with open(os.path.join(OUTPUT, "stipple-ascent.svg"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn('viewBox="0 0 512 512"', text)
        circles = np.array(re.findall(r'<circle cx="(\S+)" cy="(\S+)"', text), float)
        self.assertEqual(len(circles), 5000)
        self.assertTrue((circles >= 0).all() and (circles <= 512).all())
        # The darkest eighth of the picture's rows, counted from its top, has the most dots.
        rows = read(os.path.join(DATA, "ascent.png"))[0].mean(axis=(1, 2))[::-1]
        ink = (255 - rows).reshape(8, 64).sum(axis=1)
        counts = np.histogram(circles[:, 1], bins=8, range=(0, 512))[0]
        np.testing.assert_allclose(counts / counts.sum(), ink / ink.sum(), atol=0.02)

    def test_own_photograph(self):
        writer = vtkJPEGWriter()
        writer.SetInputData(read(os.path.join(DATA, "raccoon.png"))[1])
        writer.SetFileName(os.path.join(OUTPUT, "own.jpg"))
        writer.Write()
        said, code = run("StippleImage", os.path.join(OUTPUT, "own.jpg"))
        self.assertEqual(code, 0, said)
        self.assertTrue(os.path.isfile(os.path.join(OUTPUT, "stipple-own.png")))

    def test_no_such_file(self):
        for example in SMALL:
            said, code = run(example, "nowhere.png")
            self.assertNotEqual(code, 0)
            self.assertIn("nowhere.png", said)

    def test_not_an_image(self):
        for name, what in (("broken.vti", "ParaView has no reader for"), ("broken.png", "no image")):
            path = os.path.join(OUTPUT, name)
            with open(path, "w") as file:
                file.write("<VTKFile>")
            said, code = run("SampleVolume", path)
            self.assertNotEqual(code, 0)
            self.assertIn(path, said)
            self.assertIn(what, said)

    def test_cartogram(self):
        said, code = run("Cartogram")
        self.assertEqual(code, 0, said)
        self.check_picture("cartogram-raccoon.png")

    def test_sample_volume(self):
        said, code = run("SampleVolume")
        self.assertEqual(code, 0, said)
        self.check_picture("particles-brain-t1.png")


if __name__ == "__main__":
    need_display()
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of examples share: how they are run, what is printed, reference pictures.

Tests called with --update draw the reference pictures anew.
"""
import glob
import os
import re
import shutil
import sys
import unittest

import numpy as np
from rt_scripts import run_script
from rt_testing import OUTPUT, SOURCE
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

DATA = os.path.join(SOURCE, "Testing", "Data")
need_meshes = unittest.skipUnless(
    os.path.isfile(os.path.join(SOURCE, "build-meshes", "complete")),
    "needs the meshes that Testing/run.sh fetches")


def script(example):
    return os.path.join(SOURCE, "Examples", example, "run.py")


def examples(word=""):
    """The names of the examples whose script contains a word."""
    found = []
    for path in sorted(glob.glob(script("*"))):
        with open(path, encoding="utf-8") as file:
            if word in file.read():
                found.append(os.path.basename(os.path.dirname(path)))
    return found


def command(example, *arguments):
    """The script of an example and its arguments, those of --small but for what is given; its pictures
    go to OUTPUT."""
    return [script(example), "--output", OUTPUT, "--small", *arguments]


def run(example, *arguments):
    """An example's output, its messages, and its exit code."""
    return run_script(*command(example, *arguments))


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


def tables(printed):
    """The tables that an example prints: rows of cells, under their headings."""
    blocks = re.findall(r"^(?:  .*\n)+", printed, re.MULTILINE)
    return [[re.split("  +", line.strip()) for line in block.splitlines()[1:]] for block in blocks]


def first(cell):
    """The first number of a cell."""
    return float(cell.split()[0])


class ExampleTest(unittest.TestCase):
    """What tests of examples check."""

    def ran(self, example, *arguments):
        """The output of an example that runs without an error."""
        printed, messages, code = run(example, *arguments)
        self.assertEqual(code, 0, printed + messages)
        # But for what a driver that draws in software says once, with a right picture.
        errors = [line for line in messages.splitlines()
                  if "ERR|" in line and "OpenGL errors detected" not in line]
        self.assertEqual(errors, [])
        return printed

    def refused(self, example, *arguments):
        """What an example says that refuses its arguments."""
        printed, messages, code = run(example, *arguments)
        self.assertNotEqual(code, 0)
        return printed + messages

    def check_falls(self, numbers):
        """Numbers become less from one to the next."""
        numbers = [first(cell) for cell in numbers]
        self.assertEqual(numbers, sorted(numbers, reverse=True))
        self.assertLess(numbers[-1], numbers[0])

    def check_picture(self, name):
        """Against NAME and, as in VTK's own tests, NAME_1: what is as good with other last bits."""
        reference = os.path.join(DATA, "Baseline", name)
        drawn = os.path.join(OUTPUT, name)
        if "--update" in sys.argv:
            shutil.copy(drawn, reference)
        found = read(drawn)[0]
        differences = []
        for path in (reference, reference.replace(".png", "_1.png")):
            if os.path.exists(path):
                expected = read(path)[0]
                self.assertEqual(found.shape, expected.shape)
                differences.append(np.abs(blurred(found) - blurred(expected)))
        difference = min(differences, key=np.mean)
        self.assertLess(difference.mean(), 1, drawn)
        self.assertLess((difference > 40).mean(), 0.002, drawn)

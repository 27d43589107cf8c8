# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of examples share: small arguments, what is printed, reference pictures.

Tests called with --update draw the reference pictures anew.
"""
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
SMALL = {"StippleImage": ["--particles", "5000", "--pixels", "800"],
         "StipplePrint": ["--particles", "3000", "--panel", "160"],
         "VideoStippling": ["--size", "160", "--frames", "8", "--particles", "1000",
                            "--panel", "160"],
         "ColourStippling": ["--particles", "3000", "--iterations", "10", "--pixels", "480"],
         "Territories": ["--sites", "40", "--iterations", "10", "--resolution", "342", "--pixels",
                         "480"],
         "WarpedPhotograph": ["--pixels", "480"],
         "Cartogram": ["--pixels", "480"],
         "RasterWithGaps": ["--pixels", "600"],
         "Districts": ["--pixels", "600"],
         "AreaErrors": ["--cells", "128", "--pixels", "480"],
         "FieldDifference": ["--size", "64", "--panel", "160"],
         "PlumeEnsemble": ["--size", "48", "--panel", "220"],
         "BetweenSteps": ["--size", "40", "--every", "12", "--panel", "96"],
         "StippleSurface": ["--dots", "3000", "--panel", "300"],
         "ClosedSurfaces": ["--panel", "160"],
         "SampleVolume": ["--particles", "50000", "--pixels", "400"],
         "Figure2Paths": ["--particles", "2000", "--paths", "24", "--pixels", "480"],
         "Figure4Lookup": ["--resolutions", "16", "64", "--samples", "64", "--published", "48",
                           "--check", "40", "--size", "128", "--step-samples", "64",
                           "--steps", "5", "25", "--panel", "96"],
         "Figure5Cells": ["--sites", "64", "--resolution", "128", "--pixels", "480"],
         "PowerCells": ["--sites", "64", "--resolution", "64", "--drawn", "20", "--pixels", "480"],
         "Figure6Map": ["--size", "64", "--panel", "64"],
         "Figure7Steps": ["--size", "128", "--particles", "1500", "--steps", "2", "10", "50",
                          "--pictures", "2", "--panel", "128"],
         "Figure8Samples": ["--samples", "500", "2000", "--size", "256", "--sizes", "64", "128",
                            "--particles", "1000", "--repeats", "2", "--panel", "128"],
         "Figure10Relaxation": ["--size", "256", "--particles", "600", "--iterations", "1", "5",
                                "20", "--panel", "128"],
         "Table1Stippling": ["--size", "192", "--samples", "400", "600", "--iterations", "10",
                             "--panel", "96"],
         "Figure11Parameterization": ["--resolution", "128", "--panel", "160"],
         "FlowMaps": ["--size", "128", "--particles", "1500", "--panel", "160"],
         "Morph2D": ["--size", "64", "--frames", "3", "--panel", "96"],
         "Morph3D": ["--resolution", "32", "--frames", "3", "--panel", "120"],
         "OptimalTransport": ["--particles", "2000", "--size", "64", "--barycenter", "48", "--panel",
                              "240"],
         "Arrays": ["--size", "48", "--dots", "300", "--panel", "96"],
         "MorphAnimation": ["--size", "64", "--frames", "5", "--seconds", "1", "--pictures", "3",
                            "--panel", "120"],
         "InSitu": ["--particles", "2000", "--panel", "320"],
         "Barycenters2D": ["--size", "64", "--rows", "3", "--panel", "96"],
         "Barycenters3D": ["--resolution", "32", "--rows", "3", "--panel", "120"]}
SHAPES = {"Morph2D": 2, "Morph3D": 2, "MorphAnimation": 2, "Barycenters2D": 4, "Barycenters3D": 3}
need_meshes = unittest.skipUnless(
    os.path.isfile(os.path.join(SOURCE, "build-meshes", "complete")),
    "needs the meshes that Testing/run.sh fetches")
# examples that make their input
OWN = {"AreaErrors", "Arrays", "BetweenSteps", "Districts", "FieldDifference", "Figure2Paths", "Figure5Cells",
       "InSitu", "PlumeEnsemble", "PowerCells", "RasterWithGaps"}


def command(example, *arguments):
    """The script of an example and its arguments; its pictures go to OUTPUT."""
    return [os.path.join(SOURCE, "Examples", example, "run.py"), "--output", OUTPUT, *arguments,
            *SMALL[example]]


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

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
from PIL import Image
from rt_testing import OUTPUT, SOURCE, main, need_display
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOImage import vtkJPEGWriter, vtkPNGReader

DATA = os.path.join(SOURCE, "Testing", "Data")
SMALL = {"StippleImage": ["--particles", "5000", "--pixels", "800"],
         "StipplePrint": ["--particles", "3000", "--panel", "160"],
         "VideoStippling": ["--size", "160", "--frames", "8", "--particles", "1000",
                            "--panel", "160"],
         "ColourStippling": ["--particles", "3000", "--iterations", "10", "--pixels", "480"],
         "Territories": ["--sites", "40", "--iterations", "10", "--resolution", "342", "--pixels",
                         "480"],
         "Cartogram": ["--pixels", "480"],
         "StippleSurface": ["--dots", "3000", "--panel", "300"],
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
         "MorphAnimation": ["--size", "64", "--frames", "5", "--seconds", "1", "--pictures", "3",
                            "--panel", "120"],
         "InSitu": ["--particles", "2000", "--panel", "320"],
         "Barycenters2D": ["--size", "64", "--rows", "3", "--panel", "96"],
         "Barycenters3D": ["--resolution", "32", "--rows", "3", "--panel", "120"]}
SHAPES = {"Morph2D": 2, "Morph3D": 2, "MorphAnimation": 2, "Barycenters2D": 4, "Barycenters3D": 3}
need_meshes = unittest.skipUnless(
    os.path.isfile(os.path.join(SOURCE, "build-meshes", "complete")),
    "needs the meshes that Testing/run.sh fetches")
OWN = {"Figure2Paths", "Figure5Cells", "PowerCells", "InSitu"}  # examples that make their input


def run(example, *arguments):
    """What an example prints with arguments, and its exit code; its pictures go to OUTPUT."""
    script = os.path.join(SOURCE, "Examples", example, "run.py")
    done = subprocess.run([os.environ.get("RT_PVPYTHON", "pvpython"), script, "--output", OUTPUT,
                           *arguments, *SMALL[example]], stdout=subprocess.PIPE,
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


def tables(printed):
    """The tables that an example prints: rows of cells, under their headings."""
    blocks = re.findall(r"^(?:  .*\n)+", printed, re.MULTILINE)
    return [[re.split("  +", line.strip()) for line in block.splitlines()[1:]] for block in blocks]


def first(cell):
    """The first number of a cell."""
    return float(cell.split()[0])


class ExampleTest(unittest.TestCase):
    """What tests of examples check; those of stippling are in TestStippling.py and
    TestRelaxation.py."""

    def ran(self, example, *arguments):
        """The output of an example that runs."""
        printed, code = run(example, *arguments)
        self.assertEqual(code, 0, printed)
        return printed

    def refused(self, example, *arguments):
        """The output of an example that refuses its arguments."""
        printed, code = run(example, *arguments)
        self.assertNotEqual(code, 0)
        return printed

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


class Examples(ExampleTest):
    def check_falls(self, numbers):
        """Numbers become less from one to the next."""
        numbers = [first(cell) for cell in numbers]
        self.assertEqual(numbers, sorted(numbers, reverse=True))
        self.assertLess(numbers[-1], numbers[0])

    def stages(self, times):
        """What was timed; how long it took is the machine's, but the clock's seconds are there."""
        for row in times:
            self.assertRegex(row[1], r"^\d+\.\d\d$")
        return [row[0] for row in times]

    def test_stipple_image(self):
        self.ran("StippleImage")
        self.check_picture("stipple-raccoon.png")

    def test_svg(self):
        self.ran("StippleImage", os.path.join(DATA, "ascent.png"))
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
        self.ran("StippleImage", os.path.join(OUTPUT, "own.jpg"))
        self.assertTrue(os.path.isfile(os.path.join(OUTPUT, "stipple-own.png")))

    def test_no_such_file(self):
        for example in set(SMALL) - OWN:
            printed = self.refused(example, *["nowhere.png"] * SHAPES.get(example, 1))
            self.assertIn("nowhere.png", printed)

    def test_not_an_image(self):
        for name, what in (("broken.vti", "ParaView has no reader for"), ("broken.png", "no image")):
            path = os.path.join(OUTPUT, name)
            with open(path, "w") as file:
                file.write("<VTKFile>")
            printed = self.refused("SampleVolume", path)
            self.assertIn(path, printed)
            self.assertIn(what, printed)

    def live(self, *arguments):
        """What the live example prints, driving itself, and its exit code."""
        program = os.environ.get("RT_LIVE_STIPPLING")
        if not program:
            self.skipTest("the C++ examples are not built")
        done = subprocess.run([program, *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True,
                              env=dict(os.environ, OMP_WAIT_POLICY="passive"))
        return done.stdout, done.returncode

    def test_live_stippling(self):
        """It paints an S, turns the wheel, and erases; points glide."""
        path = os.path.join(OUTPUT, "live-stippling.png")
        printed, code = self.live("--side", "512", "--points", "4096", "--drive", "150",
                                  "--picture", path)
        self.assertEqual(code, 0, printed)
        adding, more, removing, fewer = tables(printed)[0]
        self.assertEqual([row[0] for row in (adding, more, removing, fewer)],
                         ["adding ink", "more points", "removing ink", "fewer points"])
        for row in adding, more, removing, fewer:
            self.assertGreater(first(row[1]), 15)  # updates in which points moved
            self.assertGreater(first(row[2]), first(row[3]))  # drawing takes time, too
        # Four turns of the wheel by a tenth each, and back.
        self.assertEqual([row[4] for row in (adding, more, removing, fewer)],
                         ["4096", "5998", "5998", "4096"])
        self.assertEqual([row[5] for row in (adding, more, removing, fewer)],
                         ["0", "0", "0", "1902"])
        # Dots are 8 cells apart: none jumps; the way round a hole that is being erased is longer.
        for row, cells in (adding, 24), (more, 24), (removing, 100), (fewer, 100):
            self.assertLess(first(row[6]), cells, printed)
        drawn = read(path)[0]
        dark = (drawn.max(axis=2) < 40)
        self.assertEqual(drawn.shape, (900, 900, 3))

        def share(x, y, half=30):
            x, y = round(900 * x), round(900 * y)
            return dark[y - half:y + half, x - half:x + half].mean()

        paper = share(0.15, 0.85)  # of ten per cent of ink
        self.assertTrue(0.05 < paper < 0.2, paper)
        self.assertGreater(share(0.26, 0.62), 3 * paper)  # of the S
        self.assertLess(share(0.25, 0.25, 15), 0.1 * paper)  # erased

    def test_live_stippling_refuses(self):
        for arguments, words in ((["--points", "0"], "--points is 0; it must be from 1 to 200000"),
                                 (["--side", "9x"], "--side is 9x; it must be from 64 to 4096"),
                                 (["--drive"], "--drive needs a value"),
                                 (["--what"], "unknown argument --what")):
            printed, code = self.live(*arguments)
            self.assertEqual(code, 2, printed)
            self.assertIn(words, printed)
            self.assertIn("usage: LiveStippling", printed)
        path = os.path.join(OUTPUT, "live-broken.png")
        with open(path, "w", encoding="utf-8") as file:
            file.write("no picture")
        printed, code = self.live(path, "--drive", "5")
        self.assertEqual((printed, code), (path + " holds no picture that can be read\n", 1))

    def test_cartogram(self):
        self.ran("Cartogram")
        self.check_picture("cartogram-raccoon.png")

    def test_sample_volume(self):
        self.ran("SampleVolume")
        self.check_picture("particles-brain-t1.png")

    def test_not_a_picture(self):
        printed = self.refused("Figure7Steps", os.path.join(DATA, "brain-t1.vti"))
        self.assertIn("90 x 108 x 90 values; it must be a picture", printed)

    def test_not_a_number(self):
        printed = self.refused("FlowMaps", "--time", "1")
        self.assertIn("--time is 1; it must lie between 0 and 1", printed)
        for example, option in ("Figure2Paths", "--cells"), ("Figure8Samples", "--sizes"):
            printed = self.refused(example, option, "0")
            self.assertIn("argument %s: 0 is not a whole number of at least" % option, printed)

    def test_figure_2(self):
        printed = self.ran("Figure2Paths")
        errors, curve = tables(printed)
        mean = {row[0]: row[1] for row in errors}
        self.check_falls(mean["Multistep, N = %d" % n] for n in (8, 16, 32, 64, 128))
        self.assertLess(first(mean["Multistep, N = 32"]), 0.05)
        self.assertEqual(curve[0][1:], ["256.00", "256.00", "256"])
        self.assertAlmostEqual(first(curve[1][1]), first(curve[1][2]), delta=0.1)
        self.check_picture("figure2-paths.png")

    def test_figure_4(self):
        printed = self.ran("Figure4Lookup")
        lookup, steps = tables(printed)
        coarse, fine, _ = lookup
        self.assertGreater(first(coarse[1]), 90)
        self.assertTrue(0 < first(fine[1]) < 90, fine)
        for row in coarse, fine:
            self.assertEqual(row[2:4], ["0", "0"])
            self.assertTrue(0.05 < first(row[4]) < 0.5, row)
        for column in 1, 2, 3:
            self.check_falls(row[column] for row in steps[:-1])
        for row in steps[:-1]:  # at as many velocities
            self.assertLess(2 * first(row[3]), first(row[1]))
        drawn = read(os.path.join(OUTPUT, "figure4-lookup.png"))[0]
        black = (drawn[-120:-30] == 0).all(axis=2)  # in the upper row, where there is NaN
        self.assertTrue(black[:, 12:104].all())
        self.assertTrue(0 < black[:, 118:210].mean() < 0.9)

    def test_figure_5(self):
        printed = self.ran("Figure5Cells")
        masses, costs = tables(printed)
        for row in masses[:-1]:
            self.assertEqual(row[1:3], ["256 to 256", "0"])
        for column in (1, 2, 3, 4):  # the corners are far from the disc
            self.assertLess(first(costs[0][column]), first(costs[1][column]))
        self.check_picture("figure5-cells.png")

    def test_power_cells(self):
        printed = self.ran("PowerCells")
        rows, = tables(printed)
        self.assertEqual([row[0] for row in rows], ["random", "blue noise", "clusters"])
        for row in rows:
            self.assertGreater(float(row[3]), 1)  # nothing costs less than Power
            self.assertLess(float(row[5]), 1e-6)
        self.check_picture("power-cells-random.png")

    def test_territories(self):
        printed = self.ran("Territories")
        rows, = tables(printed)
        self.assertEqual([row[0] for row in rows], ["Flow", "Power"])
        self.assertLess(float(rows[0][1]), .1)  # a pixel of a city
        self.assertLess(float(rows[1][1]), 1e-6)
        self.check_falls([row[3] for row in rows])
        for shape in ("flow", "power"):
            self.check_picture("territories-night-europe-%s.png" % shape)

    def test_figure_6(self):
        printed = self.ran("Figure6Map")
        errors, maps = tables(printed)
        found = {(row[0], row[1]): row[2:] for row in errors}
        for row in maps[:-1]:
            for column in range(3):
                self.check_falls(found[row[0], "Multistep, %d" % n][column] for n in (32, 64))
            self.assertLess(first(found[row[0], "Multistep, 64"][1]), 1)
        for there, back in (maps[0], maps[1]), (maps[2], maps[3]):
            self.assertAlmostEqual(first(there[4]) / first(back[4]), 1, delta=0.01)
        self.assertEqual(found["subject, paper, against the optimum", "RK4, 50"][2], "125 %")
        self.check_picture("figure6-map.png")

    def test_figure_7(self):
        printed = self.ran("Figure7Steps")
        rows = tables(printed)[0]
        for column in 1, 2, 3:
            self.check_falls(row[column] for row in rows[:3])
            self.assertTrue(all(row[column].endswith("/ 0") for row in rows[:3]), rows)
        for row in rows[:3]:
            self.assertLess(5 * first(row[1]), first(row[2]))
        self.assertLess(float(rows[3][1].split(" / ")[1]), float(rows[0][1].split(" / ")[1]))
        drawn = read(os.path.join(OUTPUT, "figure7-steps.png"))[0]
        self.assertTrue(50 < drawn.mean() < 205)

    def test_figure_8(self):
        printed = self.ran("Figure8Samples")
        rows, whole = tables(printed)
        self.check_falls(row[5] for row in rows[:2])
        for row in rows[:4]:
            self.assertTrue(0.7 < first(row[6]) < 0.9, row)
        self.assertEqual([row[2] for row in whole], ["0.042, 0.048", "0.080", "0.12"])
        drawn = read(os.path.join(OUTPUT, "figure8-samples.png"))[0]
        self.assertTrue(50 < drawn.mean() < 205)

    def test_flow_maps(self):
        """Finer lattices are closer, and a flow map is as accurate as the steps it replaces."""
        interpolation, (off, on) = tables(self.ran("FlowMaps"))
        for column in 1, 2, 3:
            self.check_falls(row[column] for row in interpolation)
        self.assertLess(first(interpolation[-1][1]), 0.05)
        self.assertNotEqual(on, off)
        self.assertLess(first(on[1]), 1.1 * first(off[1]))
        self.check_picture("flow-maps.png")

    def test_in_situ(self):
        """Particles pass between the ranks, and are those of one rank."""
        printed = self.ran("InSitu")
        if "Left out" in printed:
            self.skipTest(printed)
        two, one = tables(printed)
        for rows in two, one:
            self.assertEqual([row[:2] for row in rows],
                             [[time + " s", "2000"] for time in ("0.0", "3.2", "6.4")])
        for row, alone in zip(two, one):
            parts = [int(part) for part in row[2].split(" + ")]
            self.assertEqual((len(parts), sum(parts)), (2, 2000))
            self.assertGreater(min(parts), 100)
            self.assertEqual(alone[2:], ["2000", "0"])
        self.assertGreater(int(two[1][3]), 0)
        self.assertIn("The bits of one rank: particles-0000.pvtp, particles-0640.pvtp, "
                      "particles-1280.pvtp, trajectories.vtp", printed)
        moves = re.search(r"by (\S+) on average, 99 % by less than (\S+)", printed)
        self.assertLess(float(moves.group(1)), 0.05)
        self.assertLess(float(moves.group(2)), 0.25)
        self.check_picture("in-situ.png")

    @need_meshes
    def test_stipple_surface(self):
        """More of the dots where it bends, and not much less even than in the plane."""
        area, curvature = tables(self.ran("StippleSurface"))[0]
        for row in area, curvature:
            self.assertEqual(row[1], "3000")
            self.assertGreater(first(row[3]), 0.55)
        self.assertLess(first(curvature[2]), first(area[2]))  # the density is at most 1
        self.check_picture("stipple-surface-lion-head.png")

    def test_a_surface_that_is_no_disk(self):
        for example in "StippleSurface", "Figure11Parameterization":
            printed = self.refused(example, os.path.join(DATA, "spot.vtp"))
            self.assertIn("The input surface is closed: it has no boundary", printed)

    @need_meshes
    def test_figure_11(self):
        rows = tables(self.ran("Figure11Parameterization", "nefertiti", "mushroom"))[0]
        for tutte, conformal, flow, polish in rows[:4], rows[4:]:
            self.assertEqual(tutte[0].split()[1], {"nefertiti": "(562)", "mushroom": "(4608)"}[
                tutte[0].split()[0]])
            self.assertEqual([row[0] for row in (conformal, flow, polish)],
                             ["conformal", "flow alone", "and polish"])
            for map_ in tutte[1:], conformal:  # both far
                self.assertGreater(first(map_[1]), 0.4)
            self.assertLess(first(conformal[5]), first(flow[5]))
            self.assertLess(first(flow[1]), first(conformal[1]) / 2)
            self.assertLess(20 * first(polish[1]), first(conformal[1]))
            self.assertLess(first(polish[2]), 0.01)
            self.assertLess(first(polish[3]), 0.05)
            self.assertEqual(polish[4], "0")
        self.check_picture("figure11-nefertiti.png")
        self.check_picture("figure11-mushroom.png")

    @need_meshes
    def test_morph_2d(self):
        printed = self.ran("Morph2D")
        times = tables(printed)[0]
        self.assertEqual([row[0] for row in times],
                         ["bunny to camel+dinosaur", "knot to coupling", "bull to rings"])
        self.check_picture("morph-2d.png")

    def test_morph_of_a_shape_into_itself(self):
        """All of its frames are alike but for the colour."""
        self.ran("Morph2D", "spot", "spot")
        drawn = 255 - read(os.path.join(OUTPUT, "morph-2d.png"))[0].mean(axis=2)
        frames = [drawn[10:106, left:left + 96] for left in (10, 116, 222)]
        self.assertTrue(0.1 < (frames[0] > 0.5 * frames[0].max()).mean() < 0.4)
        for frame in frames[1:]:
            np.testing.assert_allclose(frame / frame.max(), frames[0] / frames[0].max(), atol=0.02)

    @need_meshes
    def test_morph_3d(self):
        printed = self.ran("Morph3D")
        steps = ["two maps, step t = 0", "its surface", "step t = 0.50", "its surface",
                 "step t = 1.00", "its surface"]
        self.assertEqual(
            [self.stages(times) for times in tables(printed)],
            [["solid of spot", "solid of " + other, *steps] for other in ("bunny", "eight")])
        self.check_picture("morph-3d.png")

    def test_morph_of_an_own_surface(self):
        """A cube of separate triangles to itself stays a cube."""
        source = vtkCubeSource()
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(source.GetOutputPort())
        writer = vtkSTLWriter()
        writer.SetInputConnection(triangles.GetOutputPort())
        writer.SetFileName(os.path.join(OUTPUT, "own.stl"))
        writer.Write()
        self.ran("Morph3D", *[os.path.join(OUTPUT, "own.stl")] * 2)
        drawn = read(os.path.join(OUTPUT, "morph-3d.png"))[0]
        inked = [(drawn[10:130, left:left + 120] < 250).any(axis=2).mean() for left in
                 (10, 140, 270)]
        self.assertGreater(inked[0], 0.3)
        np.testing.assert_allclose(inked, inked[0], rtol=0.02)

    def test_not_a_surface(self):
        for name, text in (("broken.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                           ("binary.off", "OFF BINARY\n3 1 0\n"), ("broken.stl", "solid\n")):
            path = os.path.join(OUTPUT, name)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            printed = self.refused("Morph3D", path, "spot")
            self.assertIn(path + " holds no ", printed)
        printed = self.refused("Barycenters3D", "spot", "brain", "knot")
        self.assertIn("the shapes with names are armadillo, bear", printed)

    @need_meshes
    def test_an_open_surface(self):
        """The filter's error is printed, and no picture is left."""
        drawn = os.path.join(OUTPUT, "morph-3d.png")
        if os.path.exists(drawn):
            os.remove(drawn)
        mesh = os.path.join(SOURCE, "build-meshes", "lion-head.off")
        printed = self.refused("Morph3D", mesh, "spot")
        self.assertIn("The input surface is not closed: it has ", printed)
        self.assertIn("every edge must be one of two triangles, or of another even number", printed)
        self.assertFalse(os.path.exists(drawn))

    def test_number_of_shapes(self):
        for example, number in SHAPES.items():
            printed = self.refused(example, "spot")
            self.assertIn("1 shapes are given; it must be", printed)

    @need_meshes
    def test_morph_animation(self):
        """The cross-fade's middle is the mean of its ends; the morph's is not, for mass moves."""
        self.ran("MorphAnimation")
        with Image.open(os.path.join(OUTPUT, "morph-animation.gif")) as film:
            self.assertEqual((film.n_frames, film.info["duration"], film.info["loop"]), (8, 250, 0))
        drawn = read(os.path.join(OUTPUT, "morph-animation.png"))[0]
        for low, fades in (10, True), (166, False):
            start, middle, end = (drawn[low:low + 120, left:left + 120]
                                  for left in (10, 140, 270))
            difference = np.abs(middle - (start + end) / 2)
            self.assertEqual((difference > 12).mean() < 0.01, fades)
        self.check_picture("morph-animation.png")

    @need_meshes
    def test_barycenters_2d(self):
        self.ran("Barycenters2D")
        self.check_picture("barycenters-2d.png")

    @need_meshes
    def test_barycenters_3d(self):
        printed = self.ran("Barycenters3D")
        self.assertEqual(self.stages(tables(printed)[0]),
                         ["three solids", "three maps, the first barycenter and surface",
                          "another barycenter and surface"])
        self.check_picture("barycenters-3d.png")


if __name__ == "__main__":
    need_display()
    main()

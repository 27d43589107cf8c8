# SPDX-License-Identifier: BSD-3-Clause
"""The examples run, take a user's own file, and draw what their reference pictures show: see
rt_examples.py. Those of stippling are in TestStippling.py and TestRelaxation.py, those of shapes in
TestExampleShapes.py, those of the paper's figures in TestPaperFigures.py."""
import os
import re
import subprocess
import sys

import numpy as np
from rt_examples import DATA, ExampleTest, examples, first, need_meshes, read, tables
from rt_testing import OUTPUT, SOURCE, main, need_display
from vtkmodules.vtkIOImage import vtkJPEGWriter


class Examples(ExampleTest):
    def test_stipple_image(self):
        self.ran("StippleImage")
        self.check_picture("stipple-raccoon.png")

    def test_svg(self):
        self.ran("StippleImage", os.path.join(DATA, "ascent.png"))
        with open(os.path.join(OUTPUT, "stipple-ascent.svg"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn('viewBox="0 0 200 200"', text)
        circles = np.array(re.findall(r'<circle cx="(\S+)" cy="(\S+)"', text), float)
        self.assertEqual(len(circles), 5000)
        self.assertTrue((circles >= 0).all() and (circles <= 200).all())
        # The darkest eighth of the picture's rows, counted from its top, has the most dots.
        rows = read(os.path.join(DATA, "ascent.png"))[0].mean(axis=(1, 2))[::-1]
        ink = (255 - rows).reshape(8, 64).sum(axis=1)
        counts = np.histogram(circles[:, 1], bins=8, range=(0, 200))[0]
        np.testing.assert_allclose(counts / counts.sum(), ink / ink.sum(), atol=0.02)

    def test_own_photograph(self):
        writer = vtkJPEGWriter()
        writer.SetInputData(read(os.path.join(DATA, "raccoon.png"))[1])
        writer.SetFileName(os.path.join(OUTPUT, "own.jpg"))
        writer.Write()
        self.ran("StippleImage", os.path.join(OUTPUT, "own.jpg"))
        self.assertTrue(os.path.isfile(os.path.join(OUTPUT, "stipple-own.png")))

    def test_no_such_file(self):
        """Every example names the file, also one that takes none; those of shapes want several."""
        for example in examples():
            for number in range(1, 5):
                printed = self.refused(example, *["nowhere.png"] * number)
                if "%d shapes are given; it must be" % number not in printed:
                    break
            self.assertIn("nowhere.png", printed, example)

    def test_small(self):
        """--small stands for other arguments, and what is given before or after it wins."""
        sys.path.insert(0, os.path.join(SOURCE, "Examples"))
        from rectified_arguments import number, parser

        def parsed(*arguments):
            found = parser("", small="--size 48 --steps 2 10", image=dict(nargs="*", default=["a"]),
                           size=128, steps=number([5], "steps"), panel=360).parse_args(arguments)
            return found.image, found.size, found.steps, found.panel

        self.assertEqual(parsed(), (["a"], 128, [5], 360))
        self.assertEqual(parsed("--small"), (["a"], 48, [2, 10], 360))
        self.assertEqual(parsed("--small", "b", "--panel", "16"), (["b"], 48, [2, 10], 16))
        for given in ["--size", "128", "--small"], ["--small", "--size", "128"]:
            self.assertEqual(parsed(*given), (["a"], 128, [2, 10], 360))

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

    def test_live_stippling_on_a_device(self):
        """Points go the same ways with a device, without one, and with one that is not there."""
        moves = []
        for device in [], ["--device", "any"], ["--device", "no such thing"]:
            printed, code = self.live("--side", "64", "--points", "300", "--drive", "10", *device)
            self.assertEqual(code, 0, printed)
            if "any" not in device or "RT_OPENCL" in os.environ:
                self.assertEqual("the processor did the work" in printed,
                                 "no such thing" in device, printed)
            moves.append([(row[4], row[5], row[6]) for row in tables(printed)[0]])
        self.assertEqual(moves[1:], [moves[0]] * 2)

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

    def test_warped_photograph(self):
        self.ran("WarpedPhotograph")
        self.check_picture("warped-raccoon.png")

    def test_raster_with_gaps(self):
        """With the sea at the mean, the island keeps about its size; without, it fills the raster."""
        mean, zero = ([first(number) for number in re.findall(r"\d+\.?\d*", line)] for line in
                      self.ran("RasterWithGaps").splitlines()[:2])
        self.assertTrue(mean[0] < 5 and 30 < mean[1] < 70, mean)
        self.assertGreater(zero[1], 95)
        self.check_picture("gaps.png")

    def test_districts(self):
        """Power gives everybody as many; Flow nearly."""
        for line, off in zip(self.ran("Districts").splitlines(), (0, 60)):
            least, most = (first(number) for number in re.findall(r"\d+", line)[1:3])
            self.assertTrue(0 <= most - least <= off, line)
        self.check_picture("districts.png")

    def test_cartogram(self):
        """Every state has the area of its people."""
        line = self.ran("Cartogram").splitlines()[0]
        self.assertTrue(line.startswith("49 regions"), line)
        self.assertLess(float(line.split()[-1]), 0.005)
        self.check_picture("cartogram.png")

    def test_area_errors(self):
        """With as many steps as needed, hardly a block is off and no cell folds."""
        few, enough = self.ran("AreaErrors").splitlines()[-3:-1]
        numbers = [[float(word) for word in re.findall(r"\d+\.?\d*", line)] for line in (few, enough)]
        (steps, *_, largest, _, _, folded), (more, *_, left, _, _, none) = numbers
        self.assertEqual((steps, none), (32, 0))
        self.assertTrue(100 < more < 500, more)
        self.assertTrue(folded > 50 and left < 0.6 * largest, numbers)
        self.check_picture("area-errors.png")

    def test_field_difference(self):
        """The optimal map costs about its bound, and the flow more."""
        flow, optimal = self.ran("FieldDifference").splitlines()[-4:-2]
        costs, bounds = zip(*([float(word) for word in line.split()[1:3]] for line in (flow, optimal)))
        self.assertAlmostEqual(costs[1] / bounds[1], 1, delta=0.02)
        self.assertGreater(costs[0], 1.2 * costs[1])
        self.check_picture("field-difference.png")

    def test_plume_ensemble(self):
        """Distances find the order of the winds, differences of values do not."""
        (by_distance, by_values), = (table for table in tables(self.ran("PlumeEnsemble")))
        self.assertGreater(first(by_distance[1]), 0.95)
        self.assertLess(first(by_values[1]), 0.8)
        self.check_picture("plume-ensemble.png")

    def test_between_steps(self):
        """Mass that moves is nearer to the steps that were left out than a cross-fade, by both measures."""
        rows, = tables(self.ran("BetweenSteps"))
        for column in (2, 3):
            plume, faded_plume, pair, faded_pair = (float(row[column]) for row in rows)
            self.assertLess(plume, 0.6 * faded_plume)
            self.assertLess(pair, 0.9 * faded_pair)
        self.check_picture("between-steps.png")

    def test_sample_volume(self):
        self.ran("SampleVolume")
        self.check_picture("particles-brain-t1.png")

    def test_not_a_number(self):
        printed = self.refused("FlowMaps", "--time", "1")
        self.assertIn("--time is 1; it must lie between 0 and 1", printed)

    def test_power_cells(self):
        printed = self.ran("PowerCells")
        rows, = tables(printed)
        self.assertEqual([row[0] for row in rows], ["random", "blue noise", "clusters"])
        for row in rows:
            self.assertGreater(float(row[3]), 1)  # nothing costs less than Power
            self.assertLess(float(row[5]), 1e-6)
        self.check_picture("power-cells-random.png")

    def test_arrays(self):
        """The bounds are near each other, and 0 of a density and itself."""
        rows, = tables(self.ran("Arrays"))
        bounds = [float(row[1]) for row in rows]
        self.assertEqual(len(rows), 4)
        for row in rows[:3]:
            self.assertLess(float(row[1]), float(row[2]))
            self.assertLess(float(row[2]), 1.05 * float(row[1]))
        self.assertEqual(bounds[3], 0)
        self.assertGreater(min(bounds[:3]), 3)
        self.check_picture("arrays.png")

    def test_optimal_transport(self):
        """The optimal map is nearer to the bound, leaves alone what stands still, and lowers the
        functional."""
        dots, disks, functional = tables(self.ran("OptimalTransport"))
        (flow, *_), (best, *_) = [row[3:] for row in dots]
        self.assertEqual([row[0] for row in dots], ["RectifiedFlow", "Optimal"])
        self.assertEqual(dots[0][1], dots[1][1])
        self.assertTrue(first(best) < 1 < first(flow), dots)
        for flow, best in disks[:2], disks[2:]:
            self.assertLess(8 * first(best[4]), first(flow[4]))
            self.assertLess(10 * first(best[3]), first(flow[3]))
        self.assertLess(first(disks[1][4]), 0.1)
        self.check_falls(row[1] for row in functional)
        for name in "stipples", "ways", "barycenter":
            self.check_picture("optimal-%s.png" % name)

    def test_territories(self):
        printed = self.ran("Territories")
        rows, = tables(printed)
        self.assertEqual([row[0] for row in rows], ["Flow", "Power"])
        self.assertLess(float(rows[0][1]), .1)  # a pixel of a city
        self.assertLess(float(rows[1][1]), 1e-6)
        self.check_falls([row[3] for row in rows])
        for shape in ("flow", "power"):
            self.check_picture("territories-night-europe-%s.png" % shape)

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
        """More of the dots where it bends."""
        area, curvature = tables(self.ran("StippleSurface"))[0]
        for row in area, curvature:
            self.assertEqual(row[1], "3000")
        self.assertGreater(first(area[3]), 0.88)
        self.assertLess(first(curvature[2]), first(area[2]))  # the density is at most 1
        self.check_picture("stipple-surface-bunny.png")

    def test_a_closed_surface(self):
        path = os.path.join(DATA, "spot.vtp")
        self.assertEqual(tables(self.ran("StippleSurface", path))[0][0][1], "3000")

    @need_meshes
    def test_closed_surfaces(self):
        """A surface with two handles becomes one disk with equal areas."""
        row = tables(self.ran("ClosedSurfaces", "eight"))[0][0]
        self.assertEqual(row[0], "eight (634)")
        self.assertGreater(int(row[1]), 20)  # two cuts a handle
        self.assertLess(first(row[2]), 0.01)
        self.assertLess(first(row[3]), 0.05)
        self.assertEqual(row[4], "0")
        self.check_picture("closed-surfaces.png")


if __name__ == "__main__":
    need_display()
    main()

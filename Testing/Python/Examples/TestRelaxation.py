# SPDX-License-Identifier: BSD-3-Clause
"""The examples of relaxed stipplings: their figures, and what their reference pictures show.

`python3 Testing/Python/run.py TestRelaxation --update` draws the reference pictures anew.
"""
import os
import sys
import unittest

import numpy as np
from rt_examples import DATA, ExampleTest, first, read, tables
from rt_testing import OUTPUT, SOURCE, main, need_display

PHOTOGRAPHS = [os.path.join(DATA, name) for name in ("raccoon.png", "ascent.png")]


class Energy(unittest.TestCase):
    def test_pixel_energy(self):
        """The distances from all points, without a tree."""
        sys.path.insert(0, os.path.join(SOURCE, "Examples"))
        from rectified_relaxation import pixel_energy
        random = np.random.default_rng(4)
        points, ink = 8 * random.random((7, 2)), random.random((6, 8))
        energy = 0
        for (row, column), mass in np.ndenumerate(ink):
            energy += mass * ((points - [column + 0.5, row + 0.5]) ** 2).sum(axis=1).min()
        self.assertAlmostEqual(pixel_energy(points, ink), 7 * energy / (48 * ink.sum()), places=12)

    def test_lattice(self):
        """A square lattice in a uniform density has 1/6, but for the size of the pixels."""
        sys.path.insert(0, os.path.join(SOURCE, "Examples"))
        from rectified_relaxation import pixel_energy
        centres = np.indices((4, 4)).reshape(2, -1).T * 16 + 8
        self.assertAlmostEqual(pixel_energy(centres, np.ones((64, 64))), (1 - 1 / 256) / 6)


class Figure10(ExampleTest):
    def test_figure_10(self):
        """Both starts end alike, ours begins near the end, and both pictures are drawn."""
        ends, reached = tables(self.ran("Figure10Relaxation"))
        self.assertEqual([row[:3] for row in ends],
                         [[method, start, "20"]
                          for method in ("GaussianBlueNoise", "OptimalTransport")
                          for start in ("random", "ours")])
        for random, ours in (ends[:2], ends[2:]):
            for column in 4, 6:  # energies before the first iteration
                self.assertLess(1.5 * first(ours[column]), first(random[column]))
                self.assertLess(first(ours[column + 1]), first(ours[column]))
            self.assertAlmostEqual(first(ours[7]) / first(random[7]), 1, delta=0.05)
        self.assertLess(first(ends[3][8]), -2.5)
        for row in reached:
            if "more" not in row[4]:
                self.assertLessEqual(first(row[4]), first(row[1]), row)
        self.assertEqual([row[4] for row in reached if row[1] == "1"], ["0", "0"])
        self.check_picture("figure10-points.png")
        chart = read(os.path.join(OUTPUT, "figure10-energy.png"))[0]
        orange, blue = ((np.abs(chart - [255 * part for part in colour]).max(axis=2) < 30)
                        for colour in ((0.8, 0.36, 0.1), (0.15, 0.35, 0.65)))
        height, width = chart.shape[:2]
        for low in 0, height // 2:  # two by two charts have both curves
            for left in 0, width // 2:
                for colour in orange, blue:
                    self.assertGreater(colour[low:low + height // 2, left:left + width // 2].sum(),
                                       30)

    def test_refused(self):
        for option, words in (("--repeats", "--repeats: 0 is not a whole number"),
                              ("--particles", "--particles: 0 is not a whole number")):
            self.assertIn(words, self.refused("Figure10Relaxation", option, "0"))


class Table1(ExampleTest):
    def test_table_1(self):
        """Relaxed dots are more even, those of optimal transport have the least energy, and the
        pictures have the photographs' ink."""
        rows, paper = tables(self.ran("Table1Stippling", *PHOTOGRAPHS))
        self.assertEqual([row[:2] for row in rows],
                         [[name, kind] for name in ("raccoon, 400", "ascent, 600")
                          for kind in ("direct", "GBN", "BNOT")])
        for direct, gaussian, transport in rows[:3], rows[3:]:
            self.assertLess(first(transport[3]), first(gaussian[3]))
            self.assertLess(first(gaussian[3]), first(direct[3]))
            self.assertAlmostEqual(100 * (first(transport[3]) / first(direct[3]) - 1),
                                   first(transport[4]), delta=0.1)
            for column in 5, 6:
                self.assertLess(first(direct[column]), first(gaussian[column]))
                self.assertLess(first(direct[column]), first(transport[column]))
        self.assertEqual([row[3] for row in paper], ["173", "1612", "5653", "1056"])
        for kind in "direct", "GBN", "BNOT":
            drawn = read(os.path.join(OUTPUT, "table1-2-ascent-%s.png" % kind))[0]
            self.assertEqual(drawn.shape[:2], (192, 192))
            self.assertAlmostEqual(drawn.mean() / read(PHOTOGRAPHS[1])[0].mean(), 1, delta=0.15)
        self.check_picture("table1-stippling.png")

    def test_on_a_device(self):
        """The dots of a device are those of the processor, and where none is, the table says so."""
        for device in "any", "no such thing":
            rows, _, found, paper = tables(self.ran("Table1Stippling", PHOTOGRAPHS[0],
                                                    "--samples", "400", "--device", device))
            self.assertEqual(len(rows), 3)
            (name, _, seconds, points), = found
            self.assertEqual((name, points), ("raccoon, 400", "the same"))
            if device != "any" or "RT_OPENCL" in os.environ:
                self.assertEqual(seconds == "none", device != "any")
            self.assertEqual([row[2] for row in paper], ["0.012", "0.012", "0.018", "0.030"])

    def test_without_skimage(self):
        """Four photographs without naming any, whatever is installed."""
        rows = tables(self.ran("Table1Stippling"))[0]
        self.assertEqual(len(rows), 12)
        self.assertEqual([row[0].split(",")[0] for row in rows[:6:3]], ["raccoon", "ascent"])

    def test_refused(self):
        for arguments, words in ((["--samples", "0"], "--samples: 0 is not a whole number"),
                                 (["--threading", "VTK"], "invalid choice: 'VTK'")):
            self.assertIn(words, self.refused("Table1Stippling", *arguments))


if __name__ == "__main__":
    need_display()
    main()

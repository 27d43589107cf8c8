# SPDX-License-Identifier: BSD-3-Clause
"""The examples of the paper's figures: what they print, and what their reference pictures show.
Figure 10 and Table 1 are in TestRelaxation.py.

`python3 Testing/Python/run.py TestPaperFigures --update` draws the reference pictures anew.
"""
import os

from rt_examples import DATA, ExampleTest, first, need_meshes, read, tables
from rt_testing import OUTPUT, main, need_display


class PaperFigures(ExampleTest):
    def test_not_a_picture(self):
        printed = self.refused("Figure7Steps", os.path.join(DATA, "brain-t1.vti"))
        self.assertIn("90 x 108 x 90 values; it must be a picture", printed)

    def test_not_a_number(self):
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
            for row in there, back:
                errors = found[row[0], "the flow against the optimal map"]
                self.assertGreater(first(errors[1]), 2)
                self.assertLess(first(errors[1]), 50)
                self.assertLess(first(row[5]), 2)  # percent, of a small picture
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

    def test_a_closed_surface(self):
        self.assertIn("The input surface is closed: it has no boundary",
                      self.refused("Figure11Parameterization", os.path.join(DATA, "spot.vtp")))


if __name__ == "__main__":
    need_display()
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Three ranks with a fault on one of them: all end, with one message, or the result is right."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from rt_testing import SKIPPED, main

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_errors_script.py")
RANKS = 3

# What the one message, on the first rank, has.
MESSAGES = {
    "spacing": "The images of the ranks are not parts of one: the spacing is 1 1 1 on rank 0, but "
               "1 1 2 on rank 1",
    "association": "The density is the cell array Density on rank 0, but the point array Density on "
                   "rank 1; it must be the same array on all",
    "type": "The density array 'Density' has not the same type and number of components on all "
            "ranks; it must have",
    "not a number": "has 1 value that is NaN or infinite, the first at index 128",
    "negative": "for a density must not be negative (the first at index 128)",
    "no mass": "has a total mass of zero",
    "gap": "The images of the ranks do not fill their common extent: none has the points "
           "[0, 6] x [0, 5] x [5, 7]",
}
OTHERS = {
    "wrong property": "NumberOfParticles is -1",
    "wrong on one": "Rank 1: NumberOfParticles is -1",
    "missing": "Rank 1 has not run this filter within 3 seconds of this one",
}
# Of Morph Densities and Density Barycenter.
BLENDS = {
    **{"morph " + name: text for name, text in MESSAGES.items()},
    "morph direction": "Target: The images of the ranks are not parts of one: the direction "
                       "matrix is 1 0 0 0 1 0 0 0 1 on rank 0, but 0 -1 0 1 0 0 0 0 1 on rank 1",
    "morph wrong on one": "Rank 1: Parameter is 2",
    "barycenter number": "The number of inputs is 2 on rank 0, but 1 on rank 1",
    "barycenter kind": "Input 2 is no data set of the same kind on rank 0 and on rank 1",
    "blocks in pieces": "The data on input port 0 are not the same on rank 0 and on rank 1",
}
RIGHT_BLENDS = ("barycenter right", "blocks right", "morph put right", "morph without maps on one",
                "morph after an abort")
# Points of a map on each rank, and of 60 particles where they lie on one.
RIGHT = {
    "right": None,
    "mass on one": [0, 60, 0],
    "one has none": None,
    "first has none": None,
    "one has all": [0, 60, 0],
    "all have all": None,
    "overlap": None,
}


class RanksErrors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "given")
            done = subprocess.run(
                [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(RANKS), PVBATCH,
                 "--sym", SCRIPT, path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                timeout=120, env=dict(os.environ, RECTIFIEDTRANSPORT_RANK_TIMEOUT="3"))
            if done.stdout.count("WROTE") != RANKS:
                raise AssertionError(done.stdout[-2000:] + done.stderr[-4000:])
            cls.given = []
            for rank in range(RANKS):
                with open("%s.%d" % (path, rank), encoding="utf-8") as file:
                    cls.given.append(json.load(file))

    def points(self, name):
        return [rank[name][0] for rank in self.given]

    def errors(self, name):
        return [rank[name][1] for rank in self.given]

    def test_one_message_ends_all(self):
        for name, text in [*((kind + name, text) for name, text in MESSAGES.items()
                             for kind in ("sample ", "map ")), *OTHERS.items()]:
            with self.subTest(name):
                self.assertEqual(self.points(name), [0] * RANKS)
                first, *others = self.errors(name)
                self.assertEqual(others, [[]] * (RANKS - 1))
                self.assertEqual(len(first), 1)
                self.assertIn(text, first[0])

    def test_array_that_one_has_not(self):
        for kind in ("sample ", "map "):
            self.assertEqual(self.points(kind + "array"), [0] * RANKS)
            self.assertIn("but the cell array Other on rank 1", self.errors(kind + "array")[0][0])

    def test_right_results(self):
        for name, particles in RIGHT.items():
            with self.subTest(name):
                for kind in ("sample ", "map "):
                    self.assertEqual(self.errors(kind + name), [[]] * RANKS)
                self.assertEqual(sum(self.points("sample " + name)), 60)
                if particles:
                    self.assertEqual(self.points("sample " + name), particles)
                self.assertEqual(self.points("map " + name), [7 * 6 * 5] * RANKS)

    def test_blends(self):
        for name, text in BLENDS.items():
            with self.subTest(name):
                self.assertEqual([rank[name][::2] for rank in self.given], [[0, 0]] * RANKS)
                first, *others = self.errors(name)
                self.assertEqual(others, [[]] * (RANKS - 1))
                self.assertEqual(len(first), 1)
                self.assertIn(text, first[0])
                if name[6:] in MESSAGES:
                    self.assertIn("Target: ", first[0])
        for name in (*("morph " + name for name in RIGHT), *RIGHT_BLENDS):
            with self.subTest(name):
                self.assertEqual(self.errors(name), [[]] * RANKS)
                self.assertEqual(sum(self.points(name)), 6 * 5 * 12)
                self.assertEqual(sum(rank[name][2] for rank in self.given), 6 * 5 * 12)
        for name in ("morph none has any", "morph abort"):
            self.assertEqual([rank[name] for rank in self.given], [[0, [], 0]] * RANKS)

    def test_no_data_anywhere(self):
        for kind in ("sample ", "map "):
            self.assertEqual(self.points(kind + "none has any"), [0] * RANKS)
            self.assertEqual(self.errors(kind + "none has any"), [[]] * RANKS)

    def test_abort_on_one(self):
        self.assertEqual(self.points("abort"), [0] * RANKS)
        self.assertEqual(self.errors("abort"), [[]] * RANKS)

    def test_after_a_failure(self):
        self.assertEqual(self.errors("afterwards"), [[]] * RANKS)
        self.assertEqual(sum(self.points("afterwards")), 60)


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

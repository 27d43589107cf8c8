# SPDX-License-Identifier: BSD-3-Clause
"""Three ranks with a fault on one of them: all end, with one message, or the result is right."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from rt_testing import SKIPPED, main

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_errors_script.py")
LIMIT = os.path.join(os.path.dirname(__file__), "ranks_limit_script.py")
RANKS = 3

# What the one message, on the first rank, has.
MESSAGES = {
    "spacing": "The images of the ranks are not parts of one: the spacing is 1 1 1 on rank 0, but "
               "1 1 2 on rank 1",
    "nameless": "The density array has no name; on several ranks it must have one",
    "association": "The density is the cell array Density on rank 0, but the point array Density on "
                   "rank 1; it must be the same array on all",
    "type": "The density array 'Density' has not the same type and number of components on all "
            "ranks; it must have",
    "not a number": "cells (the first at index 128)",
    "negative": "ValidRange as missing (the first at index 128)",
    "no mass": "has a total mass of zero",
    "gap": "The images of the ranks do not fill their common extent: none has the points "
           "[0, 6] x [0, 5] x [5, 7]",
}
OTHERS = {
    "wrong property": "NumberOfParticles is -1",
    "wrong on one": "The property NumberOfParticles is 60 on rank 0, but -1 on rank 1",
    "different seeds": "The property RandomSeed is 0 on rank 0, but 1 on rank 1; it must be the same",
    "missing": "Rank 1 has not run this filter within 3 seconds of this one",
}
POINT_MESSAGES = {
    "splat not finite": "Rank 1: The input point set has 1 point that is NaN or infinite",
    "reference not finite": "Rank 1: The input point set has 1 point that is NaN or infinite",
    "quality not finite": "Rank 1: The input point set has 1 point that is NaN or infinite",
    "splat not a number": "Rank 1: The mass array 'Mass' has 1 value that is NaN",
    "quality not a number": "Rank 1: The array 'Mass' of the particles has the value nan",
    "splat array": "Rank 1: The input has no mass array 'Mass'",
    "quality array": "The array 'Mass' of the particles is on some ranks only",
    "splat too much": "masses of inf in all make densities past the largest double",
    "quality too much": "sums to inf; the sum must be positive and a double",
    "reference spacing": "The images of the ranks are not parts of one: the spacing is 1 1 1 on "
                         "rank 0, but 1 1 2 on rank 1",
    "reference gap": "The images of the ranks do not fill their common extent",
    "splat wrong property": "Dimensions is 5 5 -1; it must be at least 1 along every axis",
    "splat wrong on one": "The property Dimensions is 5 5 5 on rank 0, but 5 5 -1 on rank 1",
    "splat missing": "Rank 1 has not run this filter within 3 seconds of this one",
}
# Of densities that are no images, and of filters that gather.
GATHERED = {
    "sample mesh not a number": "has 1 value that is NaN or infinite",
    "map mesh not a number": "has 1 value that is NaN or infinite",
    "sample mesh nameless": "The density array has no name; on several ranks it must have one",
    "sample mesh type": "The density is no image on rank 0, but an image on rank 1",
    "cells not finite": "has 1 point that is NaN or infinite",
    "relaxation not a number": "has 1 value that is NaN or infinite",
    "solid open": "The input surface is not closed: it has ",
    "disk apart": "The input surface has 2 components",
    "disk short": "The cell array 'Short' of the input surface has 0 tuples; it must have one for",
    "cells short": "The point array 'Short' of the input point set has 0 tuples; it must have one for",
}
# The points of each rank's output.
GIVEN = {
    "cells right": None,
    "cells on one": None,
    "cells mass": None,
    "cells none has any": [0, 0, 0],
    "relaxation right": [12, 0, 0],
    "relaxation mesh": [12, 0, 0],
    "solid on one": None,
    "solid whole": None,
    "solid none has any": [0, 0, 0],
    "solid short": None,
    "relaxation short": [12, 0, 0],
    "disk right": [65, 0, 0],
}
# Of Morph Densities and Density Barycenter.
BLENDS = {
    **{"morph " + name: text for name, text in MESSAGES.items()},
    "morph direction": "Target: The images of the ranks are not parts of one: the direction "
                       "matrix is 1 0 0 0 1 0 0 0 1 on rank 0, but 0 -1 0 1 0 0 0 0 1 on rank 1",
    "morph wrong on one": "The property Parameter is 0.5 on rank 0, but 2 on rank 1",
    "barycenter number": "The number of inputs is 2 on rank 0, but 1 on rank 1",
    "barycenter kind": "Input 2 of 2: The density is an image on rank 0, but no image on rank 1; it must be "
                       "of one type on all",
}
RIGHT_BLENDS = ("barycenter right", "barycenter nothing on one", "blocks right", "blocks in pieces", "morph put right",
                "morph without maps on one", "morph after an abort")
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
                             for kind in ("sample ", "map ")), *OTHERS.items(),
                           *GATHERED.items()]:
            with self.subTest(name):
                self.assertEqual(self.points(name), [0] * RANKS)
                first, *others = self.errors(name)
                self.assertEqual(others, [[]] * (RANKS - 1))
                self.assertEqual(len(first), 1)
                self.assertIn(text, first[0])

    def test_a_mesh_without_the_array_on_one_has_no_mass_there(self):
        self.assertEqual(self.errors("sample mesh array"), [[]] * RANKS)
        points = self.points("sample mesh array")
        self.assertEqual((sum(points), points[1]), (60, 0))

    def test_no_memory_on_one(self):
        """The others would wait for its messages."""
        done = subprocess.run(
            [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", "2", PVBATCH, "--sym", LIMIT],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
        given = sorted(json.loads(line) for line in re.findall("GIVEN (.*)", done.stdout))
        self.assertEqual([cells for _, cells, _ in given], [0, 0], done.stderr[-2000:])
        self.assertEqual([len(errors) for *_, errors in given], [1, 0])
        self.assertIn("Rank 1: Not enough memory for what other ranks send", given[0][2][0])

    def test_array_that_one_has_not(self):
        for kind in ("sample ", "map "):
            self.assertEqual(self.points(kind + "array"), [0] * RANKS)
            self.assertIn("but the cell array Other on rank 1", self.errors(kind + "array")[0][0])

    def test_right_results(self):
        for name, particles in [*RIGHT.items(), ("kept by others", None)]:
            with self.subTest(name):
                for kind in ("sample ", "map "):
                    self.assertEqual(self.errors(kind + name), [[]] * RANKS)
                self.assertEqual(sum(self.points("sample " + name)), 60)
                if particles:
                    self.assertEqual(self.points("sample " + name), particles)
                self.assertEqual(self.points("map " + name), [7 * 6 * 5] * RANKS)

    def test_images_above_zero(self):
        """Ranks without a part, whatever the type of nothing there."""
        names = [name for name in self.given[0] if " above " in name]
        self.assertEqual(len(names), 54)
        masses = {"cells": sum(1 + i % 7 for i in range(360)),
                  "points": sum(1 + i % 7 for i in range(546))}
        for name in names:
            with self.subTest(name):
                self.assertEqual(self.errors(name), [[]] * RANKS)
                kind, _, owner, *_ = name.split()
                if kind == "vtkTransportSampler":
                    self.assertEqual(sum(self.points(name)), 60)
                    for rank in self.given:
                        if rank[name][0]:
                            self.assertAlmostEqual(rank[name][2], masses[owner], 9)
                elif kind == "vtkTransportMap":
                    self.assertTrue(all(self.points(name)))
                else:
                    self.assertGreater(sum(self.points(name)), 0)

    def test_points(self):
        whole = 6 * 5 * 12
        for name, mass in (("right", 120), ("weighed", 120), ("one has none", 80),
                           ("first has none", 80), ("one has all", 40), ("outside", 120)):
            for kind in ("splat ", "reference ", "quality "):
                with self.subTest(kind + name):
                    self.assertEqual(self.errors(kind + name), [[]] * RANKS)
                    counts = self.points(kind + name)
                    if kind == "quality ":
                        self.assertEqual(counts, [1, 0, 0])
                        continue
                    self.assertEqual(sum(counts), whole)
                    self.assertEqual([rank[kind + name][3] for rank in self.given], [mass] * RANKS)
        for kind, count in (("splat ", 0), ("reference ", whole), ("quality ", 0)):
            self.assertEqual(sum(self.points(kind + "none has any")), count)
            self.assertEqual(self.errors(kind + "none has any"), [[]] * RANKS)

    def test_one_warning_counts_the_points_of_all(self):
        first, *others = [rank["reference outside"][2] for rank in self.given]
        self.assertEqual(others, [[]] * (RANKS - 1))
        self.assertEqual(len(first), 1)
        self.assertIn("3 of 120 points are outside the domain", first[0])
        self.assertEqual(self.given[0]["splat outside"][2], [])
        for name, warnings in (("reference one of 1000", [1, 0, 0]),
                               ("reference one of 1001", [0, 0, 0])):
            with self.subTest(name):
                self.assertEqual([len(rank[name][2]) for rank in self.given], warnings)
                self.assertEqual([rank[name][4] for rank in self.given], [1] * RANKS)

    def test_one_message_of_points(self):
        for name, text in POINT_MESSAGES.items():
            with self.subTest(name):
                self.assertEqual(self.points(name), [0] * RANKS)
                first, *others = self.errors(name)
                self.assertEqual(others, [[]] * (RANKS - 1))
                self.assertEqual(len(first), 1, first)
                self.assertIn(text, first[0])

    def test_points_after_an_abort(self):
        for name in ("splat abort", "quality abort"):
            self.assertEqual(self.points(name), [0] * RANKS)
            self.assertEqual(self.errors(name), [[]] * RANKS)
        self.assertEqual(sum(self.points("splat afterwards")), 6 * 5 * 12)
        self.assertEqual(self.given[0]["splat alone"][0], 6 * 5 * 12)

    def test_densities_that_are_no_images(self):
        """In pieces, whole on each rank, or on one alone: all of it, counted once."""
        expected = sum(1 + i % 120 % 7 for i in range(360))
        for name in ("right", "whole", "on first", "on one"):
            for kind in ("sample ", "map "):
                with self.subTest(kind + name):
                    self.assertEqual(self.errors(kind + "mesh " + name), [[]] * RANKS)
                    for rank in self.given:
                        if rank[kind + "mesh " + name][0]:
                            self.assertAlmostEqual(rank[kind + "mesh " + name][2], expected, 9)
            self.assertEqual(sum(self.points("sample mesh " + name)), 60)
            self.assertEqual(self.points("map mesh " + name), [7 * 6 * 5] * RANKS)

    def test_short_arrays_that_nothing_reads(self):
        for name in ("map short", "map mesh short"):
            self.assertEqual(self.errors(name), [[]] * RANKS)
            self.assertTrue(all(self.points(name)))

    def test_filters_that_gather(self):
        for name, points in GIVEN.items():
            with self.subTest(name):
                self.assertEqual(self.errors(name), [[]] * RANKS)
                if points:
                    self.assertEqual(self.points(name), points)
                else:
                    self.assertTrue(all(self.points(name)), self.points(name))

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
                self.assertEqual(sum(self.points(name)), 4 * 6 * 5 * 12)
                self.assertEqual(sum(rank[name][2] for rank in self.given), 6 * 5 * 12)
        for name in ("morph none has any", "morph abort"):
            self.assertEqual([rank[name] for rank in self.given], [[0, [], 0]] * RANKS)

    def test_no_data_anywhere(self):
        for kind in ("sample ", "map ", "sample mesh ", "map mesh "):
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

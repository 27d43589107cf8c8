# SPDX-License-Identifier: BSD-3-Clause
"""Filters on images that several ranks share give, together, the bits of one rank: a table of
filter x ranks. Each point and cell is compared, with all of its arrays."""
import functools
import os
import pickle
import shutil
import subprocess
import sys
import tempfile
import unittest

from rt_testing import SKIPPED, main

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_table_script.py")
RANKS = [int(count) for count in os.environ.get("RT_RANKS", "3").split()]  # the long tests have more
# Of other filters behind ours the cells may begin elsewhere.
BEHIND = ("contour", "slice", "threshold")
# A slice rounds as its piece does; seeds that are divided otherwise have other numbers.
PLACES_ALONE = ("seeds apart", "seeds of a mesh")
# Of surfaces that are joined of pieces the points have other numbers, on which results depend.
NUMBERS_ALONE = ("surface apart", "parameterization apart", "sites of a mesh")


@functools.lru_cache(maxsize=None)
def run(ranks, script=SCRIPT, *arguments):
    """What a script writes on each of some ranks to the path that is its first argument."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "given")
        done = subprocess.run(
            [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(ranks), PVBATCH, "--sym",
             script, path, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            timeout=400)
        if done.returncode != 0 or done.stdout.count("WROTE") != ranks:
            raise AssertionError(done.stdout[-2000:] + done.stderr[-4000:])
        given = []
        for rank in range(ranks):
            with open("%s.%d" % (path, rank), "rb") as file:
                given.append(pickle.load(file))
        return given


def together(given, name, owner):
    """The digests of all ranks, by place: that of a point on a common face is on two ranks."""
    joined = {}
    for rank in given:
        for place, digest in rank[name][owner][0]:
            joined.setdefault(place, set()).add(digest)
    return joined


class RanksTable(unittest.TestCase):
    def test_table(self):
        alone = run(1)
        print("%-16s" % "points, checksum" + "".join("%26d" % n for n in [1, *RANKS]))
        given = {ranks: run(ranks) for ranks in RANKS}
        for name in alone[0]:
            rows = []
            for those in [alone, *given.values()]:
                points = together(those, name, "points")
                checksum = sum(sum(digests) for digests in points.values()) % (1 << 32)
                rows.append("%14d %08x" % (sum(map(len, points.values())), checksum))
            print("%-16s" % name + "".join("%26s" % row for row in rows))
        for ranks, those in given.items():
            for name, expected in alone[0].items():
                with self.subTest(name, ranks=ranks):
                    self.compare(name, expected, alone, those)

    def compare(self, name, expected, alone, those):
        for rank in those:
            for field, value in expected["fields"].items():
                if rank[name]["points"][0] and name not in NUMBERS_ALONE:
                    # As text: NaN is not NaN.
                    self.assertEqual(repr(rank[name]["fields"].get(field)), repr(value), field)
        for owner in ("points", "cells"):
            if name in NUMBERS_ALONE:
                self.assertEqual(sum(len(rank[name][owner][0]) for rank in those),
                                 len(expected[owner][0]))
                continue
            arrays = [rank[name][owner][1] for rank in those if rank[name][owner][0]]
            self.assertTrue(all(there == expected[owner][1] for there in arrays), arrays)
            if owner == "points" and (name in PLACES_ALONE or name.endswith("slice")):
                self.assertEqual(together(those, name, owner).keys(),
                                 together(alone, name, owner).keys())
            elif owner == "points" or not name.endswith(BEHIND):
                self.assertEqual(together(those, name, owner), together(alone, name, owner))
            else:
                self.assertEqual(sum(len(rank[name][owner][0]) for rank in those),
                                 len(expected[owner][0]))
        self.assertGreater(len(expected["points"][0]), 0)

    def test_rows_are_on_the_first_rank(self):
        first, *others = run(3)
        names = [name for name in first if name.startswith(("quality", "distances"))]
        self.assertGreater(len(names), 15)
        for name in names:
            self.assertEqual(len(first[name]["points"][0]), 1 if name.startswith("quality") else 3)
            self.assertTrue(all(not rank[name]["points"][0] for rank in others))

    def test_folds_and_blocks(self):
        """Rows have some of them, in both directions, of whole tables and of tiles."""
        fields = {name: given["fields"] for name, given in run(1)[0].items()}
        for name in ("map folds back", "map folds tiled", "warp of volumes"):
            with self.subTest(name):
                self.assertGreater(fields[name]["FoldedCells"][0], 0)
        for name in ("map points", "map back", "map tiled", "map folds"):
            with self.subTest(name):
                quantile, largest = fields[name]["LargestBlockError"]
                self.assertTrue(0 < quantile <= largest, fields[name])

    def test_particles_are_where_they_lie(self):
        """More than one rank has some of them, and those of paths as of points."""
        given = run(3)
        for name in ("sample points", "sample cells", "paths", "tiled", "threshold"):
            with self.subTest(name):
                self.assertGreater(sum(bool(rank[name]["points"][0]) for rank in given), 1)


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

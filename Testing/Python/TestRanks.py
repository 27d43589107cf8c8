# SPDX-License-Identifier: BSD-3-Clause
"""Two ranks: data that are whole on each, or on the first alone, or lie on both. What lies on both
gives a result, too, where filters share or gather it, else an error. Nothing may hang."""
import os
import re
import shutil
import subprocess
import sys
import unittest

from rt_testing import SKIPPED, main

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_script.py")

# What takes points of several ranks.


class Ranks(unittest.TestCase):
    def check(self, *options):
        run = subprocess.run(
            [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", "2", PVBATCH, *options,
             SCRIPT], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=140)
        gave = dict(re.findall(r"GAVE (\w+(?: \w+)?) ((?:some|none)(?: error)?)$", run.stdout, re.M))
        expected = {}
        for filter_ in ("splat", "cells", "seeds", "quality", "relaxation", "reference", "domain",
                        "block"):
            for kind in ("whole", "gathered"):
                expected["%s %s" % (filter_, kind)] = "some"
            # Points in blocks are executed block by block.
            expected["%s shared" % filter_] = "none error" if filter_ == "block" else "some"
        expected.update({name: "some" for name in ("morph", "barycenter", "map", "warp", "solid",
                                                   "parameterization", "surface",
                                                   "parameterization shared", "surface shared",
                                                   "solid shared")})
        self.assertEqual(gave, expected, run.stdout + run.stderr[-3000:])
        self.assertNotIn("within ten seconds", run.stdout + run.stderr)
        self.assertEqual(run.returncode, 0)

    def test_together(self):
        self.check()

    def test_symmetric(self):
        self.check("--sym")


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

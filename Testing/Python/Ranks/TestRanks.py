# SPDX-License-Identifier: BSD-3-Clause
"""Two ranks: data that are whole on each, or on the first alone, or lie on both. What lies on both
gives a result, too, where filters share or gather it, else an error. Nothing may hang."""
import os
import re
import shutil
import subprocess
import sys
import unittest

from rt_filters import FILTERS, by_label
from rt_testing import SKIPPED, main

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_script.py")

# Where inputs lie, by their kinds.
PLACES = {"points": ("whole", "shared", "gathered"), "mesh": ("whole", "shared", "gathered"),
          "disk": ("whole", "shared"), "solid": ("whole", "shared"),
          "map": ("whole", "shared")}


def cases():
    """Filters with the name of the case, where their points or surfaces lie, and whether they have all of
    their inputs."""
    for filter_ in FILTERS:
        for optional in (False, True) if filter_.optional else (False,):
            kinds = (filter_.ports if optional else filter_.inputs).values()
            kind = next((kind for kind in kinds if kind in PLACES), None)
            for place in PLACES.get(kind, ("whole",)):
                yield filter_, case_of(filter_, place, optional), place, optional
    splat = by_label("Splat Mass")
    for place in ("block of whole", "block of shared", "block of gathered"):
        yield splat, case_of(splat, place, False), place, False


def case_of(filter_, place, optional):
    return "%s %s%s" % (filter_.name, place, " all" if optional else "")


class Ranks(unittest.TestCase):
    def check(self, *options):
        run = subprocess.run(
            [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", "2", PVBATCH, *options,
             SCRIPT], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=140)
        gave = dict(re.findall(r"GAVE (.*) ((?:some|none)(?: error)?)$", run.stdout, re.M))
        # Points in blocks are executed block by block.
        expected = {case: "none error" if place == "block of shared" else "some"
                    for _, case, place, _ in cases()}
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

# SPDX-License-Identifier: BSD-3-Clause
"""Device OpenCL on three ranks: the bits of the processor, and one warning for all ranks if one of
them has no device."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from rt_filters import with_property
from rt_testing import SKIPPED, main

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_device_script.py")
RANKS = 3
FILTERS = [filter_.name for filter_ in with_property("Device")]
INSTEAD = "; the processor did the work, with the same result"


def run(kind):
    """What each rank wrote."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "given")
        done = subprocess.run(
            [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(RANKS), PVBATCH, "--sym",
             SCRIPT, path, kind], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            timeout=300)
        if done.stdout.count("WROTE") != RANKS:
            raise AssertionError(done.stdout[-2000:] + done.stderr[-4000:])
        given = []
        for rank in range(RANKS):
            with open("%s.%d" % (path, rank), encoding="utf-8") as file:
                given.append(json.load(file))
        return given


class RanksDevice(unittest.TestCase):
    def check(self, kind, expected):
        """What the warning has where a rank has no device."""
        given = run(kind)
        if os.environ.get("RT_OPENCL") and kind == "usual":
            self.assertTrue(all(found["devices"] for found in given))
        warns = not all(found["devices"] for found in given)
        for name in FILTERS:
            for rank, found in enumerate(given):
                with self.subTest(kind, filter=name, rank=rank):
                    cpu, device = found[name]["CPU"], found[name]["OpenCL"]
                    self.assertEqual(device["digests"], cpu["digests"])
                    self.assertEqual(cpu["errors"] + device["errors"], [])
                    # Others, as of folds, are the same.
                    added = [text for text in device["warnings"] if INSTEAD in text]
                    self.assertEqual(len(device["warnings"]), len(cpu["warnings"]) + len(added))
                    self.assertEqual(len(added), 1 if rank == 0 and warns else 0)
                    for text in added:
                        self.assertRegex(text, expected)

    def test_devices(self):
        self.check("usual", "OpenCL")

    def test_none(self):
        self.check("none", r"(?<!Rank \d: )(OpenCL has no device|There is no OpenCL|This library)")

    def test_last_has_none(self):
        self.check("last has none",
                   "Rank 2: OpenCL has no device" if os.environ.get("RT_OPENCL") else "OpenCL")


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

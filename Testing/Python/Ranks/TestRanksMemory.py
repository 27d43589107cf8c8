# SPDX-License-Identifier: BSD-3-Clause
"""What a rank takes of memory on 1, 2 and 4 ranks under Tables Tiled, beyond what an idle rank has:
with P ranks a P-th of what one takes, and a part that does not fall. Prints the table."""
import os
import re
import shutil
import subprocess
import sys
import unittest

from rt_testing import SKIPPED, SOURCE, main

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(SOURCE, "Testing", "Benchmarks", "ranks.py")
RANKS = (1, 2, 4)
SIDE = 256  # points along an axis, of float
# Of what one rank takes, what each of several may take besides its P-th: graded tables, the
# bits of the cells with mass, lattices and the tables of a tile are on every rank. With a particle for
# eight cells they are more than a quarter.
RUNS = {"Transport Map, a sample a cell": ("map", 0.25),
        "Sample Density, 8 million particles": ("8000000", 0.25),
        "Sample Density, 2 million particles": ("2000000", 0.4),
        "Transport Quality, 4 million points": ("quality", 0.25)}
LIMIT = 300  # seconds for a run; it takes ten on an idle machine
NEEDED = 6 << 30  # bytes of memory for four ranks


def available():
    with open("/proc/meminfo", encoding="ascii") as file:
        return 1024 * next(int(line.split()[1]) for line in file if line.startswith("MemAvailable"))


def peak(what, ranks):
    """The most megabytes of any rank, less those of an idle one."""
    done = subprocess.run(
        [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(ranks), PVBATCH, "--sym",
         SCRIPT, os.environ["RT_PLUGIN"], what, str(SIDE)], stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True, timeout=LIMIT)
    found = re.findall(r"rank \d+ of %d: (\d+) MB" % ranks, done.stdout)
    if done.returncode != 0 or len(found) != ranks:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-4000:])
    return max(map(int, found))


class RanksMemory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.taken = {name: [peak(what, ranks) for ranks in RANKS] for name, (what, _) in RUNS.items()}
        print("\n%-36s" % "MB of the largest rank" + "".join("%12d ranks" % n for n in RANKS))
        for name, taken in cls.taken.items():
            print("%-36s" % name + "".join("%8d, %3.0f %%   " % (
                mb, 100 * mb / taken[0]) for mb in taken))

    def test_each_takes_its_part(self):
        for name, (alone, *several) in self.taken.items():
            for ranks, taken in zip(RANKS[1:], several):
                with self.subTest(name, ranks=ranks):
                    self.assertLessEqual(taken, (1 / ranks + RUNS[name][1]) * alone)

    def test_measured(self):
        """The density alone is 64 MB."""
        for name, (alone, *_) in self.taken.items():
            self.assertGreater(alone, 64, name)


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    if available() < NEEDED:
        print("Needs %d GB of memory" % (NEEDED >> 30))
        sys.exit(SKIPPED)
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""The model of what several ranks take says the bytes that two ranks send each other, as Open MPI
counts them, and what must hold for any number of ranks."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from rt_testing import SKIPPED, SOURCE, main

sys.path.insert(0, os.path.join(SOURCE, "Testing", "Benchmarks"))
import rank_model as model  # noqa: E402

PROGRAM = os.environ.get("RT_RANK_PLAN")
MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "rank_bytes_script.py")
SIDE, STEPS = 128, 32
IDLE = model.Machine(*[0] * 7)
MACHINE = model.Machine(alpha=2e-6, beta=1e-10, graded_cell=1e-8, graded_node=1e-8,
                        evaluation=8e-8, tile_cell=7e-9, velocity=1e-7)


def sent(maps):
    """The bytes that a rank of two sends on average, or None where Open MPI does not count."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", "2", "--mca",
             "pml_monitoring_enable", "2", "--mca", "pml_monitoring_enable_output", "3", "--mca",
             "pml_monitoring_filename", os.path.join(folder, "sent"), PVBATCH, "--sym", SCRIPT,
             str(SIDE), maps],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
        if "mca_pml_monitoring_add_procs" in done.stdout:
            return None  # Open MPI 5 ends where it shall count
        if done.returncode != 0:
            raise AssertionError(done.stdout[-3000:])
        files = glob.glob(os.path.join(folder, "sent*.prof"))
        if len(files) != 2:
            return None
        counted = 0
        for path in files:
            with open(path, encoding="ascii") as file:  # E: by the program, I: within collectives
                counted += sum(map(int, re.findall(r"^[EI]\s+\d+\s+\d+\s+(\d+) bytes",
                                                   file.read(), re.MULTILINE)))
        return counted / 2


class RankModel(unittest.TestCase):
    def setUp(self):
        self.plan = model.ask(PROGRAM, SIDE, STEPS, 0)

    def said(self, plan, ranks=2):
        return {phase.name: phase.bytes
                for phase in model.phases(plan, model.Job(100, False), ranks, IDLE)}

    def test_bytes_of_a_real_run(self):
        """Pieces may be layers already. The flow map is sent or made on each."""
        without = sent("Off")
        if without is None:
            self.skipTest("this MPI does not count what is sent")
        self.assertLess(sent("none"), 1e4)
        said = self.said(dict(self.plan, levels=0, map_bytes=0))
        self.assertGreater(without, 0.98 * said["graded tables to all"])
        self.assertLess(without, 1.02 * sum(said.values()))
        self.assertLess(sent("On"), 1.02 * sum(self.said(self.plan).values()))

    def test_one_rank_sends_nothing(self):
        for is_map in (True, False):
            for phase in model.phases(self.plan, model.Job(1e6, is_map), 1, MACHINE):
                self.assertEqual(phase.bytes, 0, phase.name)
            self.assertEqual(model.efficiency(self.plan, model.Job(1e6, is_map), 1, MACHINE), 1)

    def test_work_is_divided(self):
        """Of as many tiles as ranks or more each phase is at least a P-th of one rank's."""
        plan = model.ask(PROGRAM, 1024, 64, 0)
        self.assertGreaterEqual(plan["tiles"], 8)
        job = model.Job(1e8, False)
        for ranks in (2, 4, 8):
            for one, part in zip(model.phases(plan, job, 1, MACHINE),
                                 model.phases(plan, job, ranks, MACHINE)):
                self.assertGreaterEqual(part.work * 1.001, one.work / ranks, one.name)
            self.assertLess(model.efficiency(plan, job, ranks, MACHINE), 1)
            self.assertLess(sum(model.memory(plan, job, ranks).values()),
                            sum(model.memory(plan, job, 1).values()))

    def test_too_few_graded_nodes(self):
        self.assertFalse(model.ask(PROGRAM, 8192, 64, 0)["possible"])
        self.assertTrue(model.ask(PROGRAM, 8192, 64, 1 << 28)["possible"])


if __name__ == "__main__":
    if not PROGRAM or not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs the benchmarks, mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""A client on a pvserver of several processes is told, shown and given what it is by a server of
one process, and goes on after errors, each of which is one message. Nothing may hang."""
import json
import os
import sys
import tempfile
import unittest

import numpy as np
from rt_server import MPIRUN, PVSERVER, run_client
from rt_testing import SKIPPED, main, need_display, reads_appended_data
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, makes the window

CLIENT = os.path.join(os.path.dirname(__file__), "ranks_server_client.py")
SEVERAL = (2, 3) if "RT_RANKS" in os.environ else (3,)  # the long tests have more
LIMIT = 400  # seconds for a client; it takes six on an idle machine
WRONG_STEPS = ("-1", "-5", "99999")
FILTERS = ("particles", "map", "warp")


def picture(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(float)


class RanksServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # A display without windows may start anew, and refuse the next one meanwhile.
        cls.window = vtkRenderWindow()
        cls.window.SetSize(8, 8)
        cls.window.Render()
        cls.facts, cls.pictures, cls.printed = {}, {}, {}
        for processes in (1, *SEVERAL):
            with tempfile.TemporaryDirectory() as folder:
                cls.printed[processes] = run_client(CLIENT, folder, processes=processes,
                                                    limit=LIMIT)
                with open(os.path.join(folder, "facts.json"), encoding="utf-8") as file:
                    cls.facts[processes] = json.load(file)
                cls.pictures[processes] = picture(os.path.join(folder, "picture.png"))

    def test_told(self):
        self.assertEqual(self.facts[1]["particles"]["points"], 3000)
        self.assertEqual(self.facts[1]["map"]["extent"], [-10, 10] * 3)
        self.assertGreater(self.facts[1]["warp"]["cells"], 1000)
        for processes in SEVERAL:
            for name, expected in self.facts[1].items():
                with self.subTest(name, processes=processes):
                    if name.startswith("failing"):
                        continue
                    self.assertEqual(self.facts[processes][name], expected)

    def test_files(self):
        for processes in (1, *SEVERAL):
            for name in ("particles", "map"):
                with self.subTest(name, processes=processes):
                    kept, made = (self.facts[processes][key] for key in ("saved " + name, name))
                    self.assertEqual(kept, made)

    @unittest.skipUnless(reads_appended_data(), "ParaView's servers lose data that they render here")
    def test_pictures(self):
        self.assertGreater((self.pictures[1] < 250).any(axis=1).mean(), 0.2)
        for processes in SEVERAL:
            difference = np.abs(self.pictures[processes] - self.pictures[1])
            self.assertLess(difference.mean(), 1, processes)
            self.assertLess((difference > 40).mean(), 0.01, processes)

    def test_errors(self):
        for processes in (1, *SEVERAL):
            client, server = self.printed[processes]
            for name in FILTERS:
                with self.subTest(name, processes=processes):
                    counts = self.facts[processes]["failing " + name]
                    self.assertEqual(counts[::2], [0] * len(WRONG_STEPS))
                    self.assertGreater(counts[1], 0)
                    self.assertEqual(counts[1::2], counts[1:2] * len(WRONG_STEPS))
            # The server prints its messages and sends them to the client.
            for printed in (client, server):
                for steps in WRONG_STEPS:
                    with self.subTest(steps, processes=processes):
                        text = "NumberOfSteps is %s;" % steps
                        self.assertEqual(printed.count(text), len(FILTERS), printed[-3000:])


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVSERVER):
        print("Needs mpirun and pvserver")
        sys.exit(SKIPPED)
    need_display()
    main()

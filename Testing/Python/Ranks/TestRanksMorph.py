# SPDX-License-Identifier: BSD-3-Clause
"""Behind both ports of Morph Densities several ranks give what one gives, in files and in pictures,
and the filter runs no more often: with maps that are kept."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from rt_testing import SKIPPED, main, need_display
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import (vtkXMLPImageDataReader, vtkXMLPPolyDataReader,
                                 vtkXMLPUnstructuredGridReader)

MPIRUN = shutil.which("mpirun")
PVBATCH = os.path.join(os.path.dirname(os.environ["RT_PVPYTHON"]), "pvbatch")
SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_morph_script.py")
LONG = "RT_RANKS" in os.environ  # the long tests have more ranks
READERS = {"pvti": vtkXMLPImageDataReader, "pvtp": vtkXMLPPolyDataReader,
           "pvtu": vtkXMLPUnstructuredGridReader, "png": vtkPNGReader}
# How often the filter runs, and whether it makes tables.
RUNS = {"particles first": [1, True], "density then": [0, False], "density first": [1, True],
        "particles then": [0, False], "parameter": [1, False], "mass": [1, False],
        "steps": [1, True], "time 0.0": [1, True], "time 0.5": [1, False], "time 1.0": [1, False],
        "weights 111": [1, True], "weights 301": [1, False], "weights 002": [1, False]}


def run(folder, ranks, *options):
    """In symmetric mode ParaView's own rendering may wait for ever: there is no picture."""
    done = subprocess.run(
        [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(ranks), PVBATCH, *options,
         SCRIPT, folder, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        timeout=120)
    if done.returncode != 0 or "WROTE" not in done.stdout:
        raise AssertionError(done.stdout[-2000:] + done.stderr[-4000:])
    with open(os.path.join(folder, "numbers.json"), encoding="utf-8") as file:
        return json.load(file)


def read(folder, name):
    reader = READERS[name.split(".")[1]]()
    reader.SetFileName(os.path.join(folder, name))
    reader.Update()
    return reader.GetOutput()


def rows(data):
    """The points with their arrays, sorted."""
    columns = [[data.GetPoint(i) for i in range(data.GetNumberOfPoints())]]
    names = sorted(data.GetPointData().GetArrayName(i)
                   for i in range(data.GetPointData().GetNumberOfArrays()))
    for name in names:
        if name != "vtkGhostType":
            values = vtk_to_numpy(data.GetPointData().GetArray(name))
            columns.append(values.reshape(data.GetNumberOfPoints(), -1))
    return np.unique(np.hstack(columns), axis=0)


class RanksMorph(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.alone = os.path.join(cls.folder.name, "alone")
        os.mkdir(cls.alone)
        run(cls.alone, 1)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def check(self, ranks, *options):
        with tempfile.TemporaryDirectory() as folder:
            numbers = run(folder, ranks, *options)
            pictures = numbers.pop("pictures", 2)
            self.assertEqual(numbers, RUNS)
            for name in ("density.pvti", "again.pvti"):
                one, several = (vtk_to_numpy(read(place, name).GetPointData().GetScalars())
                                for place in (self.alone, folder))
                self.assertTrue(np.array_equal(one, several), name)
            for name in ("particles.pvtp", "contour.pvtp", "threshold.pvtu"):
                one, several = (rows(read(place, name)) for place in (self.alone, folder))
                self.assertGreater(len(one), 100)
                self.assertTrue(np.array_equal(one, several), name)
            # A slice rounds as its piece does.
            one, several = ({tuple(row[:3].round(6)): row[3:] for row in rows(
                read(place, "slice.pvtp"))} for place in (self.alone, folder))
            self.assertEqual(one.keys(), several.keys())
            for place, values in one.items():
                self.assertTrue(np.allclose(values, several[place]))
            if not options:
                self.assertEqual(pictures, 2)
                one, several = (vtk_to_numpy(read(place, "view.png").GetPointData().GetScalars())
                                for place in (self.alone, folder))
                self.assertGreater(one.std(), 5.0)
                self.assertLess(np.abs(one.astype(float) - several).mean(), 0.5)

    def test_together(self):
        for ranks in (2, 3) if LONG else (3,):
            self.check(ranks)

    def test_symmetric(self):
        for ranks in (2, 4) if LONG else (2,):
            self.check(ranks, "--sym")


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    need_display()
    main()

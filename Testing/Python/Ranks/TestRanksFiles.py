# SPDX-License-Identifier: BSD-3-Clause
"""Readers of files as densities on several ranks: an image in pieces that other numbers of ranks
wrote, one file of a whole image, and raw numbers of which each rank reads its part. Filters give
the bits of one rank; what ranks write of the filters' outputs is read back as it was."""
import os
import sys
import tempfile
import unittest

import numpy as np
import TestRanksTable
from rt_testing import SKIPPED, main
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_files_script.py")
EXTENT = (0, 12, 0, 7, 0, 10)


def write_whole(folder):
    """The same image as one file of VTK and as raw numbers."""
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*EXTENT)
    source.Update()
    values = vtk_to_numpy(source.GetOutput().GetPointData().GetScalars())
    values.astype(np.float32).tofile(os.path.join(folder, "whole.raw"))
    writer = vtkXMLImageDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(os.path.join(folder, "whole.vti"))
    writer.SetDataModeToBinary()
    writer.Write()


class RanksFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            write_whole(folder)

            def run(ranks, name, *files):
                return TestRanksTable.run(ranks, SCRIPT, folder, name, *files)

            cls.given = {
                "two": run(2, "two", "whole.vti", "whole.raw"),
                "three": run(3, "three", "two-image.pvti", "two-cells.pvti", "whole.vti",
                             "whole.raw"),
                "two of three": run(2, "none", "three-image.pvti", "three-cells.pvti")}
            cls.alone = run(1, "alone", "two-image.pvti", "three-image.pvti", "two-cells.pvti",
                            "two-sample.pvtp", "three-sample.pvtp", "two-map.pvti",
                            "three-map.pvti")
            cls.drawings = {}
            for name in ("alone", "two", "three"):
                with open(os.path.join(folder, name + "-drawing.svg"), encoding="utf-8") as file:
                    cls.drawings[name] = sorted(file)

    def test_drawings(self):
        """All dots are in one file, in the order of the ranks that have them."""
        alone = self.drawings["alone"]
        self.assertEqual(sum("<circle" in line for line in alone), 400)
        self.assertEqual(self.drawings["two"], alone)
        self.assertEqual(self.drawings["three"], alone)

    def same(self, ranks, name, expected):
        """An output on ranks is that of one rank."""
        alone = self.alone[0][expected]
        self.assertGreater(len(alone["points"][0]), 100)
        for owner in ("points", "cells"):
            self.assertEqual(TestRanksTable.together(ranks, name, owner),
                             TestRanksTable.together(self.alone, expected, owner))
        for rank in ranks:
            if rank[name]["points"][0]:
                self.assertEqual(repr(rank[name]["fields"]), repr(alone["fields"]))  # NaN, too

    def test_readers(self):
        """Of points, each in files of as many pieces as ranks, of more and of fewer."""
        for ranks, those in {**self.given, "one": self.alone}.items():
            for name in those[0]:
                for kind in ("sample", "map"):
                    if name.endswith(" " + kind) and "cells" not in name:
                        with self.subTest(name, ranks=ranks):
                            self.same(those, name, "source " + kind)

    def test_cells(self):
        for kind in ("sample", "map"):
            for ranks, name in (("three", "two"), ("two of three", "three")):
                with self.subTest(kind, ranks=ranks):
                    self.same(self.given[ranks], "%s-cells.pvti %s" % (name, kind),
                              "two-cells.pvti " + kind)

    def test_all_ranks_read(self):
        for ranks in self.given.values():
            for rank in ranks:
                for name in rank:
                    with self.subTest(name):
                        self.assertGreater(len(rank[name]["points"][0]), 0)

    def test_outputs_in_files(self):
        for written in ("two", "three"):
            for kind, ending in (("sample", "pvtp"), ("map", "pvti")):
                name = "%s-%s.%s" % (written, kind, ending)
                with self.subTest(name):
                    self.same(self.alone, name, "source " + kind)


if __name__ == "__main__":
    if not TestRanksTable.MPIRUN or not os.path.exists(TestRanksTable.PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

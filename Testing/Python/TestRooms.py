# SPDX-License-Identifier: BSD-3-Clause
"""Who includes whom, as Documentation/Contributing.md draws it."""
import glob
import os
import re
import unittest

from rt_testing import SOURCE, main

CORE = {
    "Parallel": set(),
    "Geometry": {"Parallel"},
    "Tables": {"Parallel", "Geometry"},
    "Flow": {"Parallel", "Geometry", "Tables"},
    "SiteCells": {"Parallel", "Geometry", "Tables", "Flow"},
    "Quality": {"Parallel", "Geometry", "Tables", "Flow"},
    "Seeds": {"Parallel", "Geometry"},
    "Splat": {"Parallel", "Geometry"},
    "Solid": {"Parallel", "Geometry"},
}
RUN = {"Run"}
WORKERS = RUN | {"Image", "Points", "Settings", "Density"}
BRIDGE = {
    "Run": set(),
    "Image": RUN,
    "Points": RUN,
    "Settings": RUN,
    "Density": RUN | {"Image", "Points"},
    "Blend": WORKERS | {"Splat"},
    **{room: WORKERS for room in ("Flow", "Quality", "Seeds", "SiteCells", "Solid", "Splat")},
}


def rooms_that_are_included(folder):
    """Pairs of a file and the room of the same folder that it includes."""
    for path in glob.glob(os.path.join(SOURCE, "Filters", folder, "*", "**", "*"), recursive=True):
        if path.endswith((".h", ".txx", ".cxx")):
            with open(path, encoding="utf-8") as file:
                for room in re.findall(r'#include "%s/(\w+)/' % folder, file.read()):
                    yield os.path.relpath(path, os.path.join(SOURCE, "Filters", folder)), room


class Rooms(unittest.TestCase):
    def check(self, folder, allowed):
        found = list(rooms_that_are_included(folder))
        self.assertGreater(len(found), 50)
        for path, room in found:
            own = path.split(os.sep)[0]
            with self.subTest(path, includes=room):
                self.assertIn(room, allowed[own] | {own})

    def test_core(self):
        self.check("Core", CORE)

    def test_bridge(self):
        self.check("Bridge", BRIDGE)

    def test_core_knows_neither_vtk_nor_bridge(self):
        for path in glob.glob(os.path.join(SOURCE, "Filters", "Core", "**", "*.*"), recursive=True):
            with open(path, encoding="utf-8") as file:
                self.assertNotRegex(file.read(), r'#include [<"](vtk|Bridge/)', path)

    def test_kernels_know_no_eigen(self):
        for path in glob.glob(os.path.join(SOURCE, "Filters", "Core", "*", "Kernels", "*")):
            with open(path, encoding="utf-8") as file:
                self.assertNotIn("Eigen", file.read(), path)


if __name__ == "__main__":
    main()

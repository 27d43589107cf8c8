# SPDX-License-Identifier: BSD-3-Clause
"""Which file may include which, as Documentation/Contributing.md states it."""
import collections
import glob
import os
import re
import unittest

from rt_testing import SOURCE, main

CORE = {  # besides Messages, which all may include
    "Messages": set(),
    "Parallel": set(),
    "Algebra": {"Parallel"},
    "Device": {"Parallel"},
    "Geometry": {"Parallel"},
    "Drawing": {"Parallel", "Geometry"},
    "Mesh": {"Parallel", "Geometry"},
    "Tables": {"Parallel", "Geometry"},
    "Flow": {"Parallel", "Device", "Geometry", "Tables"},
    "Grid": {"Parallel", "Geometry"},
    "Equalize": {"Parallel", "Geometry", "Grid", "Tables", "Flow"},
    "OptimalMap": {"Parallel", "Geometry", "Grid", "Tables", "Flow"},
    "Cartogram": {"Parallel", "Geometry", "Overlap", "Tables", "Flow"},
    "SiteCells": {"Parallel", "Algebra", "Geometry", "Tables", "Flow", "PowerCells"},
    "Quality": {"Parallel", "Geometry", "Tables", "Flow"},
    "PowerCells": {"Parallel", "Algebra", "Geometry", "Tables"},
    "Relaxation": {"Parallel", "Algebra", "Geometry", "Tables", "Flow", "PowerCells"},
    "Plan": {"Parallel", "Geometry", "Tables", "Flow", "OptimalMap"},
    "Blend": {"Parallel", "Geometry", "Flow", "Splat", "Plan"},
    "Distance": {"Parallel", "Geometry", "Tables", "Plan"},
    "Seeds": {"Parallel", "Geometry"},
    "Series": {"Parallel", "Geometry", "Tables", "Flow", "Splat", "Plan"},
    "Splat": {"Parallel", "Geometry"},
    "Overlap": {"Parallel", "Geometry"},
    "Resampling": {"Parallel", "Geometry", "Tables", "Overlap"},
    "Solid": {"Parallel", "Geometry", "Mesh"},
    "Parameterization": {"Parallel", "Algebra", "Geometry", "Mesh", "Tables", "Flow"},
    "SurfaceRelaxation": {"Parallel", "Geometry", "Mesh", "Tables"},
    "Seams": {"Parallel", "Geometry", "Mesh", "Parameterization"},
    "SurfaceSampling": {"Parallel", "Geometry", "Mesh", "Tables", "Flow", "Seeds",
                        "Parameterization"},
}
# Of the folders within OptimalMap: those there, and of Core.
OPTIMAL_MAP = {
    "Nodes": (set(), {"Parallel", "Geometry", "Grid"}),
    "Masses": ({"Nodes"}, {"Parallel", "Geometry", "Grid", "Tables"}),
}
RUN = {"Run"}
WORKERS = RUN | {"Data", "Density", "Plan", "Ranks", "Store"}
BRIDGE = collections.defaultdict(lambda: WORKERS, {  # rooms that are not named are workers
    "Run": set(),
    "Data": RUN,
    "Ranks": RUN | {"Data"},
    "Triangles": RUN | {"Data", "Ranks"},
    "Drawing": RUN | {"Data"},
    "Store": RUN,
    "Density": RUN | {"Data", "Ranks", "Store"},
    "Plan": RUN | {"Density", "Store"},
    "Blocks": RUN | {"Data", "Ranks", "Store"},
    "Cells": RUN | {"Data", "Ranks", "Density", "Blocks", "Store"},
    "Ensembles": WORKERS | {"Splat"},
    "Temporal": WORKERS | {"Splat"},
    **{folder: WORKERS | {"Blocks"} for folder in ("Cartogram", "SiteCells")},
    "Surfaces": WORKERS | {"Triangles"},
})


FILTERS = os.path.join(SOURCE, "Filters")


def sources(*pattern):
    """Pairs of the path from Filters and the text of each source file."""
    for path in sorted(glob.glob(os.path.join(FILTERS, *pattern), recursive=True)):
        if path.endswith((".h", ".txx", ".cxx")):
            with open(path, encoding="utf-8") as file:
                yield os.path.relpath(path, FILTERS), file.read()


class Includes(unittest.TestCase):
    def check(self, top, allowed):
        found = 0
        for path, text in sources(top, "*", "**", "*"):
            own = path.split(os.sep)[1]
            for folder in re.findall(r'#include "(?:%s|\.\.)/(\w+)/' % top, text):
                found += 1
                with self.subTest(path, includes=folder):
                    self.assertIn(folder, allowed[own] | {own, "Messages"})
        self.assertGreater(found, 50)

    def test_core(self):
        self.check("Core", CORE)

    def test_optimal_map(self):
        for room, (rooms, folders) in OPTIMAL_MAP.items():
            found = 0
            for path, text in sources("Core", "OptimalMap", room, "*"):
                for folder, name in re.findall(r'#include "Core/(\w+)/([\w/]+)[.]', text):
                    found += 1
                    with self.subTest(path, includes=name):
                        if folder == "OptimalMap":
                            self.assertIn(name.rpartition("/")[0], rooms | {room})
                        else:
                            self.assertIn(folder, folders)
            self.assertGreater(found, 10)

    def test_bridge(self):
        self.check("Bridge", BRIDGE)

    def test_pipeline(self):
        """What VTK's executive lacks knows nothing of runs."""
        for path, text in sources("Bridge", "Run", "Pipeline", "*"):
            for included in re.findall(r'#include "(Bridge/(?!VTKCompatibility).*)"', text):
                with self.subTest(path, includes=included):
                    self.assertTrue(included.startswith("Bridge/Run/Pipeline/"))

    def outside(self, pattern, *places):
        """The files outside of some places in which a pattern is found."""
        return [path for path, text in sources("**", "*")
                if not path.startswith(places) and re.search(pattern, text)]

    def test_plans(self):
        """All maps between two densities are plans: a second class of them, or an optimal map that is
        solved elsewhere, would need its own fall-back, bound and memory."""
        solvers = tuple(os.path.join("Core", room, "") for room in ("Plan", "Flow", "OptimalMap"))
        self.assertEqual(self.outside(r":\s*public\s+PointTransport\b", *solvers), [])
        self.assertEqual(self.outside(r'#include "(?:Core|[.][.])/OptimalMap/', *solvers), [])

    def test_store(self):
        """What was computed is kept and shared in one place, and compared in one way. Devices are no
        results; the others hash what they read for DataIdentity."""
        self.assertEqual(self.outside(r"\bweak_ptr\b", *(os.path.join(*place) for place in (
            ("Bridge", "Store", ""), ("Core", "Device", ""), ("Core", "Flow", "Devices", "")))), [])
        self.assertEqual(self.outside(r"\bfingerprint\(", *(os.path.join("Bridge", place, "")
                                                          for place in ("Store", "Run", "Density"))), [])

    def test_relative_paths(self):
        """Public headers of Core include each other by them, where no other project's folder Core can come
        in between; all others name the path from Filters."""
        with open(os.path.join(FILTERS, "Core", "CMakeLists.txt"), encoding="utf-8") as file:
            listed = re.search(r"^set\(public_headers\n(.*?)\)$", file.read(), re.MULTILINE | re.DOTALL)
        public = {os.path.join("Core", header) for header in listed.group(1).split()}
        self.assertGreater(len(public), 40)
        for path, text in sources("**", "*"):
            for included in re.findall(r'#include "(.*)"', text):
                with self.subTest(path, includes=included):
                    if path in public:
                        self.assertIn(os.path.normpath(os.path.join(os.path.dirname(path), included)),
                                      public)
                    else:
                        self.assertFalse(included.startswith("."))

    def test_transport(self):
        """Transport.h includes what it likes of Core; only its own sources include it."""
        for path, text in sources("**", "*"):
            if not path.startswith(os.path.join("Core", "Transport")):
                self.assertNotIn('"Core/Transport', text, path)

    def test_core_knows_neither_vtk_nor_bridge(self):
        for path, text in sources("Core", "**", "*"):
            self.assertNotRegex(text, r'#include [<"](vtk|Bridge/)', path)

    def test_headers_of_filters(self):
        """Only a filter's own source and its subclasses include its header."""
        headers = {os.path.basename(path): re.findall(r"class \w+EXPORT (\w+) : public (\w+)", text)
                   for path, text in sources("vtk*.h")}
        classes = {header: found[0] for header, found in headers.items() if found}
        self.assertGreater(len(classes), 10)
        for path, text in sources("**", "*"):
            own = os.path.splitext(path)[0]
            for header in re.findall(r'#include "(?:.*/)?(vtk\w+[.]h)"', text):
                if header in classes and header != own + ".h":
                    with self.subTest(path, includes=header):
                        self.assertEqual(classes[header][0], classes.get(path, ("", ""))[1])

    def test_headers_of_filters_include_no_worker(self):
        for path, text in sources("vtk*.h"):
            for included in re.findall(r'#include "((?:Bridge|Core)/.*)"', text):
                with self.subTest(path):
                    self.assertEqual(included, "Bridge/VTKCompatibility.h")

    def test_kernels_know_no_eigen(self):
        kernels = {**dict(sources("Core", "**", "*.txx")),
                   **dict(sources("Core", "*", "Kernels", "*"))}
        self.assertIn(os.path.join("Core", "Flow", "Kernels", "Vectors.txx"), list(kernels))
        for path, text in kernels.items():
            self.assertFalse("Eigen" in text, path)


if __name__ == "__main__":
    main()

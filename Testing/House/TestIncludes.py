# SPDX-License-Identifier: BSD-3-Clause
"""Which file may include which, as Documentation/Contributing.md states it."""
import collections
import glob
import os
import re
import sys
import unittest

from figures import ROOT

CORE = {  # besides Messages, which all may include
    "Messages": set(),
    "Parallel": set(),
    "Algebra": {"Parallel"},
    "Device": {"Parallel"},
    "Geometry": {"Parallel"},
    "Drawing": {"Parallel", "Geometry"},
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
}
SURFACES = {  # of Surfaces, and of Core; besides Messages, which all may include
    "Mesh": (set(), {"Parallel", "Geometry"}),
    "Solid": ({"Mesh"}, {"Parallel", "Geometry"}),
    "Parameterization": ({"Mesh"}, {"Parallel", "Algebra", "Geometry", "Tables", "Flow"}),
    "SurfaceRelaxation": ({"Mesh"}, {"Parallel", "Geometry", "Tables"}),
    "Seams": ({"Mesh", "Parameterization"}, {"Parallel", "Geometry"}),
    "SurfaceSampling": ({"Mesh", "Parameterization"},
                        {"Parallel", "Geometry", "Tables", "Flow", "Seeds"}),
}
DEVICES = {"Parallel", "Device", "Geometry", "Tables", "Flow"}  # of Core
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
    "Cells": RUN | {"Data", "Ranks", "Density", "Blocks", "Store", "Triangles"},
    **{folder: WORKERS | {"Blocks"} for folder in ("Cartogram", "SiteCells")},
})


FILTERS = os.path.join(ROOT, "Filters")


def sources(*pattern):
    """Pairs of the path from Filters and the text of each source file."""
    for path in sorted(glob.glob(os.path.join(FILTERS, *pattern), recursive=True)):
        if path.endswith((".h", ".txx", ".cxx")):
            with open(path, encoding="utf-8") as file:
                yield os.path.relpath(path, FILTERS), file.read()


def included(path, text):
    """The files that a source includes by names in quotes, with their paths from Filters."""
    for name in re.findall(r'#include "(.*)"', text):
        yield os.path.normpath(os.path.join(os.path.dirname(path), name)) if name.startswith(".") else name


class Includes(unittest.TestCase):
    def check(self, top, allowed, within=None):
        """Of the library `within`, else of their own one, rooms of `top` include those that are allowed."""
        within = within or top
        found = 0
        for path, text in sources(top, "*", "**", "*"):
            own = path.split(os.sep)[1]
            for name in included(path, text):
                library, _, rest = name.partition("/")
                folder = rest.partition("/")[0]
                if library == within and "/" in rest:
                    found += 1
                    with self.subTest(path, includes=folder):
                        self.assertIn(folder, allowed[own] | {"Messages", own if within == top else ""})
        self.assertGreater(found, 50)

    def test_core(self):
        self.check("Core", CORE)

    def test_surfaces(self):
        self.check("Surfaces", {room: rooms for room, (rooms, _) in SURFACES.items()})
        self.check("Surfaces", {room: rooms for room, (_, rooms) in SURFACES.items()}, "Core")

    def test_devices(self):
        rooms = set()
        for path, text in sources("Devices", "*"):
            for name in included(path, text):
                self.assertRegex(name, "^(Core|Devices)/", path)
                rooms |= set(re.findall("^Core/(\\w+)/", name))
        self.assertLessEqual(rooms, DEVICES)
        # Only the base of the filters knows of them.
        self.assertEqual(self.outside('#include "Devices/', os.path.join("Devices", "")),
                         [os.path.join("Common", "vtkTransportAlgorithm.cxx")])

    def test_libraries(self):
        """Of the mathematics, Core is below Surfaces and Devices; only the latter know OpenCL."""
        for library, others in (("Core", "Surfaces|Devices"), ("Surfaces", "Devices")):
            for path, text in sources(library, "**", "*"):
                for name in included(path, text):
                    self.assertNotRegex(name, "^(%s)/" % others, path)
        self.assertEqual(self.outside("#include <CL/", os.path.join("Devices", "")), [])

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

    def test_modules(self):
        """VTK's modules share what is in Common, and nothing else: each can be built without the others."""
        module = {}  # of a file without its extension
        for path in glob.glob(os.path.join(FILTERS, "*", "vtk.module")):
            name = os.path.basename(os.path.dirname(path))
            with open(os.path.join(os.path.dirname(path), "CMakeLists.txt"), encoding="utf-8") as file:
                text = file.read()
            for group, files in re.findall(r"^set\((classes|bridge)\n(.*?)\)$", text, re.M | re.S):
                for entry in files.split():
                    module[entry if group == "classes" else "Bridge/" + entry.replace(".cxx", "")] = name
        self.assertEqual(set(module.values()), {"Common", "Densities", "Drawing", "Meshes"})
        rooms = {path.split("/")[1]: name for path, name in module.items() if path.startswith("Bridge/")}
        for path, text in sources("**", "*"):
            stem = os.path.splitext(path)[0]
            room = path.split("/")[1] if path.startswith("Bridge/") and path.count("/") > 1 else ""
            own = module.get(os.path.basename(stem)) or module.get(stem) or rooms.get(room)
            for name in included(path, text):
                stem = os.path.splitext(name)[0]
                other = module.get(os.path.basename(stem) if "/" not in stem else stem)
                if own and (other or name.startswith("Bridge/") and name.count("/") > 1):
                    with self.subTest(path, includes=name):
                        self.assertIn(other or rooms[name.split("/")[1]], {own, "Common"})

    def test_pipeline(self):
        """What VTK's executive lacks knows nothing of runs."""
        for path, text in sources("Bridge", "Run", "Pipeline", "*"):
            for name in re.findall(r'#include "(Bridge/(?!VTKCompatibility).*)"', text):
                with self.subTest(path, includes=name):
                    self.assertTrue(name.startswith("Bridge/Run/Pipeline/"))

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
            ("Bridge", "Store", ""), ("Core", "Flow", "Devices", ""), ("Devices", "")))), [])
        self.assertEqual(self.outside(r"\bfingerprint\(", *(os.path.join("Bridge", place, "")
                                                          for place in ("Store", "Run", "Density"))), [])

    def test_relative_paths(self):
        """Public headers of the mathematics include each other by them, where no other project's folder
        Core can come in between; all others name the path from Filters."""
        public = set()
        for library in ("Core", "Surfaces", "Devices"):
            with open(os.path.join(FILTERS, library, "CMakeLists.txt"), encoding="utf-8") as file:
                listed = re.search(r"^ *set\(public_headers\n(.*?)\)$", file.read(), re.MULTILINE | re.DOTALL)
            public |= {os.path.join(library, header) for header in listed.group(1).split()}
        self.assertGreater(len(public), 70)
        for path, text in sources("**", "*"):
            for name in re.findall(r'#include "(.*)"', text):
                with self.subTest(path, includes=name):
                    if path in public:
                        self.assertIn(os.path.normpath(os.path.join(os.path.dirname(path), name)), public)
                    else:
                        self.assertFalse(name.startswith("."))

    def test_transport(self):
        """Transport.h includes what it likes of Core; only its own sources include it, and the other
        header of simple calls."""
        for path, text in sources("**", "*"):
            if not path.startswith((os.path.join("Core", "Transport"), "Surfaces/Surfaces.cxx")):
                self.assertNotIn('"Core/Transport', text, path)

    def test_mathematics_knows_neither_vtk_nor_bridge(self):
        for library in ("Core", "Surfaces", "Devices"):
            for path, text in sources(library, "**", "*"):
                self.assertNotRegex(text, r'#include [<"](vtk|Bridge/)', path)

    def test_headers_of_filters(self):
        """Only a filter's own source and its subclasses include its header."""
        headers = {os.path.basename(path): re.findall(r"class \w+EXPORT (\w+)\s+: public (\w+)", text)
                   for path, text in sources("*", "vtk*.h")}
        classes = {header: found[0] for header, found in headers.items() if found}
        self.assertGreater(len(classes), 10)
        for path, text in sources("**", "*"):
            own = os.path.splitext(os.path.basename(path))[0] + ".h"
            for header in re.findall(r'#include "(?:.*/)?(vtk\w+[.]h)"', text):
                if header in classes and header != own:
                    with self.subTest(path, includes=header):
                        self.assertEqual(classes[header][0], classes.get(own, ("", ""))[1])

    def test_headers_of_filters_include_no_worker(self):
        for path, text in sources("*", "vtk*.h"):
            for name in re.findall(r'#include "((?:Bridge|Core|Surfaces|Devices)/.*)"', text):
                with self.subTest(path):
                    self.assertEqual(name, "Bridge/VTKCompatibility.h")

    def test_kernels_know_no_eigen(self):
        kernels = {**dict(sources("**", "*.txx")), **dict(sources("*", "*", "Kernels", "*"))}
        self.assertIn(os.path.join("Core", "Flow", "Kernels", "Vectors.txx"), list(kernels))
        for path, text in kernels.items():
            self.assertFalse("Eigen" in text, path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

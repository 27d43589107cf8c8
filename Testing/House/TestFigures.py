# SPDX-License-Identifier: BSD-3-Clause
"""No figure of the sources passes its budget, and figures.py counts what it says."""
import json
import os
import re
import sys
import tempfile
import unittest

from figures import (BRIDGE, FIGURES, Tree, code_lines, doubled_names, value_of, without_ctags,
                     without_names)

SKIPPED = 77
BUDGETS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "budgets.json")


def read_budgets():
    with open(BUDGETS, encoding="utf-8") as file:
        return json.load(file)


def values(tree, names):
    return {name: value_of(FIGURES[name].count(tree)) for name in names}


def passed_budgets(found, budgets):
    """A line for each figure that passes its budget: its value, what it lists, and what to do."""
    lines = []
    for name, (value, listed) in found.items():
        budget = budgets[name]["budget"]
        if value > budget:
            named = " (%s)" % ", ".join(listed) if listed else ""
            lines.append("%s is %s, above its budget of %s%s: %s." % (
                name, value, budget, named, FIGURES[name].advice))
    return lines


class Budgets(unittest.TestCase):
    def test_all_figures_have_one(self):
        self.assertEqual(sorted(read_budgets()), sorted(FIGURES))

    def test_none_is_passed(self):
        budgets = read_budgets()
        found = values(Tree(), budgets)
        for name, (value, _) in found.items():
            target = budgets[name].get("target", "")
            print("%-26s %8s  budget %8s  target %s" % (name, value, budgets[name]["budget"], target))
        passed = passed_budgets(found, budgets)
        if passed:
            self.fail("\n%s\nThe budgets of Testing/House/budgets.json are only lowered, except for a "
                      "filter, property, choice or repair." % "\n".join(passed))

    def test_names_in_programs_of_tests(self):
        """Each folder is one program, or few, that contain the sources, too."""
        for folder in ("Core", "Surfaces", "Devices", "Cxx", "Campaign", "Benchmarks", "Device"):
            self.assertEqual(doubled_names(Tree(), ["Testing/" + folder]), [])


class Namespaces(unittest.TestCase):
    def test_bridge_has_its_own(self):
        """Else one of its names could be a name of Core, too."""
        tree = Tree()
        for path in tree.under(BRIDGE):
            if path != BRIDGE + "VTKCompatibility.h":
                with self.subTest(path):
                    self.assertIn("\nnamespace RectifiedTransport::Bridge\n", tree.text(path))
                    # In the namespace of Core, the bridge only declares Core's classes.
                    for body in re.findall(r"^namespace RectifiedTransport\n{\n(.*?)^}", tree.text(path),
                                           re.MULTILINE | re.DOTALL):
                        self.assertRegex(body, r"^(?:(?:class|struct) \w+;\n)+$")


class SmallTree(unittest.TestCase):
    """A tree with a few files, not under git."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name

    def write(self, path, text):
        full = os.path.join(self.root, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        with open(full, "w", encoding="utf-8") as file:
            file.write(text)

    def value(self, name):
        return value_of(FIGURES[name].count(Tree(self.root)))[0]

    def test_an_empty_tree(self):
        for name in FIGURES:
            with self.subTest(name):
                self.assertEqual(self.value(name), 0)

    def test_passed_budget(self):
        self.write("Filters/Bridge/Run/Memory.cxx", "int a;\nint b;\n")
        found = values(Tree(self.root), ["bridge"])
        self.assertEqual(passed_budgets(found, {"bridge": {"budget": 2}}), [])
        line, = passed_budgets(found, {"bridge": {"budget": 1}})
        self.assertRegex(line, "^bridge is 2, above its budget of 1: move .*[.]$")

    def test_passed_budget_of_a_list(self):
        line, = passed_budgets({"doubled": (1, ["Box in A.h"])}, {"doubled": {"budget": 0}})
        self.assertRegex(line, "^doubled is 1, above its budget of 0 [(]Box in A.h[)]: rename .*[.]$")

    def test_code_lines(self):
        self.assertEqual(code_lines("""
// a comment
/// another one
/* one of

   several lines */
/* before */ int code;
int more; /* that goes
on */ int last; // and ends
const char* text = "/* no comment";
const char* other = "\\"// nor this";
  /* and */ // none
"""), 5)

    def test_lines(self):
        self.write("Filters/Core/Flow/Flow.h", "int a;\n// b\n\nint c;\n")
        self.write("Filters/Surfaces/Mesh/Mesh.cxx", "int a;\nint b;\n")
        self.write("Filters/Bridge/Run/Memory.cxx", "int a;\n")
        self.write("Filters/Core/Flow/Notes.txt", "not a source\n")
        self.write("Plugin/Filter.xml", "<a>\n\n</a>\n")
        self.write("Plugin/Panel/Widget.cxx", "int a;\n")
        self.assertEqual(self.value("product"), 8)
        self.assertEqual(self.value("bridge"), 1)
        self.assertEqual(self.value("share"), 0.25)

    def test_sources_that_hardly_name_vtk(self):
        self.write("Filters/Bridge/Run/Few.cxx", "vtkA vtkB vtkC vtkD vtkRectifiedTransport\n")
        self.write("Filters/Bridge/Run/Many.cxx", "vtkA vtkB vtkC vtkD vtkA\n")
        self.assertEqual(self.value("bridge_vtk_poor"), 1)

    def test_rooms(self):
        self.write("Filters/Bridge/Version.h", '#include "Core/Flow/Flow.h"\n')
        self.write("Filters/Bridge/Run/Run.h", '#include "Core/Flow/Flow.h"\n#include "Bridge/Run/A.h"\n')
        self.write("Filters/Bridge/Data/Points.h", '#include "Bridge/Run/Run.h"\n')
        self.write("Filters/Bridge/Blend/Blend.h", '#include "Bridge/Data/Points.h"\n'
                   '#include "Bridge/Run/Run.h"\n#include "Core/Flow/Flow.h"\n')
        self.assertEqual(self.value("bridge_rooms"), 3)
        self.assertEqual(self.value("bridge_most_known"), 3)
        self.assertEqual(self.value("bridge_floors"), 3)
        self.write("Filters/Bridge/Run/Memory.h", '#include "Bridge/Blend/Blend.h"\n')
        self.assertGreaterEqual(self.value("bridge_floors"), 99)

    def test_large_folders(self):
        for number in range(30):
            self.write("Filters/Core/Flow/%d.h" % number, "")
            self.write("Filters/Core/Flow/Deep/%d.h" % number, "")
        self.assertEqual(self.value("large_folders"), 0)
        self.write("Filters/Core/Flow/30.h", "")
        self.assertEqual(self.value("large_folders"), 1)

    def doubled(self):
        return FIGURES["doubled"].count(Tree(self.root))

    def test_doubled_types(self):
        self.write("Filters/Core/Splat/Box.h", "namespace Transport { struct Box { int Low; }; }\n")
        self.write("Filters/Core/Quality/Other.h",
                   "namespace Transport { class Box; struct Range { struct Box {}; };\n"
                   "namespace Inner { struct Box {}; } namespace { struct Box {}; } }\n")
        self.assertEqual(self.doubled(), [])
        planted = "namespace Transport\n{\ntemplate <int D>\nclass Box\n{\n  double High[D];\n};\n}\n"
        for path in ("Filters/Core/Quality/Quality.h", "Filters/Bridge/Run/Memory.cxx"):
            self.write(path, planted)
            self.assertEqual(self.doubled(), ["Transport::Box (%s)" % ", ".join(
                sorted([path, "Filters/Core/Splat/Box.h"]))])
            os.remove(os.path.join(self.root, path))

    def test_doubled_functions(self):
        self.write("Filters/Core/Splat/Sum.h", "namespace Transport { int sum(int); int last(int);\n"
                   "inline double sum(double a) { return a; } template <int D> void fill(int) {} }\n")
        self.write("Filters/Core/Splat/Sum.cxx", "namespace Transport { int sum(int a) { return a; }\n"
                   "namespace { double sum(double a) { return a; } }\n"
                   "static int last(int a) { return a; } template <class T> void fill(int) {} }\n")
        self.write("Filters/Core/Quality/Sum.cxx",
                   "namespace Transport { static int last(int a) { return 2 * a; } }\n")
        self.assertEqual(self.doubled(), [])
        self.write("Filters/Core/Quality/Sum.h",
                   "namespace Transport { inline double sum(double b) { return -b; }\n"
                   "inline double sum(double a, double b) { return a + b; } }\n")
        self.assertEqual(len(self.doubled()), 1, self.doubled())

    def test_names_of_parameters(self):
        for named, unnamed in (
                ("(double a, const Point<D, Real> & low, char * text = nullptr)",
                 "(double, const Point<D, Real> &, char *)"),
                ("(unsigned char value, Box)", "(unsigned char, Box)"),
                ("int D, class Real", "int, class")):
            self.assertEqual(without_names(named), unnamed)
            self.assertEqual(without_names(unnamed), unnamed)

    def test_names_of_further_folders(self):
        self.write("Filters/Core/Splat/Box.h", "namespace Transport { struct Box { int Low; }; }\n")
        self.write("Testing/Core/TestSplat.cxx", "namespace Transport { struct Box {}; }\n")
        self.assertEqual(self.doubled(), [])
        self.assertEqual(len(doubled_names(Tree(self.root), ["Testing/Core"])), 1)

    def test_enumerators(self):
        self.write("Filters/Meshes/vtkA.h", "enum Kind\n{\n  FLOW = 1, // first, always\n  MAP,\n  LAST\n};\n")
        self.write("Filters/Meshes/vtkB.h", "enum Method\n{\n  FLOW = 1,\n  MAP = 3\n};\n")
        self.write("Filters/Core/vtkC.h", "enum Method\n{\n  FLOW\n};\n")
        self.assertEqual(FIGURES["enumerators_of_two_values"].count(Tree(self.root)), ["MAP"])

    def test_progress(self):
        text = "void run(int a, Progress& progress, double end);\nvoid walk(Progress& progress);\n"
        self.write("Filters/Core/Flow/Flow.h", text)
        self.write("Filters/Bridge/Run/Run.h", text)
        self.write("Filters/Meshes/vtkMap.h", text)
        self.assertEqual(self.value("progress_signatures"), 2)

    def test_fragments(self):
        self.write("Filters/Core/Flow/Flow.h", "// Of all cells.\n  /// of some\nint a; // of cells\n"
                   "// A mean of all.\nint b; // one of them\n")
        self.assertEqual(self.value("fragments"), 3)

    def test_words(self):
        self.write("README.md", "three short words\n")
        self.write("Documentation/Pages/Map.md", "two\nmore\n")
        self.write("CHANGELOG.md", "none of these\n")
        self.assertEqual(self.value("words"), 5)

    def test_long_pages(self):
        self.write("README.md", "word " * 2001)
        self.write("Documentation/Map.md", "word " * 2000)
        self.write("Documentation/Speed.md", "word " * 3000)
        self.assertEqual(self.value("long_pages"), 1)


if __name__ == "__main__":
    MISSING = without_ctags()
    if MISSING and os.environ.get("CI"):
        sys.exit("TestFigures.py " + MISSING)
    if MISSING:
        print("Skipped: it " + MISSING)
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1], verbosity=2)

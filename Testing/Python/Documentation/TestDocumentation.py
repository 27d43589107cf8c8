# SPDX-License-Identifier: BSD-3-Clause
"""The Python in README.md and Documentation/ runs as it stands, from the project's folder. Links lead
somewhere, and files that are named are there."""
import contextlib
import fnmatch
import glob
import os
import re
import shutil
import sys
import tempfile
import unittest

from rt_filters import FILTERS
from rt_scripts import run_script
from rt_testing import OUTPUT, SOURCE, main, need_display

sys.path.insert(0, os.path.join(SOURCE, "Examples"))
from rectified_raster import island, write_geotiff


def blocks():
    """The pages' Python blocks, each with its page and line."""
    for page in ["README.md", *sorted(glob.glob("Documentation/*.md", root_dir=SOURCE))]:
        with open(os.path.join(SOURCE, page), encoding="utf-8") as file:
            text = file.read()
        for found in re.finditer(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
            yield "%s, line %d" % (page, text.count("\n", 0, found.start()) + 2), found.group(1)


# Where the names of files in the text begin, and what is made only when something runs.
ROOTS = ("", "Filters", "Filters/Core", "Filters/Surfaces")
MADE = ("Examples/output", "build")


def read(page):
    """A page's text, without and with what stands between fences."""
    with open(os.path.join(SOURCE, page), encoding="utf-8") as file:
        text = file.read()
    return re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL), text


def anchors(page):
    """What a link to a heading of a page ends with, as GitHub and GitLab make it of the heading."""
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")
            for heading in re.findall(r"^#+ (.*)$", read(page)[0], re.MULTILINE)}


def names():
    """The names of all files of the project, built ones aside."""
    found = set()
    for folder in ("CMake", "Documentation", "Examples", "Filters", "Plugin", "Python", "Testing"):
        for _, _, files in os.walk(os.path.join(SOURCE, folder)):
            found.update(files)
    return found


class Pages(unittest.TestCase):
    def setUp(self):
        self.pages = [page for pattern in ("README.md", "CONTRIBUTING.md", "SECURITY.md", "Documentation/*.md",
                                           "Examples/README.md", "Examples/*/README.md",
                                           "Testing/*/README.md")
                      for page in sorted(glob.glob(pattern, root_dir=SOURCE))]
        self.assertGreater(len(self.pages), 20)

    def test_links(self):
        for page in self.pages:
            text = read(page)[0]
            links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'<img src="([^"]+)"', text)
            for link in links:
                if link.startswith("http"):
                    continue
                with self.subTest("%s: %s" % (page, link)):
                    path, _, anchor = link.partition("#")
                    target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path \
                        else page
                    self.assertTrue(os.path.exists(os.path.join(SOURCE, target)))
                    if anchor:
                        self.assertIn(anchor, anchors(target))

    def test_filters_on_ranks(self):
        """The page of each filter says what several ranks have of it."""
        for filter_ in FILTERS:
            with self.subTest(filter_.label):
                self.assertIn("](Parallel.md)", read("Documentation/%s.md" % filter_.name)[0])

    def test_named_files(self):
        """Paths in code spans and includes lead to files; so do names of sources without a path."""
        known = names()
        folders = [entry for entry in os.listdir(SOURCE) + os.listdir(os.path.join(SOURCE, "Filters"))
                   if "." not in entry]
        path = re.compile(r"(?:%s)/[\w.*/-]*" % "|".join(folders))
        for page in self.pages:
            text, whole = read(page)
            spans = re.findall(r"`([^`\n]+)`", text)
            named = [name for span in spans for name in path.findall(span)]
            named += re.findall(r"#include [<\"](?:RectifiedTransport/)?((?:Core|Surfaces)/[^>\"]+)", whole)
            for name in named:
                if name.startswith(MADE):
                    continue
                with self.subTest("%s: %s" % (page, name)):
                    self.assertTrue(any(glob.glob(os.path.join(SOURCE, root, name))
                                        for root in ROOTS))
            for name in re.findall(r"^([\w*]+\.(?:h|cxx|txx|py))$", "\n".join(spans), re.MULTILINE):
                with self.subTest("%s: %s" % (page, name)):
                    self.assertTrue(fnmatch.filter(known, name))


class Documentation(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(dir=OUTPUT)
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("Examples", "Testing"):
            os.symlink(os.path.join(SOURCE, name), os.path.join(self.folder, name))
        os.symlink(os.path.join(SOURCE, "Testing", "Data", "raccoon.png"),
                   os.path.join(self.folder, "photograph.png"))
        write_geotiff(os.path.join(self.folder, "people.tif"), island())

    def test_blocks(self):
        self.assertGreater(len(list(blocks())), 2)
        for place, code in blocks():
            with self.subTest(place):
                script = os.path.join(self.folder, "block.py")
                code = re.sub(r'LoadPlugin\("build/[^"]*"',
                              "LoadPlugin(%r" % os.environ["RT_PLUGIN"], code)
                with open(script, "w", encoding="utf-8") as file:
                    file.write(code)
                with contextlib.chdir(self.folder):
                    printed, messages, code = run_script(script)
                self.assertEqual(code, 0, printed + messages)
                self.assertNotIn("ERR|", messages)


if __name__ == "__main__":
    need_display()
    main()

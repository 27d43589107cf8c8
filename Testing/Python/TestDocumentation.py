# SPDX-License-Identifier: BSD-3-Clause
"""The Python in README.md and Documentation/ runs as it stands, from the project's folder."""
import glob
import importlib.util
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from rt_testing import OUTPUT, SOURCE, main, need_display


def blocks():
    """The pages' Python blocks, each with its page and line."""
    for page in ["README.md", *sorted(glob.glob("Documentation/*.md", root_dir=SOURCE))]:
        with open(os.path.join(SOURCE, page), encoding="utf-8") as file:
            text = file.read()
        for found in re.finditer(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
            yield "%s, line %d" % (page, text.count("\n", 0, found.start()) + 2), found.group(1)


def is_installed(code):
    """Whether what a block imports beyond ParaView and the project is there."""
    return "scipy" not in code or importlib.util.find_spec("scipy")


class Documentation(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(dir=OUTPUT)
        self.addCleanup(shutil.rmtree, self.folder)
        os.symlink(os.path.join(SOURCE, "Testing"), os.path.join(self.folder, "Testing"))
        os.symlink(os.path.join(SOURCE, "Testing", "Data", "raccoon.png"),
                   os.path.join(self.folder, "photograph.png"))

    def test_blocks(self):
        self.assertGreater(len(list(blocks())), 2)
        for place, code in blocks():
            if not is_installed(code):
                continue
            with self.subTest(place):
                script = os.path.join(self.folder, "block.py")
                code = re.sub(r'LoadPlugin\("build/[^"]*"',
                              "LoadPlugin(%r" % os.environ["RT_PLUGIN"], code)
                with open(script, "w", encoding="utf-8") as file:
                    file.write(code)
                done = subprocess.run(
                    [os.environ.get("RT_PVPYTHON", "pvpython"), script], cwd=self.folder,
                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
                self.assertEqual(done.returncode, 0, done.stdout)
                self.assertNotIn("ERR|", done.stdout)


if __name__ == "__main__":
    need_display()
    main()

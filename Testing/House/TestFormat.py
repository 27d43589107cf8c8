# SPDX-License-Identifier: BSD-3-Clause
"""All C++ sources are as clang-format leaves them with the project's .clang-format."""
import glob
import os
import re
import shutil
import subprocess
import sys
import unittest

from figures import ROOT

SKIPPED = 77
# Other versions make other lines of the same style: this one is that of Debian 12.
VERSION = "14"


def find_formatter():
    """clang-format of that version, or None with what was found instead."""
    found = []
    for name in ("clang-format-" + VERSION, "clang-format"):
        path = shutil.which(name)
        if path:
            said = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
            if re.search(r"version %s\." % VERSION, said):
                return path, ""
            found.append(said.strip())
    return None, ", ".join(found) or "none"


class Format(unittest.TestCase):
    def test_sources(self):
        # Not by git, which an archive of the sources lacks.
        sources = [path for folder in ("Filters", "Plugin", "Testing", "Examples")
                   for path in sorted(glob.glob(os.path.join(folder, "**", "*"),
                                                root_dir=ROOT, recursive=True))
                   if path.endswith((".h", ".cxx", ".txx"))]
        self.assertGreater(len(sources), 500)
        result = subprocess.run([FORMATTER, "--dry-run", "-Werror", *sources], cwd=ROOT,
                                stderr=subprocess.PIPE, text=True)
        wrong = sorted(set(re.findall(r"^([^\s:]+):\d+:\d+: error:", result.stderr, re.MULTILINE)))
        self.assertEqual(result.returncode, 0, "%s\nRun: %s -i %s" % (
            result.stderr, os.path.basename(FORMATTER), " ".join(wrong)))


if __name__ == "__main__":
    FORMATTER, others = find_formatter()
    if not FORMATTER:
        print("Skipped: it needs clang-format %s; there is %s" % (VERSION, others))
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1], verbosity=2)

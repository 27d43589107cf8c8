# SPDX-License-Identifier: BSD-3-Clause
"""Each filter of rt_filters.py is in the tests that draw filters at random and that run them on ranks."""
import glob
import os
import re
import sys
import unittest

from figures import ROOT

sys.path.insert(0, os.path.join(ROOT, "Testing", "Python", "Support"))
from rt_filters import FILTERS  # noqa: E402


def text_of(*paths):
    """Of all files that a path within the sources matches."""
    text = ""
    for path in sorted(glob.glob(os.path.join(ROOT, *paths))):
        with open(path, encoding="utf-8") as file:
            text += file.read()
    return text


class Register(unittest.TestCase):
    def missing(self, text, name):
        return [name(filter_) for filter_ in FILTERS
                if not re.search(r"\b%s\b" % name(filter_), text)]

    def test_campaign(self):
        kinds = text_of("Testing", "Campaign", "*Kinds.cxx")
        self.assertEqual(self.missing(kinds, lambda filter_: filter_.class_name), [])

    def test_ranks(self):
        rows = text_of("Testing", "Python", "Ranks", "ranks_*.py")
        self.assertEqual(self.missing(rows, lambda filter_: filter_.name), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

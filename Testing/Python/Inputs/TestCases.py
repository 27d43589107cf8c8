# SPDX-License-Identifier: BSD-3-Clause
"""Inputs that made other programs fail, with right values that are known: Testing/Cases.md lists them."""
import os
import re
import unittest

from rt_testing import SOURCE, main

from cases import CASES

PAGE = os.path.join(SOURCE, "Testing", "Cases.md")


class Cases(unittest.TestCase):
    """A test a case, named by its number."""


def test_of(run):
    return lambda self: run(self)


for number, run in CASES.items():
    setattr(Cases, f"test_{number:03}_{run.__name__}", test_of(run))


class Page(unittest.TestCase):
    def rows(self):
        with open(PAGE, encoding="utf-8") as page:
            return {int(row[1]): row[0] for row in re.finditer(r"(?m)^\| (\d+) \|.*$", page.read())}

    def test_every_case_has_a_row(self):
        rows = self.rows()
        for number, run in CASES.items():
            self.assertIn(number, rows, run.__name__)

    def test_rows_name_the_sources_of_the_cases(self):
        rows = self.rows()
        for number, run in CASES.items():
            text = " ".join(run.__doc__.split())
            source = re.search(r"Source: (.*?)\. Right", text)
            self.assertIsNotNone(source, run.__name__)
            for number_of_issue in re.findall(r"\b\d{1,5}\b", source[1]):
                self.assertIn(number_of_issue, rows[number].split("|")[2], f"row {number}")


if __name__ == "__main__":
    main()

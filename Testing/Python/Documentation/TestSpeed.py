# SPDX-License-Identifier: BSD-3-Clause
"""What Testing/Benchmarks/run.py prints has the form of Documentation/Speed.md, so that it can be
pasted: tables, their rows and the sentences with figures. Nothing is measured."""
import contextlib
import io
import os
import re
import sys
import unittest

from rt_testing import SOURCE, main

sys.path.insert(0, os.path.join(SOURCE, "Testing", "Benchmarks"))
import run as benchmarks  # noqa: E402

# How many columns of a table are labels, by its first heading; and tables that run.py does not print.
LABELS = {"density": 2, "cells": 5, "triangles": 0}
WRITTEN = {"part", "what", "`Threading`", "`NumberOfSteps`", "areas of"}
PRINTED = (benchmarks.ALL,
           *(benchmarks.OPTIONS[name][2:] for name in ("tiles", "parameterization", "quality")))


class MadeUp(dict):
    """Two runs of any benchmark, with 2 and 3 of everything and no particle that strays."""

    def __missing__(self, name):
        return [MadeUpRun(value) for value in (2, 3)]


class MadeUpRun(dict):
    def __init__(self, value):
        super().__init__(in_empty_cells=0, lost=0)
        self.value = value

    def __missing__(self, what):
        return self.value


def without_figures(text):
    """The digits of a ratio after the point count. A time is in seconds or in milliseconds."""
    text = re.sub(r"\d+(\.\d+)(?=×)", lambda found: "#" + "d" * len(found[1]), text)
    return re.sub(r"-?\d[\d,]*(\.\d+)?(e[+-]\d+)?", "#", text).replace("# ms", "# s")


def first_heading(head):
    return head.split("|")[1].strip()


def tables(text):
    """The rows of each table, without figures, by the line of its headings."""
    found = {}
    for table in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        head, rule, *rows = table.splitlines()
        labels = 1 + LABELS.get(first_heading(head), 1)
        found[head] = [rule]
        for row in rows:
            cells = row.split("|")
            cells[labels:] = map(without_figures, cells[labels:])
            found[head].append("|".join(cells))
    return found


def printed(functions):
    results = benchmarks.Results({"context": {}, "benchmarks": []})
    results.runs = MadeUp()
    with contextlib.redirect_stdout(io.StringIO()) as output:
        for function in functions:
            function(results)
    return output.getvalue()


class Speed(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        with open(os.path.join(SOURCE, "Documentation", "Speed.md"), encoding="utf-8") as file:
            self.page = file.read()

    def test_tables(self):
        page = {head: rows for head, rows in tables(self.page).items()
                if first_heading(head) not in WRITTEN}
        seen = set()
        for functions in PRINTED:
            made = tables(printed(functions))
            for head, rows in made.items():
                with self.subTest(head):
                    self.assertIn(head, page)
                    self.assertEqual(rows, page[head])
            self.assertEqual(list(made), [head for head in page if head in made])
            seen.update(made)
        self.assertEqual(seen, set(page))

    def test_sentences(self):
        page = without_figures(" ".join(self.page.split()))
        for functions in PRINTED:
            for text in re.findall(r"^[^|\n].*(?:\n.+)*", printed(functions), re.MULTILINE):
                with self.subTest(text):
                    self.assertIn(without_figures(" ".join(text.split())), page)

    def test_devices(self):
        """Documentation/Devices.md has the table of --device."""
        report = ("A device\ncase,tables,processor,processor_least,device,device_least,bytes_to,"
                  "bytes_from,kernels\n\"one a cell of 1024^2\",kept,2,1,3,2,1000,2000,5\n")
        with contextlib.redirect_stdout(io.StringIO()) as output:
            benchmarks.devices(report)
        with open(os.path.join(SOURCE, "Documentation", "Devices.md"), encoding="utf-8") as file:
            page = tables(file.read())
        (head, rows), = tables(output.getvalue()).items()
        self.assertIn(head, page)
        self.assertEqual(rows[0], page[head][0])
        self.assertIn("one a cell of 1024²", [row.split("|")[1].strip() for row in page[head][1:]])


if __name__ == "__main__":
    main()

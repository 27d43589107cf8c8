# SPDX-License-Identifier: BSD-3-Clause
"""The field data of every output of every filter are its own on every rank, also where its inputs have
some of the same names."""
import functools
import json
import os
import sys
import unittest

import numpy as np
from rt_filters import FILTERS
from rt_testing import SKIPPED, main
from TestRanksTable import MPIRUN, PVBATCH, run

SCRIPT = os.path.join(os.path.dirname(__file__), "ranks_fields_script.py")


@functools.lru_cache(maxsize=None)
def alone():
    """On one rank, of inputs without field data."""
    return run(1, SCRIPT, "[]")[0]


def names():
    return sorted({name for fields in alone().values() for name in fields})


@functools.lru_cache(maxsize=None)
def with_others(ranks):
    """On each rank, of inputs whose field data have the same names."""
    return run(ranks, SCRIPT, json.dumps(names()))


class RanksFields(unittest.TestCase):
    def test_every_output(self):
        for ranks in (1, 2):
            for rank, given in enumerate(with_others(ranks)):
                self.assertEqual(given.keys(), alone().keys())
                for output, expected in alone().items():
                    for name, tuples in expected.items():
                        with self.subTest(output, field=name, rank=rank, ranks=ranks):
                            found = given[output].get(name)
                            self.assertEqual(np.shape(found), np.shape(tuples))
                            # Sites of several ranks are in another order, and so are sums.
                            np.testing.assert_allclose(found, tuples, rtol=1e-12)

    def test_none_of_an_input(self):
        """A name that is a figure of the filter on one output is no figure of its input on another."""
        figures = {}
        for output, fields in alone().items():
            figures.setdefault(output.rpartition(", port")[0], set()).update(fields)
        elsewhere = 0
        for ranks in (1, 2):
            for rank, given in enumerate(with_others(ranks)):
                for output, expected in alone().items():
                    others = figures[output.rpartition(", port")[0]] - expected.keys()
                    elsewhere += len(others)
                    with self.subTest(output, rank=rank, ranks=ranks):
                        self.assertEqual(others & given[output].keys(), set())
        self.assertGreater(elsewhere, 0)

    def test_every_filter_has_some(self):
        """But those that give no figures."""
        found = {output.split(",")[0] for output, fields in alone().items() if fields}
        for filter_ in FILTERS:
            if filter_.on_ranks:
                with self.subTest(filter_.label):
                    self.assertEqual(filter_.name in found, filter_.gives_figures)


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

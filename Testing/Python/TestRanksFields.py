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


class RanksFields(unittest.TestCase):
    def test_every_output(self):
        names = sorted({name for fields in alone().values() for name in fields})
        for ranks in (1, 2):
            for rank, given in enumerate(run(ranks, SCRIPT, json.dumps(names))):
                self.assertEqual(given.keys(), alone().keys())
                for output, expected in alone().items():
                    for name, tuples in expected.items():
                        with self.subTest(output, field=name, rank=rank, ranks=ranks):
                            found = given[output].get(name)
                            self.assertEqual(np.shape(found), np.shape(tuples))
                            # Sites of several ranks are in another order, and so are sums.
                            np.testing.assert_allclose(found, tuples, rtol=1e-12)

    def test_every_filter_has_some(self):
        """But those that give no figures."""
        without = {"SolidDensity", "UniformSeeds"}
        found = {output.split(",")[0] for output, fields in alone().items() if fields}
        self.assertEqual({filter_.name for filter_ in FILTERS} - found, without)


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVBATCH):
        print("Needs mpirun and pvbatch")
        sys.exit(SKIPPED)
    main()

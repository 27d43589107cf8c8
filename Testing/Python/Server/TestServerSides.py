# SPDX-License-Identifier: BSD-3-Clause
"""A client and a server, of which one or both have the plugin: all filters work, are shown, and come
back from a state, without a message."""
import os
import re
import sys
import tempfile
import unittest

from rt_filters import FILTERS
from rt_server import PVSERVER, run_client
from rt_testing import SKIPPED, main, need_display

CLIENT = os.path.join(os.path.dirname(__file__), "server_sides.py")
FORMER = os.path.join(os.path.dirname(__file__), "server_former.py")
# Without the filters' own warnings.
MESSAGES = re.compile("(?<!vtkCollectiveAlgorithm)(warning|error|cannot|could not)(?!: In vtkCollective)",
                      re.IGNORECASE)


class ServerSides(unittest.TestCase):
    def run_sides(self, sides, state):
        """What the client prints of filters."""
        printed, log = run_client(CLIENT, sides, state)
        for text in (printed, log):
            self.assertEqual([line for line in text.splitlines() if MESSAGES.search(line)], [], text)
        found = dict(re.findall(r"FILTER (\w+) (.*)", printed))
        self.assertEqual(set(found), {filter_.name for filter_ in FILTERS}, printed)
        for name, shown in found.items():
            self.assertIn("True", shown.split(), name)
        return found

    def test_sides(self):
        with tempfile.TemporaryDirectory() as folder:
            found = {}
            for sides in ("remote", "local,remote", "remote,local"):
                state = os.path.join(folder, sides + ".pvsm")
                found[sides] = self.run_sides(sides, state)
                others = "remote" if "local" in sides else "local,remote"
                with self.subTest(sides, opened=others):
                    self.assertEqual(self.run_sides(others, state), found[sides])
            self.assertEqual(found["remote"], found["local,remote"])
            self.assertEqual(found["remote"], found["remote,local"])

    def test_former_names(self):
        """Without the client's plugin nothing converts them: a warning names each that has a value."""
        printed, _ = run_client(FORMER)
        for now, former in (("NumberOfCoordinates", "Dimensions"), ("MinimumShare", "LeastShare"),
                            ("ResampleFactor", "Resample"), ("TrackParticles", "Chain"),
                            ("AdvectArrays", "CarryArrays")):
            self.assertIn("%s was called %s" % (now, former), printed)


if __name__ == "__main__":
    if not os.path.exists(PVSERVER):
        print("Needs pvserver")
        sys.exit(SKIPPED)
    need_display()
    main()

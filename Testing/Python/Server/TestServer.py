# SPDX-License-Identifier: BSD-3-Clause
"""A real client on a real server of one process: a filter that fails reports it
and has an empty output; the client goes on. Nothing may hang. The server draws a checkerboard."""
import os
import re
import sys
import unittest

from rt_filters import FILTERS
from rt_server import PVSERVER, run_client
from rt_testing import SKIPPED, main, need_display

CLIENT = os.path.join(os.path.dirname(__file__), "server_client.py")


class Server(unittest.TestCase):
    def test_failures(self):
        printed, log_text = run_client(CLIENT)
        shown = dict(re.findall(r"CHECK (\w+) (\[.*\])", printed))
        tested = [filter_ for filter_ in FILTERS if not filter_.gives_table]
        self.assertEqual(shown, dict.fromkeys(
            (filter_.name for filter_ in tested), str([False, True, False, False, True, False])),
            printed + log_text[-3000:])
        for filter_ in tested:
            self.assertIn("%s is %s" % filter_.refused[:2], log_text)
        self.assertNotIn("outside the whole extent", log_text)
        self.assertIn("CHECKERED True", printed)


if __name__ == "__main__":
    if not os.path.exists(PVSERVER):
        print("Needs pvserver")
        sys.exit(SKIPPED)
    need_display()
    main()

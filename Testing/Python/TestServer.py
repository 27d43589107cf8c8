# SPDX-License-Identifier: BSD-3-Clause
"""A real client on a real server of one process: an image filter that fails reports it
and has an empty output; the client goes on. Nothing may hang."""
import os
import re
import sys
import unittest

from rt_server import PVSERVER, run_client
from rt_testing import SKIPPED, main, need_display

CLIENT = os.path.join(os.path.dirname(__file__), "server_client.py")


class Server(unittest.TestCase):
    def test_failures(self):
        printed, log_text = run_client(CLIENT)
        names = ("splat", "solid", "cells", "map", "morph", "barycenter", "sampler")
        shown = dict(re.findall(r"CHECK (\w+) (\[.*\])", printed))
        self.assertEqual(shown, dict.fromkeys(
            names, str([False, True, False, False, True, False])), printed + log_text[-3000:])
        for text in ("Radius is 0", "Supersampling is 99", "NormExponent is 0", "Parameter is 2",
                     "ParticlesPerCell is 0", "NumberOfSteps is 0"):
            self.assertIn(text, log_text)
        self.assertNotIn("outside the whole extent", log_text)


if __name__ == "__main__":
    if not os.path.exists(PVSERVER):
        print("Needs pvserver")
        sys.exit(SKIPPED)
    need_display()
    main()

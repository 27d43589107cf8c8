# SPDX-License-Identifier: BSD-3-Clause
"""A real client on a real server of one process: an image filter that fails reports it
and has an empty output; the client goes on. Nothing may hang."""
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

from rt_testing import SKIPPED, main, need_display

PVPYTHON = os.environ["RT_PVPYTHON"]
PVSERVER = os.path.join(os.path.dirname(PVPYTHON), "pvserver")
CLIENT = os.path.join(os.path.dirname(__file__), "server_client.py")
LIMIT = 200  # seconds for the client; it takes four on an idle machine


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def read(path):
    with open(path, errors="replace") as file:
        return file.read()


class Server(unittest.TestCase):
    def run_client(self):
        """What the client prints, and what the server."""
        port = free_port()
        with tempfile.NamedTemporaryFile() as log:
            server = subprocess.Popen([PVSERVER, "--server-port=%d" % port], stdout=log,
                                      stderr=subprocess.STDOUT, start_new_session=True)
            try:
                for _ in range(300):
                    if "Waiting for client" in read(log.name) or server.poll() is not None:
                        break
                    time.sleep(0.1)
                client = subprocess.run([PVPYTHON, CLIENT, str(port)], stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, text=True, timeout=LIMIT)
            finally:
                try:
                    os.killpg(server.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
                server.wait()
            log_text = read(log.name)
        self.assertEqual(client.returncode, 0, client.stdout[-3000:])
        return client.stdout, log_text

    def test_failures(self):
        printed, log_text = self.run_client()
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

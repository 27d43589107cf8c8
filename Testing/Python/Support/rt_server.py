# SPDX-License-Identifier: BSD-3-Clause
"""Starts a pvserver, of several processes or of one, and runs a client against it."""
import contextlib
import glob
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PVPYTHON = os.environ["RT_PVPYTHON"]
PVSERVER = os.path.join(os.path.dirname(PVPYTHON), "pvserver")
MPIRUN = shutil.which("mpirun")
STARTED_WITHIN = 30  # seconds; an idle machine takes two
ENDED_WITHIN = 30  # after the client has left
# Each process writes a file of its own: in one they would cut each other's lines.
APART = 'exec "$@" > "$0.$$" 2>&1'


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def read(path):
    """What a server has printed to a file, and its processes to files that begin like it."""
    printed = ""
    for part in sorted(glob.glob(path + "*")):
        with open(part, errors="replace") as file:
            printed += file.read()
    return printed


def outside_mpi():
    """The environment without what MPI adds in pvpython: mpirun would refuse it."""
    return {name: value for name, value in os.environ.items()
            if not name.startswith(("OMPI_", "PMIX_"))}


class Server:
    """A pvserver that waits for its client at `port`."""

    def __init__(self, folder, processes, environment):
        self.port = free_port()
        self.log = os.path.join(folder, "log")
        command = [PVSERVER, "--server-port=%d" % self.port]
        if processes:
            command = [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(processes),
                       "bash", "-c", APART, self.log, *command]
        with open(self.log, "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT,
                                            start_new_session=True,
                                            env={**outside_mpi(), **(environment or {})})

    def printed(self):
        return read(self.log)

    def wait_until_ready(self):
        start = time.monotonic()
        while "Waiting for client" not in self.printed() and self.process.poll() is None and \
                time.monotonic() - start < STARTED_WITHIN:
            time.sleep(0.1)

    def kill(self):
        """It and all that it started."""
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()

    def end(self):
        """Waits until it has ended by itself; raises AssertionError where it has to be killed."""
        try:
            self.process.wait(ENDED_WITHIN)
        except subprocess.TimeoutExpired:
            self.kill()
            raise AssertionError("The server goes on without its client: "
                                 + self.printed()[-3000:]) from None
        self.kill()


@contextlib.contextmanager
def started(processes=None, environment=None):
    """A Server, of processes of mpirun or without it, which ends after its client; raises
    AssertionError where it does not."""
    with tempfile.TemporaryDirectory() as folder:
        server = Server(folder, processes, environment)
        try:
            server.wait_until_ready()
            yield server
        except BaseException:
            server.kill()
            raise
        server.end()


def run_client(script, *arguments, processes=None, limit=200):
    """Runs a client, a script of pvpython with the server's port and arguments. Returns what the
    client prints and what the server; raises AssertionError where the client fails."""
    with started(processes) as server:
        client = subprocess.run([PVPYTHON, script, str(server.port), *arguments],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                timeout=limit)
        if client.returncode != 0:
            raise AssertionError(client.stdout[-3000:] + server.printed()[-3000:])
        server.end()
        return client.stdout, server.printed()

# SPDX-License-Identifier: BSD-3-Clause
"""Starts a pvserver, of several processes or of one, and runs a client against it."""
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


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def read(path):
    with open(path, errors="replace") as file:
        return file.read()


def end(server):
    """Waits until a server and all it started have ended by themselves; kills what has not.
    Returns whether that was needed."""
    try:
        server.wait(ENDED_WITHIN)
        killed = False
    except subprocess.TimeoutExpired:
        killed = True
    try:
        os.killpg(server.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    server.wait()
    return killed


def run_client(script, *arguments, processes=None, limit=200):
    """Runs a client, a script of pvpython with the server's port and arguments. `processes` are
    those of mpirun, or None for a server without. Returns what the client prints and what the
    server; raises AssertionError where the client fails or the server does not end after it."""
    command = [PVSERVER]
    if processes:
        command = [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(processes),
                   *command]
    port = free_port()
    with tempfile.NamedTemporaryFile() as log:
        server = subprocess.Popen([*command, "--server-port=%d" % port], stdout=log,
                                  stderr=subprocess.STDOUT, start_new_session=True)
        try:
            start = time.monotonic()
            while "Waiting for client" not in read(log.name) and server.poll() is None and \
                    time.monotonic() - start < STARTED_WITHIN:
                time.sleep(0.1)
            client = subprocess.run([PVPYTHON, script, str(port), *arguments],
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                    timeout=limit)
        except BaseException:
            os.killpg(server.pid, signal.SIGKILL)
            server.wait()
            raise
        killed = end(server)
        printed = read(log.name)
    if client.returncode != 0:
        raise AssertionError(client.stdout[-3000:] + printed[-3000:])
    if killed:
        raise AssertionError("The server goes on without its client: " + printed[-3000:])
    return client.stdout, printed

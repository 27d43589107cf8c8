# SPDX-License-Identifier: BSD-3-Clause
"""Starts a pvserver, of several processes or of one, and runs a client against it."""
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
    port = free_port()
    with tempfile.TemporaryDirectory() as folder, \
            open(os.path.join(folder, "log"), "w", encoding="utf-8") as log:
        command = [PVSERVER, "--server-port=%d" % port]
        if processes:
            command = [MPIRUN, "--allow-run-as-root", "--oversubscribe", "-np", str(processes),
                       "bash", "-c", APART, log.name, *command]
        server = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT,
                                  start_new_session=True)
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

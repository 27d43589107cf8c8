# SPDX-License-Identifier: BSD-3-Clause
"""Scripts of ParaView that run in the process of a test: starting another one takes longer than most."""
import contextlib
import ctypes
import os
import runpy
import sys
import tempfile
import traceback
from unittest import mock

from rt_testing import paraview_simple

simple = paraview_simple()


def flush():
    """pvpython's sys.stdout writes into the buffer of C, which its own flush leaves as it is."""
    sys.stdout.flush()
    ctypes.CDLL(None).fflush(None)


@contextlib.contextmanager
def redirected(number, file):
    """What Python and C++ write to a descriptor of this process goes to a file."""
    flush()
    kept = os.dup(number)
    os.dup2(file.fileno(), number)
    try:
        yield
    finally:
        flush()
        os.dup2(kept, number)
        os.close(kept)
        file.seek(0)


def exit_code(path):
    """Of a script that runs in this process; what ends it is printed."""
    try:
        runpy.run_path(path, run_name="__main__")
    except SystemExit as stopped:
        if isinstance(stopped.code, str):
            print(stopped.code, file=sys.stderr)
            return 1
        return stopped.code or 0
    except Exception:
        traceback.print_exc()
        return 1
    return 0


def run_script(path, *arguments):
    """A script's output, its messages, and its exit code. ParaView's session is new afterwards."""
    with tempfile.TemporaryFile("w+") as printed, tempfile.TemporaryFile("w+") as messages:
        with mock.patch.object(sys, "argv", [path, *arguments]), redirected(1, printed), \
                redirected(2, messages):
            code = exit_code(path)
        simple.ResetSession()
        return printed.read(), messages.read(), code

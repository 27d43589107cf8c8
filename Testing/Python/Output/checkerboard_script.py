# SPDX-License-Identifier: BSD-3-Clause
"""Opens a state or runs a script of ParaView; ends with an error unless its view shows the checkerboard."""
import os
import sys

from rt_checkerboard import RECTANGLE, is_checkered, look_at, picture, tones
from rt_testing import load_plugin

simple = load_plugin()
path = sys.argv[1]
if path.endswith(".pvsm"):
    simple.LoadState(path)
else:
    with open(path, encoding="utf-8") as file:
        exec(file.read(), {})
view = simple.GetActiveView()
look_at(view, RECTANGLE)  # a trace has no camera
found = tones(picture(simple, view, "first-opened.png"), view, RECTANGLE)
print(f"{path}: from {found.min()} to {found.max()}", flush=True)
os._exit(0 if is_checkered(found) else 1)  # past the interpreter's end ParaView's textures may crash

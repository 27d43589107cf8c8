# SPDX-License-Identifier: BSD-3-Clause
"""What TestServerSides.py runs as a client without the plugin: it opens a state of before properties were
renamed."""
import os
import sys

from paraview import simple
from rt_testing import OUTPUT, SOURCE

simple.Connect("localhost", int(sys.argv[1]))
simple.LoadPlugin(os.environ["RT_PLUGIN"], remote=True, ns=vars(simple))
with open(os.path.join(SOURCE, "Testing", "Data", "before-renames.pvsm"), encoding="utf-8") as file:
    state = file.read().replace("@SOURCE@", SOURCE)
path = os.path.join(OUTPUT, "server-former.pvsm")
with open(path, "w", encoding="utf-8") as file:
    file.write(state)
simple.LoadState(path)
for name in "Tracked", "Distances", "Regions":
    simple.FindSource(name).UpdatePipeline()
simple.Disconnect()

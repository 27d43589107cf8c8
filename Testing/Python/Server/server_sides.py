# SPDX-License-Identifier: BSD-3-Clause
"""What TestServerSides.py runs as the client of a server, with the port, the sides that load the
plugin, in their order, and a state file: it is loaded if it is there, else made of all filters."""
import os
import sys

from paraview import simple
from rt_filters import FILTERS
from rt_testing import SOURCE
from server_filters import made_filters

port, sides, state = sys.argv[1:]
simple.Connect("localhost", int(port))
for side in sides.split(","):
    simple.LoadPlugin(os.environ["RT_PLUGIN"], remote=side == "remote", ns=vars(simple))


def outputs(source):
    return [simple.OutputPort(source, i) for i in range(source.SMProxy.GetNumberOfOutputPorts())]


def size(output):
    information = output.GetDataInformation().DataInformation
    return max(information.GetNumberOfPoints(), information.GetNumberOfRows())


if os.path.exists(state):
    simple.LoadState(state)
else:
    view = simple.CreateView("RenderView", ViewSize=[64, 64])
    for filter_, made in made_filters(simple):
        made.UpdatePipeline()
        for output in outputs(made) if not filter_.gives_table else []:
            simple.Show(output, view)
    simple.Render(view)
    photograph = simple.PNGSeriesReader(FileNames=[
        os.path.join(SOURCE, "Testing", "Data", "ascent.png")])
    dots = simple.SampleDensity(photograph, DensityArray=["POINTS", "PNGImage"], Component=0)
    print("ARRAY", *dots.DensityArray)
    simple.SaveState(state)
for filter_ in FILTERS:
    source = simple.FindSource(filter_.label)
    source.UpdatePipeline()
    print("FILTER", filter_.name, *(size(output) > 0 for output in outputs(source)))
simple.Render()
simple.Disconnect()

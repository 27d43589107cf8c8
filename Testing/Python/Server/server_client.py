# SPDX-License-Identifier: BSD-3-Clause
"""What TestServer.py runs as the client of a server: filters that fail, before they were ever
shown and after, with filters downstream, and are corrected."""
import os
import sys

from paraview import simple
from rt_checkerboard import RECTANGLE, is_checkered, look_at, parameterized, picture, tones
from server_filters import made_filters

simple.Connect("localhost", int(sys.argv[1]))
for remote in (True, False):
    simple.LoadPlugin(os.environ["RT_PLUGIN"], remote=remote, ns=vars(simple))
view = simple.CreateView("RenderView", ViewSize=[64, 64])


def points_shown(proxy):
    simple.Render(view)
    return proxy.GetDataInformation().GetNumberOfPoints()


def check(name, proxy, prop, wrong, right):
    """From the start wrong, then right, then wrong again with a filter downstream."""
    setattr(proxy, prop, wrong)
    simple.Show(proxy, view)
    counts = [points_shown(proxy)]
    setattr(proxy, prop, right)
    counts.append(points_shown(proxy))
    setattr(proxy, prop, wrong)
    counts.append(points_shown(proxy))
    downstream = simple.Contour(Input=proxy)
    simple.Show(downstream, view)
    counts.append(points_shown(downstream))
    setattr(proxy, prop, right)
    counts.append(points_shown(proxy))
    simple.Delete(downstream)
    setattr(proxy, prop, wrong)
    counts.append(points_shown(proxy))
    simple.Hide(proxy, view)
    print("CHECK", name, [count > 0 for count in counts], flush=True)


for filter_, made in made_filters(simple):
    if not filter_.gives_table:  # which no view of pictures shows
        check(filter_.name, made, *filter_.refused)
view = simple.CreateView("RenderView")
view.RemoteRenderThreshold = 0  # the server draws
simple.Show(parameterized(simple), view)
look_at(view, RECTANGLE)
pixels = picture(simple, view, "server-checkerboard.png")
print("CHECKERED", is_checkered(tones(pixels, view, RECTANGLE)))
simple.Disconnect()

# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvpython or pvbatch where the package is installed: ParaView has loaded the plugin by itself.
The first argument is a photograph. A port as the second one: the pvserver there, too. A path: python3,
where the plugin has to be loaded."""
import sys

from paraview.simple import *

from rt_filters import FILTERS

photograph, others = sys.argv[1], sys.argv[2:]
if others and others[0].isdigit():
    Connect("localhost", int(others[0]))
elif others:
    assert "SampleDensity" not in globals(), "python3 needs no LoadPlugin any more: say so in README.Debian"
    LoadPlugin(others[0], remote=False, ns=globals())

for name in [filter_.name for filter_ in FILTERS]:
    assert name in globals(), f"{name} is not there: the plugin is not loaded"

image = PNGSeriesReader(FileNames=[photograph])
dots = SampleDensity(image, DensityArray=["POINTS", "PNGImage"], InvertDensity=1, NumberOfParticles=2000)
points = servermanager.Fetch(dots)
assert points.GetNumberOfPoints() == 2000, points.GetNumberOfPoints()


def mean_of(array):
    count = array.GetNumberOfTuples()
    return sum(array.GetComponent(i, 0) for i in range(0, count)) / count


# Dots gather in what is dark: they carry the photograph's own values there.
everywhere = mean_of(servermanager.Fetch(image).GetPointData().GetArray("PNGImage"))
at_dots = mean_of(points.GetPointData().GetArray("PNGImage"))
assert at_dots < .9 * everywhere, (at_dots, everywhere)
print("2000 dots, mean brightness", round(at_dots, 1), "against", round(everywhere, 1))

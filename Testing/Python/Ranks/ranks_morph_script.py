# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksMorph.py runs on one rank or several: what is behind the ports of Morph Densities, as
files, and how often the filter runs. The first rank writes the numbers."""
import json
import os
import sys

from paraview import servermanager, simple
from rt_testing import load_plugin
from vtkmodules.vtkParallelCore import vtkMultiProcessController

RANK = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
WHOLE = [-4, 8, 0, 7, 0, 10]
FOLDER = sys.argv[1]
numbers = {}


def input_pair():
    pair = simple.Wavelet(WholeExtent=WHOLE), simple.Wavelet(
        WholeExtent=WHOLE, StandardDeviation=0.2, Center=[4, 1, 2])
    for wavelet in pair:  # a filter that did not know their array would run again with it
        wavelet.UpdatePipeline()
    return pair


class Counted:
    """A proxy, how often it has run since the last question, and whether it made tables."""

    def __init__(self, proxy):
        self.proxy = proxy
        self.runs = 0
        self.built = 0
        proxy.GetClientSideObject().AddObserver("StartEvent", self.count)

    def count(self, _caller, _event):
        self.runs += 1

    def note(self, name):
        built = self.proxy.GetClientSideObject().GetTableBuildTime()
        numbers[name] = [self.runs, built > self.built]
        self.runs, self.built = 0, built


def morph():
    return simple.MorphDensities(**dict(zip(("Input", "Target"), input_pair())),
                                 NegativeValues="Clamp", NumberOfSteps=8)


def particles(proxy):
    return servermanager.OutputPort(proxy, 1)


def behind_particles(proxy):
    return simple.Threshold(Input=particles(proxy), Scalars=["POINTS", "SourcePosition"],
                            LowerThreshold=1, UpperThreshold=1000)


def save(name, proxy):
    simple.SaveData(os.path.join(FOLDER, name), proxy=proxy, DataMode="Binary")


def give_runs():
    """Requests of one port, then of the other; and changes that keep the maps."""
    counted = Counted(morph())
    behind_particles(counted.proxy).UpdatePipeline()
    counted.note("particles first")
    save("again.pvti", counted.proxy)
    counted.note("density then")
    counted = Counted(morph())
    save("again.pvti", counted.proxy)
    counted.note("density first")
    behind_particles(counted.proxy).UpdatePipeline()
    counted.note("particles then")
    counted.proxy.Parameter = 0.25
    counted.proxy.UpdatePipeline()
    counted.note("parameter")
    counted.proxy.MassMode = "Normalize"
    counted.proxy.UpdatePipeline()
    counted.note("mass")
    counted.proxy.NumberOfSteps = 9
    counted.proxy.UpdatePipeline()
    counted.note("steps")
    counted = Counted(morph())
    counted.proxy.PublishTime = 1
    for time in (0.0, 0.5, 1.0):
        counted.proxy.UpdatePipeline(time)
        counted.note("time %.1f" % time)
    counted = Counted(simple.DensityBarycenter(Input=[*input_pair(), simple.Wavelet(
        WholeExtent=WHOLE, XFreq=20)], NegativeValues="Clamp", NumberOfSteps=8))
    for weights in ([1, 1, 1], [3, 0, 1], [0, 0, 2]):
        counted.proxy.Weights = weights
        counted.proxy.UpdatePipeline()
        counted.note("weights %d%d%d" % tuple(weights))


def slice_of(proxy):
    sliced = simple.Slice(Input=proxy)
    sliced.SliceType.Origin = [1.5, 3.5, 5.0]  # in symmetric mode the default is another one
    return sliced


def give_files():
    proxy = morph()
    save("density.pvti", proxy)
    save("particles.pvtp", particles(proxy))
    save("contour.pvtp", simple.Contour(Input=proxy, ContourBy=["POINTS", "RTData"],
                                        Isosurfaces=[120.0], ComputeNormals=0))
    save("slice.pvtp", slice_of(proxy))
    save("threshold.pvtu", behind_particles(proxy))
    return proxy


def give_picture(proxy):
    view = simple.CreateView("RenderView")
    view.ViewSize = [200, 200]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    for shown, kind in ((slice_of(proxy), "Surface"), (particles(proxy), "Points"),
                        (proxy, "Outline")):
        simple.Show(shown, view).Representation = kind
    counted = Counted(proxy)
    for parameter in (0.2, 0.8):
        proxy.Parameter = parameter
        simple.Render(view)
    numbers["pictures"] = counted.runs
    view.ResetCamera()
    simple.SaveScreenshot(os.path.join(FOLDER, "view.png"), view, ImageResolution=[200, 200])


load_plugin()
give_runs()
shown = give_files()
if len(sys.argv) < 3:
    give_picture(shown)
if RANK == 0:
    with open(os.path.join(FOLDER, "numbers.json"), "w", encoding="utf-8") as file:
        json.dump(numbers, file)
print("WROTE", RANK, flush=True)

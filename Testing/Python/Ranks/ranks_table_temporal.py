# SPDX-License-Identifier: BSD-3-Clause
"""Rows of TestRanksTable.py: a series between its steps."""
from paraview import simple
from ranks_rows import give_both, with_ghosts

TIMES = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
information = self.GetOutputInformation(0)
information.Set(Pipeline.TIME_STEPS(), [0.0, 1.0, 2.0], 3)
information.Set(Pipeline.TIME_RANGE(), [0.0, 2.0], 2)
"""
STEP = """
import numpy as np
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
information = self.GetOutputInformation(0)
time = information.Get(Pipeline.UPDATE_TIME_STEP()) if information.Has(Pipeline.UPDATE_TIME_STEP()) else 0
image = inputs[0].VTKObject
points = np.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())]).reshape(-1, 3)
squared = ((points - [2 + 2 * time, 3, 4 + time]) ** 2).sum(1)
output.PointData.append(np.where(squared < 20, np.exp(-squared / 6) * (1 + time), 0), "smoke")
output.PointData.append(points[:, 0] * time, "other")
output.PointData.append((2.0 ** 62 + points[:, 0] * 4096 + 1024 * time).astype(np.int64), "label")
"""
# The second step has smaller cells.
FINER = STEP + """
output.VTKObject.SetSpacing([0.5 if time == 1 else 1.0] * 3)
"""


def series(image, script=STEP):
    simple.SetActiveSource(None)
    return simple.ProgrammableFilter(Input=image, RequestInformationScript=TIMES, Script=script,
                                     CopyArrays=0)


def give_rows(_inputs):
    """Both methods and chains, of points and cells, in a volume and a plane, at and between steps."""
    whole = [-4, 8, 0, 7, 0, 10]
    image = simple.Wavelet(WholeExtent=whole)
    moving = series(image)
    cells = simple.PointDatatoCellData(Input=moving, ProcessAllArrays=1)
    flat = series(simple.ExtractSubset(Input=image, VOI=[-4, 8, 3, 3, 0, 10]))
    inputs = {"points": (moving, "POINTS"), "cells": (cells, "CELLS"), "flat": (flat, "POINTS"),
              "wider": (series(with_ghosts(image, 2)), "POINTS"), "finer": (series(image, FINER), "POINTS")}
    choices = [dict(), dict(TrackParticles=1), dict(Method="RectifiedFlow"), dict(Kernel="Gaussian", ParticlesPerCell=2)]
    for name, (source, owner) in inputs.items():
        for choice in choices if name == "points" else choices[:2]:
            simple.SetActiveSource(None)
            between = simple.TransportTemporalInterpolator(
                Input=source, DensityArray=[owner, "smoke"], **choice)
            for time in (0.3, 1.0):
                between.UpdatePipeline(time)
                give_both("temporal %s %s %.1f" % (name, " ".join(map(str, choice.values())), time), between)

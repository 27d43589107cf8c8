# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksServer.py runs as the client of a server of several processes: it writes what it is
told of the outputs, pictures of them, and what comes of files that the server wrote."""
import json
import os
import sys

from paraview import simple

PORT, FOLDER = int(sys.argv[1]), sys.argv[2]
WRONG_STEPS = ("-1", "-5", "99999")  # each once, so that its messages can be told apart

simple.Connect("localhost", PORT)
for remote in (True, False):
    simple.LoadPlugin(os.environ["RT_PLUGIN"], remote=remote, ns=vars(simple))
facts = {}


def told(proxy):
    """What a client knows of an output without having it."""
    proxy.UpdatePipeline()
    data = proxy.GetDataInformation()
    ranges = {}
    for owner in (proxy.PointData, proxy.CellData, proxy.FieldData):
        for i in range(owner.GetNumberOfArrays()):
            array = owner.GetArray(i)
            if array.GetName() != "vtkGhostType":
                ranges[array.GetName()] = [array.GetRange(k) for k in
                                           range(-1, array.GetNumberOfComponents())]
    # Points at common faces of the pieces of images and surfaces are counted by each.
    apart = data.GetNumberOfCells() == data.GetNumberOfPoints()
    return {"points": data.GetNumberOfPoints() if apart else None,
            "cells": data.GetNumberOfCells(), "bounds": data.GetBounds(),
            "ranges": ranges, "kind": data.GetDataSetTypeAsString(),
            "extent": data.GetExtent() if data.GetDataSetTypeAsString() == "vtkImageData" else None}


def draw(name, proxies):
    view = simple.CreateView("RenderView", ViewSize=[240, 240])
    view.OrientationAxesVisibility = 0
    view.RemoteRenderThreshold = 0  # the server draws
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    for proxy, kind, array in proxies:
        shown = simple.Show(proxy, view)
        shown.SetRepresentationType(kind)
        simple.ColorBy(shown, array)
        shown.SetScalarBarVisibility(view, False)
        if kind == "Point Gaussian":
            shown.GaussianRadius = 0.3
    view.CameraPosition, view.CameraFocalPoint = [35, 25, 50], [0, 0, 0]
    view.CameraParallelProjection, view.CameraParallelScale = 1, 17
    simple.SaveScreenshot(os.path.join(FOLDER, name + ".png"), view, ImageResolution=[240, 240])
    simple.Delete(view)


def failing(proxy):
    """The points while a property is wrong, and those after it is corrected, several times."""
    counts = []
    for steps in WRONG_STEPS:
        for value in (int(steps), 8):
            proxy.NumberOfSteps = value
            proxy.UpdatePipeline()
            counts.append(proxy.GetDataInformation().GetNumberOfPoints())
    return counts


def saved(name, proxy, reader, **options):
    path = os.path.join(FOLDER, name)
    simple.SaveData(path, proxy=proxy, DataMode="Binary", **options)
    return told(reader(FileName=[path]))


image = simple.Wavelet(WholeExtent=[-10, 10] * 3)
usual = dict(NegativeValues="Clamp", NumberOfSteps=8)
particles = simple.SampleDensity(Input=image, NumberOfParticles=3000, **usual)
field = simple.TransportMap(Input=image, **usual)
shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[160.0],
                       ComputeNormals=0)
warped = simple.DensityEqualizingWarp(Input=shell, Density=image, **usual)
behind = simple.Threshold(Input=particles, Scalars=["POINTS", "SeedId"], LowerThreshold=100,
                          UpperThreshold=999)
for name, proxy in (("particles", particles), ("map", field), ("warp", warped),
                    ("threshold", behind)):
    facts[name] = told(proxy)
draw("picture", [(particles, "Point Gaussian", ("POINTS", "RTData")),
                 (warped, "Surface", ("POINTS", "Displacement", "Magnitude"))])
facts["saved particles"] = saved("particles.pvtp", particles, simple.XMLPartitionedPolydataReader)
facts["saved map"] = saved("map.pvti", field, simple.XMLPartitionedImageDataReader)
for name, proxy in (("particles", particles), ("map", field), ("warp", warped)):
    facts["failing " + name] = failing(proxy)
facts["afterwards"] = told(particles)
with open(os.path.join(FOLDER, "facts.json"), "w", encoding="utf-8") as file:
    json.dump(facts, file)
simple.Disconnect()

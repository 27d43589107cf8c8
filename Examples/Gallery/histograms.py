# SPDX-License-Identifier: BSD-3-Clause
"""The histograms of a photograph's red, green and blue as densities on a line, and how far apart they
are."""
from paraview.servermanager import Fetch
from paraview.simple import *

COLOURS = {"red": [0.8, 0.1, 0.1], "green": [0.1, 0.6, 0.1], "blue": [0.1, 0.2, 0.8]}

photo = PNGSeriesReader(registrationName="Photograph", FileNames=["Testing/Data/raccoon.png"])
pixels = ImageDatatoPointSet(photo, registrationName="Pixels")
bins = Wavelet(registrationName="Bins", WholeExtent=[0, 255, 0, 0, 0, 0])
histograms = []
for name, axis in zip(COLOURS, "XYZ"):
    line = Calculator(pixels, registrationName="Values of " + name, CoordinateResults=1)
    line.Function = "PNGImage_%s*iHat" % axis
    histograms.append(SplatMass(line, registrationName=name, Reference=bins, Kernel="NearestCell"))
distances = TransportDistance(registrationName="Distances", Input=histograms, Method="Certified")
matrix = Fetch(distances)

layout = GetLayout(GetActiveView())
Delete(GetActiveView())
view = CreateView("XYChartView", registrationName="View", ViewSize=[600, 450])
AssignViewToLayout(view, layout)
for histogram, (name, colour) in zip(histograms, COLOURS.items()):
    curve = PlotData(histogram, registrationName="Curve of " + name)
    shown = Show(curve, view)
    shown.UseIndexForXAxis = 1
    shown.SeriesLabel = ["Density", name]
    shown.SeriesColor = ["Density", *map(str, colour)]
    shown.SeriesLineThickness = ["Density", "3"]
view.ChartTitle = "Distances: " + ", ".join(
    "%s and %s %.1f" % (first, second, matrix.GetValueByName(row, second).ToDouble())
    for row, first, second in ((0, "red", "green"), (0, "red", "blue"), (1, "green", "blue")))
view.ChartTitleFontSize = 11
view.BottomAxisTitle = "value"
view.BottomAxisUseCustomRange = 1
view.BottomAxisRangeMaximum = 255
view.LeftAxisTitle = "pixels"

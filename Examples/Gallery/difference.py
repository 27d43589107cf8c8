# SPDX-License-Identifier: BSD-3-Clause
"""Where the smoke of a calm run has to go to be that of a windy one: arrows, and their cost as a glow."""
from paraview.simple import *

runs = [XMLImageDataReader(registrationName=name, FileName=["Examples/Tutorial/%s.vti" % name])
        for name in ("plume-1", "plume-wind")]
transport = TransportMap(runs[0], registrationName="Differences", Target=runs[1])
smoke = Threshold(Input=transport, Scalars=["POINTS", "Smoke"], UpperThreshold=40,
                  ThresholdMethod="Above Upper Threshold")
arrows = Glyph(Input=smoke, GlyphType="Arrow", GlyphMode="Every Nth Point", Stride=23)
arrows.OrientationArray = ["POINTS", "Displacement"]
arrows.ScaleArray = ["POINTS", "Displacement"]
arrows.ScaleFactor = 1
arrows.GlyphType.TipRadius = 0.05
arrows.GlyphType.TipLength = 0.15
arrows.GlyphType.ShaftRadius = 0.015

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.01, 0.01, 0.03]
shown = Show(transport, view)
shown.SetRepresentationType("Volume")
ColorBy(shown, ("POINTS", "CostDensity"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("CostDensity")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.5, 0.1, 0.0, 4e-5, 1, 0.5, 0.1, 1.2e-4, 1, 1, 0.8]
GetOpacityTransferFunction("CostDensity").Points = [0, 0, 0.5, 0, 1e-5, 0.1, 0.5, 0, 1.2e-4, 0.9, 0.5, 0]
shown.ScalarOpacityUnitDistance = 0.4
shown = Show(arrows, view)
ColorBy(shown, None)
shown.AmbientColor = shown.DiffuseColor = [0.55, 0.8, 1.0]

view.CameraFocalPoint = [2.1, 2, 4.4]
view.CameraPosition = [2, -8, 5.6]
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = 17

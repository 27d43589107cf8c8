# SPDX-License-Identifier: BSD-3-Clause
"""Smoke half way between two moments of a simulation, as a volume."""
from paraview.simple import *

moments = [XMLImageDataReader(registrationName=name, FileName=["Examples/Tutorial/%s.vti" % name])
           for name in ("plume-0", "plume-1")]
morph = MorphDensities(moments[0], registrationName="Between", Target=moments[1])
morph.Parameter = 0.5

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.01, 0.01, 0.03]
shown = Show(morph, view)
shown.SetRepresentationType("Volume")
ColorBy(shown, ("POINTS", "Smoke"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("Smoke")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.1, 0.2, 0.5, 60, 0.4, 0.6, 0.9, 200, 1, 1, 1]
GetOpacityTransferFunction("Smoke").Points = [0, 0, 0.5, 0, 15, 0.2, 0.5, 0, 200, 0.8, 0.5, 0]
shown.ScalarOpacityUnitDistance = 0.5

view.CameraFocalPoint = [2, 2, 3.3]
view.CameraPosition = [2, -8, 4.6]
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = 17

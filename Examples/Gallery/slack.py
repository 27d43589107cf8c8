# SPDX-License-Identifier: BSD-3-Clause
"""A photograph's light in dots, from blue where the flow's map is optimal to yellow where it is not."""
from paraview.simple import *

photo = PNGSeriesReader(registrationName="Photo", FileNames=["Testing/Data/raccoon.png"])
dots = SampleDensity(photo, registrationName="Dots")
dots.NumberOfParticles = 20000
dots.Certify = 1

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 0]
shown = Show(dots, view)
ColorBy(shown, ("POINTS", "Slack"))
shown.SetScalarBarVisibility(view, False)
shown.GaussianRadius = 2.4
colours = GetColorTransferFunction("Slack")
colours.ColorSpace = "RGB"
colours.UseLogScale = 1
colours.RGBPoints = [1, 0.1, 0.2, 0.6, 10, 0.5, 0.15, 0.6, 60, 0.95, 0.35, 0.3, 300, 1, 0.9, 0.3]

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [511.5, 383.5, 0]
view.CameraPosition = [511.5, 383.5, 1000]
view.CameraParallelScale = 384

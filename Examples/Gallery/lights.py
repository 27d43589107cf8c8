# SPDX-License-Identifier: BSD-3-Clause
"""The lights of Europe at night as 25,000 dots."""
from paraview.simple import *

night = PNGSeriesReader(registrationName="Night", FileNames=["Testing/Data/night-europe.png"])
dots = SampleDensity(night, registrationName="Dots")
dots.NumberOfParticles = 25000

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.02, 0.03, 0.08]
shown = Show(dots, view)
shown.GaussianRadius = 0.45
shown.ShaderPreset = "Gaussian Blur"
ColorBy(shown, ("POINTS", "PNGImage"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("PNGImage")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.7, 0.35, 0.1, 90, 1, 0.75, 0.3, 255, 1, 1, 0.9]

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [130, 91, 0]
view.CameraPosition = [130, 91, 1000]
view.CameraParallelScale = 91

# SPDX-License-Identifier: BSD-3-Clause
"""A photograph in dots of its colours on black, more of them where it is bright."""
from paraview.simple import *

photo = PNGSeriesReader(registrationName="Photo", FileNames=["Testing/Data/raccoon.png"])
dots = SampleDensity(photo, registrationName="Dots")
dots.NumberOfParticles = 30000

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 0]
shown = Show(dots, view)
ColorBy(shown, ("POINTS", "PNGImage"))
shown.MapScalars = 0  # the array holds colours
shown.SetScalarBarVisibility(view, False)
shown.GaussianRadius = 2.6

# The face.
view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [640, 440, 0]
view.CameraPosition = [640, 440, 1000]
view.CameraParallelScale = 250

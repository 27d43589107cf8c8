# SPDX-License-Identifier: BSD-3-Clause
"""A photograph in 20,000 dots."""
from paraview.simple import *

photo = PNGSeriesReader(registrationName="Photo", FileNames=["Testing/Data/raccoon.png"])
dots = SampleDensity(photo, registrationName="Dots")
dots.InvertDensity = 1  # dark ink is mass
dots.NumberOfParticles = 20000

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
shown = Show(dots, view)
shown.ColorArrayName = [None, ""]
shown.AmbientColor = shown.DiffuseColor = [0, 0, 0]
shown.GaussianRadius = 2.2

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [511.5, 383.5, 0]
view.CameraPosition = [511.5, 383.5, 1000]
view.CameraParallelScale = 384

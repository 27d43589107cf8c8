# SPDX-License-Identifier: BSD-3-Clause
"""A photograph in 20,000 dots of three pens: black where it is dark, brown, and ochre where it is light."""
from paraview.simple import *

photo = PNGSeriesReader(registrationName="Photo", FileNames=["Testing/Data/raccoon.png"])
dots = SampleDensity(photo, registrationName="Dots", InvertDensity=1, NumberOfParticles=20000)
pens = Calculator(dots, registrationName="Pens", ResultArrayName="Pen",
                  Function="3 - min(2, floor((PNGImage_X + PNGImage_Y + PNGImage_Z) / 180))")

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
shown = Show(pens, view)
shown.SetRepresentationType("Point Gaussian")
shown.ShaderPreset = "Plain circle"
shown.GaussianRadius = 2.3
ColorBy(shown, ("POINTS", "Pen"))
shown.SetScalarBarVisibility(view, False)
table = GetColorTransferFunction("Pen")
table.InterpretValuesAsCategories = 1
table.Annotations = ["1", "Ochre", "2", "Brown", "3", "Black"]
table.IndexedColors = [0.85, 0.55, 0.2, 0.5, 0.25, 0.1, 0.1, 0.1, 0.15]

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [511.5, 383.5, 0]
view.CameraPosition = [511.5, 383.5, 1000]
view.CameraParallelScale = 384

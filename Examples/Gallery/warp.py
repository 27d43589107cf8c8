# SPDX-License-Identifier: BSD-3-Clause
"""A map of Europe whose cells grow with their light at night."""
from paraview.simple import *

night = PNGSeriesReader(registrationName="Night", FileNames=["Testing/Data/night-europe.png"])
dots = SampleDensity(night, registrationName="Dots", NumberOfParticles=30000)
glow = SplatMass(dots, registrationName="Glow", Kernel="Gaussian")
glow.Dimensions = [114, 61, 1]
light = Calculator(glow, registrationName="Light", ResultArrayName="Light")
light.Function = "Density+1"  # the sea keeps some room
cells = ExtractSurface(light, registrationName="Cells")
warped = DensityEqualizingWarp(cells, registrationName="Warped", Density=light)
warped.DensityArray = ["POINTS", "Light"]

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 0]
shown = Show(warped, view)
shown.SetRepresentationType("Surface With Edges")
ColorBy(shown, ("POINTS", "Light"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("Light")
colours.ColorSpace = "RGB"
colours.RGBPoints = [1, 0, 0, 0.1, 1.5, 0.1, 0.3, 0.45, 2.5, 0.4, 0.75, 0.5, 4.5, 1, 1, 0.8]
shown.Ambient, shown.Diffuse = 1, 0
shown.EdgeColor = [0.4, 0.35, 0.55]

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [135, 91, 0]
view.CameraPosition = [135, 91, 1000]
view.CameraParallelScale = 89

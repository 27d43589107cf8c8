# SPDX-License-Identifier: BSD-3-Clause
"""Europe as large as its light at night: cells of a map that grow until the light is even."""
from paraview.simple import *

night = PNGSeriesReader(registrationName="Night", FileNames=["Testing/Data/night-europe.png"])
dots = SampleDensity(night, registrationName="Dots", NumberOfParticles=30000)
glow = SplatMass(dots, registrationName="Glow", Kernel="Gaussian")
glow.Dimensions = [114, 61, 1]
light = Calculator(glow, registrationName="Light", ResultArrayName="Light")
light.Function = "Density+8"
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
GetColorTransferFunction("Light").ApplyPreset("Inferno (matplotlib)", True)
shown.Ambient, shown.Diffuse = 1, 0
shown.EdgeColor = [0.25, 0.2, 0.35]

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [130, 91, 0]
view.CameraPosition = [130, 91, 1000]
view.CameraParallelScale = 91

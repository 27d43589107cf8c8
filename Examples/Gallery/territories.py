# SPDX-License-Identifier: BSD-3-Clause
"""Europe divided into 120 territories of equal light at night; the dark sea is nobody's."""
from paraview.simple import *

night = PNGSeriesReader(registrationName="Night", FileNames=["Testing/Data/night-europe.png"])
light = Calculator(night, registrationName="Light", ResultArrayName="Light")
light.Function = "max(PNGImage-4,0)"  # the sea is dark
dots = SampleDensity(light, registrationName="Dots", NumberOfParticles=200000)
dots.DensityArray = ["POINTS", "Light"]
glow = SplatMass(dots, registrationName="Glow", Kernel="TriangularShapedCloud")
glow.Dimensions = [171, 91, 1]
sites = SampleDensity(glow, registrationName="Sites", NumberOfParticles=120)
lands = EqualMassCells(sites, registrationName="Territories", Domain=glow)
lands.Measure = "Density"
lands.Shape = "Power"
lands.Resolution = 855
lights = SampleDensity(light, registrationName="Lights", NumberOfParticles=12000)
lights.DensityArray = ["POINTS", "Light"]

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.05, 0.07, 0.12]
shown = Show(OutputPort(lands, 0), view)
borders = Show(OutputPort(lands, 2), view)
borders.AmbientColor = borders.DiffuseColor = [0.05, 0.07, 0.12]
borders.LineWidth = 2
above = Transform(lights, registrationName="Above", Transform="Transform")
above.Transform.Translate = [0, 0, 1]
specks = Show(above, view)
specks.ColorArrayName = [None, ""]
specks.AmbientColor = specks.DiffuseColor = [1, 0.97, 0.85]
specks.GaussianRadius = 0.2

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [130, 91, 0]
view.CameraPosition = [130, 91, 1000]
view.CameraParallelScale = 91

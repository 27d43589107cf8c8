# SPDX-License-Identifier: BSD-3-Clause
"""A dot-density map of the United States: one dot for 100,000 people."""
from paraview.simple import *

states = GDALVectorReader(registrationName="States", FileName="Testing/Data/us-states.geojson")
# Where Blend is 0 nothing moves, and MassPerArea is added: people per square kilometre.
people = Cartogram(states, registrationName="People", MassArray=["CELLS", "mass"], Blend=0)
dots = SampleDensity(people, registrationName="Dots", NumberOfParticles=3293)
dots.DensityArray = ["CELLS", "MassPerArea"]
dots.DensityResolution = 1024
even = RelaxBlueNoise(dots, registrationName="Even", Density=people)
even.DensityArray = ["CELLS", "MassPerArea"]
even.DensityResolution = 1024

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
borders = Show(states, view)
borders.ColorArrayName = [None, ""]
borders.AmbientColor = borders.DiffuseColor = [0.6, 0.6, 0.6]
shown = Show(even, view)
shown.SetRepresentationType("Point Gaussian")
shown.ShaderPreset = "Plain circle"
shown.ColorArrayName = [None, ""]
shown.AmbientColor = shown.DiffuseColor = [0.65, 0.1, 0.15]
shown.GaussianRadius = 7.5

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [-50, 50, 0]
view.CameraPosition = [-50, 50, 10000]
view.CameraParallelScale = 1800

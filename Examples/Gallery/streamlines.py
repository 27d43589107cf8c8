# SPDX-License-Identifier: BSD-3-Clause
"""Streamlines of a vortex ring, as many in every part as its share of the speed."""
from paraview.simple import *

box = Wavelet(registrationName="Box", WholeExtent=[-40, 40, -40, 40, -30, 30])
radius = "sqrt(coordsX^2+coordsY^2)"
ring = Calculator(box, registrationName="Ring", ResultArrayName="Velocity")
ring.Function = ("exp(-((%s-18)^2+coordsZ^2)/60)*(coordsZ*coordsX/30*iHat+coordsZ*coordsY/30*jHat"
                 "+(2-%s*(%s-18)/30)*kHat)" % (radius, radius, radius))
seeds = SampleDensity(ring, registrationName="Seeds", NumberOfParticles=300)
seeds.DensityArray = ["POINTS", "Velocity"]
lines = StreamTracerWithCustomSource(registrationName="Lines", Input=ring, SeedSource=seeds)
lines.Vectors = ["POINTS", "Velocity"]
lines.MaximumStreamlineLength = 30
tubes = Tube(lines, registrationName="Tubes", Radius=0.25)

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.02, 0.02, 0.04]
shown = Show(tubes, view)
ColorBy(shown, ("POINTS", "Velocity", "Magnitude"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("Velocity")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.15, 0.35, 0.9, 1.5, 0.2, 0.8, 0.8, 4, 1, 0.9, 0.4]

view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = [0, -160, 130]
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = 20

# SPDX-License-Identifier: BSD-3-Clause
"""A cow with 40,000 hairs: a thin cone at each dot, along the normal and a little to the back."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
# No hair on the horns.
bare = Calculator(cow, registrationName="Bare", ResultArrayName="Hair")
bare.Function = "if((coordsY>0.79)&(abs(coordsX)<0.3),0,1)"
dots = SampleSurface(bare, registrationName="Dots", NumberOfParticles=40000)
dots.DensityArray = ["POINTS", "Hair"]
combed = Calculator(dots, registrationName="Combed", ResultArrayName="Way")
combed.Function = "Normal-0.5*jHat+0.4*kHat"
shade = Calculator(combed, registrationName="Shade", ResultArrayName="Shade")
shade.Function = "Normal_Y+0.4*sin(SeedId^2)"
hairs = Glyph(Input=shade, registrationName="Hairs", GlyphType="Cone", GlyphMode="All Points")
hairs.OrientationArray = ["POINTS", "Way"]
hairs.ScaleArray = ["POINTS", "No scale array"]
hairs.ScaleFactor = 0.09
hairs.GlyphType.Resolution = 5
hairs.GlyphType.Radius = 0.05
hairs.GlyphTransform.Translate = [0.5, 0, 0]

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.96, 0.94, 0.9]
skin = Show(cow, view)
skin.ColorArrayName = [None, ""]
skin.AmbientColor = skin.DiffuseColor = [0.55, 0.45, 0.36]
shown = Show(hairs, view)
UpdatePipeline(proxy=hairs)
ColorBy(shown, ("POINTS", "Shade"))
shown.SetScalarBarVisibility(view, False)
shown.Ambient = 0.2
colours = GetColorTransferFunction("Shade")
colours.ColorSpace = "RGB"
colours.RGBPoints = [-1, 0.4, 0.2, 0.1, 0, 0.75, 0.42, 0.18, 1, 0.95, 0.7, 0.4]

view.CameraFocalPoint = [0, 0.08, 0.05]
view.CameraPosition = [-6, 1.6, -4.8]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 15

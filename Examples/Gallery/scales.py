# SPDX-License-Identifier: BSD-3-Clause
"""A snake of 7,000 scales: small where it is thin, along the normal and a little to the head."""
from paraview.simple import *

line = Line(registrationName="Line", Point1=[0, 0, 0], Point2=[1, 0, 0], Resolution=1000)
# From the tail, 0, to the head, 1.
along = Calculator(line, registrationName="Along", ResultArrayName="Along", Function="coordsX")
width = Calculator(along, registrationName="Width", ResultArrayName="Radius")
width.Function = ("0.02+(0.2*sin(2.6*Along^0.7)+0.08*exp(-((Along-0.965)/0.025)^2))*sqrt(1-Along^60)")
turn = "17*Along^0.9"
reach = "(1.5-0.9*Along)"
spiral = Calculator(width, registrationName="Spiral", CoordinateResults=1)
spiral.Function = ("%s*(cos(%s)*iHat+sin(%s)*jHat)+(0.9*Along)*kHat" % (reach, turn, turn))
body = Tube(spiral, registrationName="Body", Scalars=["POINTS", "Radius"],
            VaryRadius="By Absolute Scalar", NumberofSides=48)
dense = Calculator(body, registrationName="Dense", ResultArrayName="Density", Function="1/Radius^2")
dots = SampleSurface(dense, registrationName="Dots", NumberOfParticles=7000)
dots.DensityArray = ["POINTS", "Density"]
lean = Calculator(dots, registrationName="Lean", ResultArrayName="Lean")
lean.Function = "Normal+0.4*(cos(%s)*jHat-sin(%s)*iHat)" % (turn, turn)
pattern = Calculator(lean, registrationName="Pattern", ResultArrayName="Pattern")
pattern.Function = "Normal_Z*(1+0.7*sin(120*Along))"
scales = Glyph(Input=pattern, registrationName="Scales", GlyphType="Sphere", GlyphMode="All Points")
scales.OrientationArray = ["POINTS", "Lean"]
scales.ScaleArray = ["POINTS", "Radius"]
scales.ScaleFactor = 0.47
scales.GlyphTransform.Scale = [0.25, 1, 1]
scales.GlyphType.ThetaResolution = scales.GlyphType.PhiResolution = 12

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.93, 0.93, 0.86]
inside = Show(body, view)
inside.ColorArrayName = [None, ""]
inside.AmbientColor = inside.DiffuseColor = [0.1, 0.12, 0.08]
shown = Show(scales, view)
UpdatePipeline(proxy=scales)
ColorBy(shown, ("POINTS", "Pattern"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("Pattern")
colours.ColorSpace = "RGB"
colours.RGBPoints = [-1, 0.95, 0.9, 0.7, 0, 0.75, 0.75, 0.35, 0.6, 0.35, 0.5, 0.2, 1.2, 0.3, 0.2, 0.1]
shown.Specular = 0.3
for place in [-0.53, -0.57, 1.03], [-0.31, -0.37, 1.03]:
    eye = Show(Sphere(registrationName="Eye", Center=place, Radius=0.045), view)
    eye.ColorArrayName = [None, ""]
    eye.AmbientColor = eye.DiffuseColor = [0.05, 0.03, 0.02]
    eye.Specular = 1

view.CameraFocalPoint = [-0.02, 0, 0.33]
view.CameraPosition = [2, -9, 6]
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = 15.5

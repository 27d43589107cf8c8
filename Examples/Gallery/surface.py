# SPDX-License-Identifier: BSD-3-Clause
"""A cow in 4,000 beads, spread evenly over the side that is seen, which is a disk."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
side = Clip(cow, registrationName="Side", ClipType="Plane")
side.ClipType.Origin = [0.004, 0, 0]
side.ClipType.Normal = [1, 0, 0]
dots = SampleSurface(side, registrationName="Dots")
dots.NumberOfParticles = 4000

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.96, 0.94, 0.9]
normals = GenerateSurfaceNormals(cow, registrationName="Normals")
inside = WarpByVector(normals, registrationName="Inside", Vectors=["POINTS", "Normals"])
inside.ScaleFactor = -0.02
body = Show(inside, view)
body.ColorArrayName = [None, ""]
body.AmbientColor = body.DiffuseColor = [0.05, 0.15, 0.2]
shown = Show(dots, view)
ColorBy(shown, ("POINTS", "Normal", "Y"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("Normal")
colours.ColorSpace = "RGB"
colours.RGBPoints = [-1, 0.45, 0.3, 0.7, 0, 0.2, 0.8, 0.75, 1, 1, 0.95, 0.5]
shown.GaussianRadius = 0.019

view.CameraFocalPoint = [0, 0.08, 0.05]
view.CameraPosition = [-7, 1.2, -1.8]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 15

# SPDX-License-Identifier: BSD-3-Clause
"""A cow in 8,000 beads, spread evenly."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
dots = SampleSurface(cow, registrationName="Dots")
dots.NumberOfParticles = 8000

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.96, 0.94, 0.9]
make_normals = globals().get("SurfaceNormals") or GenerateSurfaceNormals  # its name in ParaView 5.11
normals = make_normals(cow, registrationName="Normals")
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
shown.GaussianRadius = 0.0145

view.CameraFocalPoint = [0, 0.08, 0.05]
view.CameraPosition = [-7, 1.2, -1.8]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 15

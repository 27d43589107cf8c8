# SPDX-License-Identifier: BSD-3-Clause
"""A cow in 6,000 beads, spread evenly over its skin: a hole in the belly makes it a disk."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
skin = Clip(cow, registrationName="Skin", ClipType="Sphere", Invert=0)
skin.ClipType.Center = [0, -0.45, 0.2]
skin.ClipType.Radius = 0.3
dots = SampleSurface(skin, registrationName="Dots")
dots.NumberOfParticles = 6000

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.96, 0.94, 0.9]
normals = GenerateSurfaceNormals(cow, registrationName="Normals")
inside = WarpByVector(normals, registrationName="Inside", Vectors=["POINTS", "Normals"])
inside.ScaleFactor = -0.02
body = Show(inside, view)
body.ColorArrayName = [None, ""]
body.AmbientColor = body.DiffuseColor = [0.1, 0.1, 0.15]
shown = Show(dots, view)
ColorBy(shown, ("POINTS", "Normal", "Y"))
shown.SetScalarBarVisibility(view, False)
GetColorTransferFunction("Normal").ApplyPreset("Viridis (matplotlib)", True)
shown.GaussianRadius = 0.019

view.CameraFocalPoint = [0, 0.05, 0]
view.CameraPosition = [-5, 2, -5]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 15

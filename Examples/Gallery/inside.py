# SPDX-License-Identifier: BSD-3-Clause
"""5,000 points inside a cow. One half of them is shown, in one half of the skin."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
inside = SampleDensity(cow, registrationName="Inside", NumberOfParticles=5000)

# The skin is drawn outside of the beads, which are thicker than the points.
make_normals = globals().get("SurfaceNormals") or GenerateSurfaceNormals  # its name in ParaView 5.11
normals = make_normals(cow, registrationName="Normals")
skin = WarpByVector(normals, registrationName="Skin", Vectors=["POINTS", "Normals"], ScaleFactor=0.022)
halves = [Clip(of, registrationName=name, ClipType="Plane", Invert=0)
          for of, name in ((skin, "Half of the skin"), (inside, "Half of the points"))]
for half in halves:
    half.ClipType.Origin = [0, 0, 0]
    half.ClipType.Normal = [1, 0, 0]

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.96, 0.94, 0.9]
body, beads = [Show(half, view) for half in halves]
body.ColorArrayName = [None, ""]
body.AmbientColor = body.DiffuseColor = [0.85, 0.65, 0.5]
body.Ambient = 0.2
beads.SetRepresentationType("Point Gaussian")
beads.ShaderPreset = "Sphere"
beads.ColorArrayName = [None, ""]
beads.AmbientColor = beads.DiffuseColor = [0.2, 0.65, 0.75]
beads.GaussianRadius = 0.022

view.CameraFocalPoint = [0, 0.08, 0.05]
view.CameraPosition = [-6.2, 2, -3.2]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 15

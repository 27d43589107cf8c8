# SPDX-License-Identifier: BSD-3-Clause
"""The head of a cow, chequered by a map of it: all squares have the same area."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
head = Clip(cow, registrationName="Head", ClipType="Plane")
head.ClipType.Origin = [0, 0.2, -0.25]
head.ClipType.Normal = [0, -0.5, 1]
chart = AreaPreservingParameterization(head, registrationName="Map")

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.93, 0.9, 0.85]
shown = Show(chart, view)

view.CameraFocalPoint = [-0.09, 0.46, -0.42]
view.CameraPosition = [-2.5, 1.7, -5]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 12

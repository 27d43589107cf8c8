# SPDX-License-Identifier: BSD-3-Clause
"""Half a brain as spheres, as many in every part as its share of the signal."""
from paraview.simple import *

scan = XMLImageDataReader(registrationName="Scan", FileName=["Testing/Data/brain-t1.vti"])
cloud = SampleDensity(scan, registrationName="Cloud")
cloud.NumberOfParticles = 200000
half = Clip(cloud, registrationName="Half", ClipType="Plane")
half.ClipType.Origin = [89, 107, 89]
half.ClipType.Normal = [1, 0, 0]

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.02, 0.02, 0.04]
shown = Show(half, view)
shown.SetRepresentationType("Point Gaussian")
shown.ShaderPreset = "Sphere"
shown.GaussianRadius = 1.5
ColorBy(shown, ("POINTS", "T1"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("T1")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0, 0, 0.1, 40, 0.4, 0.1, 0.4, 90, 0.9, 0.4, 0.15, 130, 1, 0.95, 0.6]

view.CameraFocalPoint = [60, 107, 86]
view.CameraPosition = [560, 245, 190]
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = 20

# SPDX-License-Identifier: BSD-3-Clause
"""The lights of the Earth at night as 60,000 dots on a globe."""
from paraview.simple import *

night = PNGSeriesReader(registrationName="Night", FileNames=["Testing/Data/night-earth.png"])
chart = ExtractSurface(night, registrationName="Chart")
# The chart has 1024 columns of longitudes and 512 rows of latitudes.
longitude, latitude = "coordsX*2*3.14159265/1023", "(coordsY/511-0.5)*3.14159265"
globe = Calculator(chart, registrationName="Globe", CoordinateResults=1)
globe.Function = ("cos(%s)*(cos(%s)*iHat+sin(%s)*jHat)+sin(%s)*kHat"
                  % (latitude, longitude, longitude, latitude))
dots = SampleSurface(globe, registrationName="Dots", NumberOfParticles=60000)
dots.DensityArray = ["POINTS", "PNGImage"]

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.01, 0.01, 0.03]
ground = Sphere(registrationName="Ground", Radius=0.995, ThetaResolution=180, PhiResolution=90)
dark = Show(ground, view)
dark.ColorArrayName = [None, ""]
dark.AmbientColor = dark.DiffuseColor = [0.07, 0.11, 0.24]
shown = Show(dots, view)
shown.SetRepresentationType("Point Gaussian")
shown.ShaderPreset = "Plain circle"
shown.GaussianRadius = 0.0024
ColorBy(shown, ("POINTS", "PNGImage"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("PNGImage")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.7, 0.35, 0.1, 60, 1, 0.75, 0.3, 255, 1, 1, 0.9]

view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = [-4.9, 7, 5]
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = 12.5

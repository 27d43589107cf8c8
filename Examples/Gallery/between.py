# SPDX-License-Identifier: BSD-3-Clause
"""Smoke half way between two time steps, as particles in the colours of their speeds."""
from paraview.simple import *

plume = XMLImageDataReader(registrationName="Plume",
                           FileName=["Examples/Tutorial/plume-0.vti", "Examples/Tutorial/plume-1.vti"])
between = TransportTemporalInterpolator(registrationName="Between", Input=plume)
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.PlayMode = "Sequence"
scene.NumberOfFrames = 49
scene.AnimationTime = 0.5
smoke = Threshold(registrationName="Smoke", Input=OutputPort(between, 1), Scalars=["POINTS", "Mass"],
                  ThresholdMethod="Above Upper Threshold", UpperThreshold=0.004)

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.01, 0.01, 0.03]
shown = Show(smoke, view)
shown.SetRepresentationType("Point Gaussian")
shown.GaussianRadius = 0.02
ColorBy(shown, ("POINTS", "Velocity", "Magnitude"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("Velocity")
colours.ApplyPreset("Black-Body Radiation", True)
colours.RescaleTransferFunction(0.3, 1.7)

view.CameraFocalPoint = [2, 2, 3.4]
view.CameraPosition = [2, -8, 4.6]
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = 17

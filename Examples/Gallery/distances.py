# SPDX-License-Identifier: BSD-3-Clause
"""Where 49 pictures of a spot lie in a plane whose lengths are their distances."""
from paraview.simple import *

STEPS = range(-6, 7, 2)
pictures = [Wavelet(registrationName="%d %d" % (x, y), WholeExtent=[-10, 10, -10, 10, 0, 0],
                    Center=[x, y, 0], StandardDeviation=0.15, XMag=0, YMag=0, ZMag=0)
            for x in STEPS for y in STEPS]
distances = TransportDistance(registrationName="Distances", Input=pictures)
points = TableToPoints(registrationName="Points", Input=OutputPort(distances, 2), XColumn="Coordinate0",
                       YColumn="Coordinate1", a2DPoints=1, KeepAllDataArrays=1)
triangles = Delaunay2D(registrationName="Neighbours", Input=points)

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
shown = Show(triangles, view)
shown.SetRepresentationType("Wireframe")
shown.ColorArrayName = ["POINTS", ""]
shown.AmbientColor = shown.DiffuseColor = [0.6, 0.6, 0.6]
shown = Show(points, view)
shown.SetRepresentationType("Point Gaussian")
shown.ShaderPreset = "Plain circle"
shown.GaussianRadius = 0.35
ColorBy(shown, ("POINTS", "Coordinate0"))
shown.SetScalarBarVisibility(view, False)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 10], [0, 0, 0], [0, 1, 0]
view.CameraParallelProjection = 1
view.CameraParallelScale = 9.5

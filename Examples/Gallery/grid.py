# SPDX-License-Identifier: BSD-3-Clause
"""A grid bent by a slice of a brain: all of its meshes hold the same signal."""
from paraview.simple import *

scan = XMLImageDataReader(registrationName="Scan", FileName=["Testing/Data/brain-t1.vti"])
cut = ExtractSubset(scan, registrationName="Cut", VOI=[0, 89, 0, 107, 40, 40])
bend = TransportMap(cut, registrationName="Bend")
bend.SampleDimensions = [91, 109, 1]
bend.UpdatePipeline()
grid = WarpByVector(bend, registrationName="Grid", Vectors=["POINTS", "Displacement"])

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
shown = Show(grid, view)
shown.SetRepresentationType("Wireframe")
shown.LineWidth = 2
ColorBy(shown, ("POINTS", "Displacement", "Magnitude"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("Displacement")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.1, 0.1, 0.5, 25, 0.7, 0.1, 0.5, 60, 1, 0.7, 0.2]

view.CameraParallelProjection = 1
view.CameraFocalPoint = [90, 108, 80]
view.CameraPosition = [90, 108, 1000]
view.CameraViewUp = [1, 0, 0]
view.CameraParallelScale = 72

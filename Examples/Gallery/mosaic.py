# SPDX-License-Identifier: BSD-3-Clause
"""A photograph in 6,000 panes of equal ink, coloured by the light at their sites."""
from paraview.simple import *

photo = PNGSeriesReader(registrationName="Photo", FileNames=["Testing/Data/ascent.png"])
sites = SampleDensity(photo, registrationName="Sites")
sites.InvertDensity = 1  # dark ink is mass
sites.NumberOfParticles = 6000
panes = EqualMassCells(sites, registrationName="Panes", Domain=photo)
panes.Measure = "Density"
panes.Shape = "Power"
panes.InvertDensity = 1

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 0]
shown = Show(OutputPort(panes, 3), view)
shown.SetRepresentationType("Surface With Edges")
ColorBy(shown, ("CELLS", "PNGImage"))
shown.SetScalarBarVisibility(view, False)
colours = GetColorTransferFunction("PNGImage")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.05, 0.05, 0.2, 70, 0.35, 0.15, 0.45,
                     130, 0.9, 0.4, 0.3, 200, 1, 0.95, 0.7]
shown.Ambient, shown.Diffuse = 1, 0
shown.EdgeColor = [0.05, 0.03, 0.08]
shown.LineWidth = 1

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [255.5, 255.5, 0]
view.CameraPosition = [255.5, 255.5, 1000]
view.CameraParallelScale = 190

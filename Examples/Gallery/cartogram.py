# SPDX-License-Identifier: BSD-3-Clause
"""The United States with areas that are their people."""
from paraview.simple import *

states = GDALVectorReader(registrationName="States", FileName="Testing/Data/us-states.geojson")
people = Cartogram(states, registrationName="People", MassArray=["CELLS", "mass"])

view = GetActiveViewOrCreate("RenderView")
graticule = Show(OutputPort(people, 1), view)
graticule.AmbientColor = graticule.DiffuseColor = [0.75, 0.8, 0.85]
shown = Show(people, view)
shown.SetRepresentationType("Filled Outlines With Edges")
ColorBy(shown, ("CELLS", "MassPerArea"))
shown.SetScalarBarVisibility(view, False)
shown.Ambient, shown.Diffuse = 1, 0
shown.EdgeColor = [0.2, 0.25, 0.3]
colours = GetColorTransferFunction("MassPerArea")
colours.ColorSpace = "RGB"
colours.RGBPoints = [2, 0.99, 0.96, 0.82, 20, 0.93, 0.91, 0.66, 50, 0.68, 0.85, 0.62, 90, 0.4, 0.74, 0.6,
                     150, 0.2, 0.58, 0.6, 400, 0.12, 0.36, 0.55, 4000, 0.1, 0.2, 0.4]

view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [-50, 110, 0]
view.CameraPosition = [-50, 110, 10000]
view.CameraParallelScale = 1800

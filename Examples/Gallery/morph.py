# SPDX-License-Identifier: BSD-3-Clause
"""A cow becomes a ring: the surfaces of half the density at three moments of a morph."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
ring = Superquadric(registrationName="Ring", Toroidal=1, ThetaRoundness=1, PhiRoundness=1,
                    Thickness=0.4, ThetaResolution=96, PhiResolution=96, Size=0.9)
solids = [SolidDensity(surface, Resolution=64) for surface in (cow, ring)]

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
for i, colour in enumerate(([0.2, 0.5, 0.75], [0.45, 0.4, 0.65], [0.85, 0.4, 0.3])):
    morph = MorphDensities(solids[0], registrationName="Morph%d" % i, Target=solids[1],
                           Parameter=i / 2, Dimensions=[64, 64, 64], MassMode="Source")
    morph.UpdatePipeline()
    surface = Contour(morph, registrationName="Surface%d" % i)
    surface.ContourBy = ["POINTS", "Density"]
    surface.Isosurfaces = [0.5]
    placed = Transform(surface, registrationName="Placed%d" % i, Transform="Transform")
    placed.Transform.Translate = [-1.6 * i, -i, 0]
    shown = Show(placed, view)
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = colour
    shown.Specular = 0.3

view.CameraFocalPoint = [-1.6, -0.95, 0]
view.CameraPosition = [-4.5, 3.5, -13]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 16

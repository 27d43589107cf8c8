# SPDX-License-Identifier: BSD-3-Clause
"""A cow, a ball and a ring, cut along the red seams and laid flat: all squares have one area."""
from paraview.simple import *

cow = XMLPolyDataReader(registrationName="Cow", FileName=["Testing/Data/spot.vtp"])
ball = Sphere(registrationName="Ball", Radius=0.45, ThetaResolution=64, PhiResolution=64)
ring = Superquadric(registrationName="Ring", Toroidal=1, ThetaRoundness=1, PhiRoundness=1,
                    Thickness=0.4, ThetaResolution=64, PhiResolution=64, Size=0.6)
whole = Clean(ring, registrationName="Whole")  # its points are twice there along some lines
placed = []
for shape, turn, place in ((cow, [15, 130, 0], [-0.1, 0.5, 0]), (ball, [60, 30, 0], [-0.7, -0.9, 0]),
                           (whole, [60, 0, 15], [0.5, -0.9, 0])):
    moved = Transform(shape, Transform="Transform")
    moved.Transform.Rotate, moved.Transform.Translate = turn, place
    placed.append(moved)
shapes = AppendGeometry(registrationName="Shapes", Input=placed)
chart = AreaPreservingParameterization(shapes, registrationName="Map")
chart.UpdatePipeline()

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.97, 0.96, 0.94]
flat = Transform(OutputPort(chart, 1), registrationName="Flat", Transform="Transform")
flat.Transform.Translate, flat.Transform.Scale = [1.35, -1, 0], [2, 2, 2]
for name, part in ("Seams", chart), ("Borders", flat):
    shown = Show(part, view)
    shown.SetRepresentationType("Checkerboard")
    shown.Ambient = 0.25
    ColorBy(shown, ("CELLS", "Component"))
    shown.SetScalarBarVisibility(view, False)
    seams = FeatureEdges(part, registrationName=name, BoundaryEdges=1, FeatureEdges=0,
                         NonManifoldEdges=0, ManifoldEdges=0)
    cuts = Show(seams, view)
    cuts.ColorArrayName = [None, ""]
    cuts.AmbientColor = cuts.DiffuseColor = [0.8, 0.1, 0.1]
    cuts.LineWidth = 5
colours = GetColorTransferFunction("Component")
colours.ColorSpace = "RGB"
colours.RGBPoints = [0, 0.45, 0.75, 0.95, 1, 0.98, 0.8, 0.4, 2, 0.55, 0.85, 0.6]

view.CameraFocalPoint = [1.16, 0, 0]
view.CameraPosition = [1.16, 0, 12]
view.CameraViewUp = [0, 1, 0]
view.CameraViewAngle = 17

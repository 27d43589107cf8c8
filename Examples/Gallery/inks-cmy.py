# SPDX-License-Identifier: BSD-3-Clause
"""A photograph in dots of yellow, magenta and cyan, 20,000 in all. Each ink is what its channel lacks."""
from paraview.simple import *

photo = PNGSeriesReader(registrationName="Photo", FileNames=["Testing/Data/raccoon.png"])
# As many dots as an ink has mass, so that all dots are alike. Each ink has seeds of its own, or the
# dots of a grey photograph would lie on each other. The lightest ink comes first: it soils no pen.
inks = []
for number, (name, component, count) in enumerate(
        (("Yellow", 2, 7039), ("Magenta", 1, 6318), ("Cyan", 0, 6643)), start=1):
    dots = SampleDensity(photo, registrationName=name + " dots", Component=component,
                         InvertDensity=1, NumberOfParticles=count, RandomSeed=number)
    inks.append(Calculator(dots, registrationName=name, ResultArrayName="Ink", Function=str(number)))
drawing = AppendGeometry(Input=inks, registrationName="Inks")
# Views show dots in one plane in any order.
above = WarpByScalar(drawing, registrationName="One above the other", Scalars=["POINTS", "Ink"])

view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
shown = Show(above, view)
shown.SetRepresentationType("Point Gaussian")
shown.ShaderPreset = "Plain circle"
shown.GaussianRadius = 3.3
shown.Opacity = 0.7
ColorBy(shown, ("POINTS", "Ink"))
shown.SetScalarBarVisibility(view, False)
table = GetColorTransferFunction("Ink")
table.InterpretValuesAsCategories = 1
table.Annotations = ["1", "Yellow", "2", "Magenta", "3", "Cyan"]
table.IndexedColors = [1, 0.95, 0, 0.93, 0, 0.55, 0, 0.68, 0.94]

# The face.
view.InteractionMode = "2D"
view.CameraParallelProjection = 1
view.CameraFocalPoint = [640, 440, 0]
view.CameraPosition = [640, 440, 1000]
view.CameraParallelScale = 250

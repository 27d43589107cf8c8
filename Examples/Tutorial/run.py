# SPDX-License-Identifier: BSD-3-Clause
"""Remakes the seven tasks of Documentation/Tutorial.md: a picture of each, the film of the morph,
and, with --states, the state files beside this script."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example
import rectified_figures as figures
from paraview import simple

HERE = os.path.dirname(os.path.abspath(__file__))
PLUME = [os.path.join(HERE, "plume-%d.vti" % i) for i in range(2)]
BLUE, ORANGE = [0.13, 0.4, 0.67], [0.9, 0.45, 0.1]


def look(view, middle, away, up, height):
    """Looks at a point without perspective."""
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = middle
    view.CameraPosition = [m + a for m, a in zip(middle, away)]
    view.CameraViewUp = up
    view.CameraParallelScale = height / 2


def figure(source, port, name):
    """A number in the field data of an output."""
    source.UpdatePipeline()
    return simple.OutputPort(source, port).FieldData[name].GetRange()[0]


def arrows_along_ways(points, stride):
    """Thin arrows of the displacements of some points."""
    arrows = simple.Glyph(registrationName="Arrows", Input=points, GlyphType="Arrow")
    arrows.OrientationArray = ["POINTS", "Displacement"]
    arrows.ScaleArray = ["POINTS", "Displacement"]
    arrows.ScaleFactor = 1
    arrows.GlyphMode = "Every Nth Point"
    arrows.Stride = stride
    arrows.GlyphType.TipRadius = 0.04
    arrows.GlyphType.TipLength = 0.12
    arrows.GlyphType.ShaftRadius = 0.012
    return arrows


def slice_of(source, name):
    """Through the middle, with y as its normal."""
    cut = simple.Slice(registrationName=name, Input=source)
    cut.SliceType.Origin = [2, 2, 4]
    cut.SliceType.Normal = [0, 1, 0]
    return cut


def stipple_a_slice(pixels):
    """Dots in a slice through smoke, as many in every part as its share of it."""
    view = example.new_session([pixels, pixels], "Tutorial")
    plume = simple.XMLImageDataReader(registrationName="Plume", FileName=PLUME)
    plume.UpdatePipeline(1)
    cut = simple.Slice(registrationName="Slice", Input=plume)
    cut.SliceType.Origin = [2, 2, 4]
    cut.SliceType.Normal = [0.5, 1, 0]
    dots = simple.SampleDensity(cut, registrationName="Dots", NumberOfParticles=20000)
    dots.DensityArray = ["POINTS", "Smoke"]

    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = 1
    shown = simple.Show(dots, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Plain circle"
    shown.GaussianRadius = 0.005
    example.paint(shown, [0, 0, 0])
    edge = simple.Show(cut, view)
    edge.SetRepresentationType("Outline")
    example.paint(edge, [0.6, 0.6, 0.6])
    look(view, [2, 2, 4.2], [-5, -10, 0], [0, 0, 1], 3)
    simple.SetActiveSource(dots)
    return view, "%d dots, %.4f m² of smoke" % (
        example.result(dots).GetNumberOfPoints(), figure(dots, 0, "TotalMass") / 255)


def morph_two_volumes(pixels, frames, resolution):
    """A brain becomes a cow, in time steps that ParaView plays."""
    view = example.new_session([pixels, pixels], "Tutorial")
    brain = simple.XMLImageDataReader(registrationName="Brain", FileName=[example.BRAIN])
    cow = simple.XMLPolyDataReader(registrationName="Cow",
                                   FileName=[os.path.join(example.DATA, "spot.vtp")])
    place = simple.Transform(registrationName="Place", Input=cow, Transform="Transform")
    place.Transform.Rotate = [90, 0, 0]
    place.Transform.Scale = [100, 100, 100]
    brain.UpdatePipeline()
    box = brain.GetDataInformation().GetBounds()
    place.Transform.Translate = [(box[2 * i] + box[2 * i + 1]) / 2 for i in range(3)]
    solid = simple.SolidDensity(place, registrationName="Solid", Resolution=resolution)
    morph = simple.MorphDensities(brain, registrationName="Morph", Target=solid,
                                  Dimensions=[resolution] * 3, MassMode="Source", PublishTime=1,
                                  NumberOfTimeSteps=frames, ParticlesPerCell=2, NumberOfSteps=48,
                                  Kernel="TriangularShapedCloud")
    data = example.result(morph)
    surface = simple.Contour(registrationName="Surface", Input=morph)
    surface.ContourBy = ["POINTS", "Density"]
    surface.Isosurfaces = [40]

    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.PlayMode = "Snap To TimeSteps"
    shown = simple.Show(surface, view)
    example.paint(shown, [0.93, 0.72, 0.65])
    shown.Specular = 0.4
    middle = [(a + b) / 2 for a, b in zip(data.GetBounds()[::2], data.GetBounds()[1::2])]
    look(view, middle, [350, -300, 160], [0, 0, 1], 240)
    simple.SetActiveSource(morph)
    return view, morph


def compare_two_fields(pixels):
    """How far the smoke has come between two moments, and arrows for its ways."""
    view = example.new_session([pixels, pixels], "Tutorial")
    moments = [simple.XMLImageDataReader(registrationName=name, FileName=[path])
               for name, path in zip(("Earlier", "Later"), PLUME)]
    morph = simple.MorphDensities(moments[0], registrationName="Between", Target=moments[1],
                                  Parameter=0, ParticlesPerCell=1, Kernel="CloudInCell",
                                  NumberOfSteps=48)
    particles = simple.OutputPort(morph, 1)
    arrows = arrows_along_ways(particles, 611)

    for source, colour in zip(moments, (BLUE, ORANGE)):
        surface = simple.Contour(Input=source, ContourBy=["POINTS", "Smoke"], Isosurfaces=[64])
        shown = simple.Show(surface, view)
        example.paint(shown, colour)
        shown.Opacity = 0.25
    shown = simple.Show(arrows, view)
    colours = example.colour_by(shown, view, ("POINTS", "Displacement", "Magnitude"), "Viridis")
    legend = simple.GetScalarBar(colours, view)
    legend.Title, legend.ComponentTitle = "way, m", ""
    legend.TitleColor = legend.LabelColor = [0, 0, 0]
    shown.SetScalarBarVisibility(view, True)
    look(view, [2, 2, 3.4], [2, -10, 1], [0, 0, 1], 5.2)
    simple.SetActiveSource(morph)
    return view, math.sqrt(figure(morph, 0, "TransportCost"))


def two_runs(pixels):
    """Where the smoke of a run without wind has to go to be that of one with wind."""
    view = example.new_session([pixels, pixels], "Tutorial")
    runs = [simple.XMLImageDataReader(registrationName=name, FileName=[path])
            for name, path in (("Calm", PLUME[1]), ("Wind", os.path.join(HERE, "plume-wind.vti")))]
    transport = simple.TransportMap(runs[0], registrationName="Differences", Target=runs[1],
                                    Method="Optimal")
    cut = slice_of(transport, "Slice")
    smoke = simple.Threshold(registrationName="Smoke", Input=cut, Scalars=["POINTS", "Smoke"],
                             ThresholdMethod="Above Upper Threshold", UpperThreshold=64)
    arrows = arrows_along_ways(smoke, 4)

    shown = simple.Show(cut, view)
    shown.Ambient, shown.Diffuse = 1, 0
    simple.ColorBy(shown, ("POINTS", "CostDensity"))
    colours = simple.GetColorTransferFunction("CostDensity")
    colours.ApplyPreset("X Ray", True)
    legend = simple.GetScalarBar(colours, view)
    legend.Title, legend.ComponentTitle = "cost, m²", ""
    legend.WindowLocation = "Lower Left Corner"
    legend.TitleColor = legend.LabelColor = [0, 0, 0]
    shown.SetScalarBarVisibility(view, True)
    for source, colour in zip((cut, slice_of(runs[1], "Slice of Wind")), (BLUE, ORANGE)):
        lines = simple.Contour(Input=source, ContourBy=["POINTS", "Smoke"], Isosurfaces=[64])
        shown = simple.Show(lines, view)
        example.paint(shown, colour)
        shown.LineWidth = 3
    before = example.moved(arrows, 0, -2, 0)  # in front of the slice
    example.paint(simple.Show(before, view), [0.1, 0.6, 0.2])
    look(view, [2.1, 2, 4.1], [0, -10, 0], [0, 0, 1], 4)
    simple.SetActiveSource(transport)
    return view, math.sqrt(figure(transport, 0, "TransportCost"))


def between_two_steps(pixels, frames):
    """A series of two steps, with others between them that its mass moves through."""
    view = example.new_session([pixels, pixels], "Tutorial")
    plume = simple.XMLImageDataReader(registrationName="Plume", FileName=PLUME)
    between = simple.TransportTemporalInterpolator(plume, registrationName="Between",
                                                   ResampleFactor=frames - 1)
    between.DensityArray = ["POINTS", "Smoke"]
    surface = simple.Contour(registrationName="Surface", Input=between)
    surface.ContourBy = ["POINTS", "Smoke"]
    surface.Isosurfaces = [64]

    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.PlayMode = "Snap To TimeSteps"
    shown = simple.Show(surface, view)
    example.paint(shown, [0.75, 0.8, 0.9])
    look(view, [2, 2, 3.4], [2, -10, 1], [0, 0, 1], 5.2)
    simple.SetActiveSource(between)
    return view, between


def areas_of_people(pixels):
    """A map whose states have the areas of their people, as it is when it is first shown."""
    view = example.new_session([pixels, pixels], "Tutorial")
    states = simple.GDALVectorReader(registrationName="States",
                                     FileName=os.path.join(example.DATA, "us-states.geojson"))
    people = simple.Cartogram(states, registrationName="People", MassArray=["CELLS", "mass"])
    shown = simple.Show(people, view)
    simple.Show(simple.OutputPort(people, 1), view)
    shown.SetScalarBarVisibility(view, True)
    legend = simple.GetScalarBar(simple.GetColorTransferFunction("MassPerArea"), view)
    legend.Title = "people per square kilometre"
    legend.TitleColor = legend.LabelColor = [0, 0, 0]
    legend.Orientation, legend.WindowLocation = "Horizontal", "Lower Center"
    legend.UseCustomLabels, legend.CustomLabels, legend.AddRangeLabels = 1, [10, 100, 1000], 0
    look(view, [-50, -200, 0], [0, 0, 10000], [0, 1, 0], 5800)
    simple.SetActiveSource(people)
    return view, max(abs(error) for error in people.CellData["AreaError"].GetRange())


def dots_on_a_mesh(pixels):
    """A cow drawn by dots that are discs on it, as many in every part as its ink in a light."""
    view = example.new_session([pixels, pixels], "Tutorial")
    cow = simple.XMLPolyDataReader(registrationName="Cow",
                                   FileName=[os.path.join(example.DATA, "spot.vtp")])
    make_normals = getattr(simple, "SurfaceNormals", None) or simple.GenerateSurfaceNormals  # in 5.11
    normals = make_normals(cow, registrationName="Normals")
    ink = simple.Calculator(normals, registrationName="Ink", ResultArrayName="Ink")
    ink.Function = "0.03+(0.5-0.5*dot(Normals,0.8*jHat-0.5*iHat-0.3*kHat))^2"
    dots = simple.SampleSurface(ink, registrationName="Dots", NumberOfParticles=20000)
    dots.DensityArray = ["POINTS", "Ink"]
    discs = simple.Glyph(Input=dots, registrationName="Discs", GlyphType="Sphere",
                         GlyphMode="All Points", ScaleFactor=0.016)
    discs.OrientationArray = ["POINTS", "Normal"]
    discs.ScaleArray = ["POINTS", "No scale array"]
    discs.GlyphTransform.Scale = [0.2, 1, 1]
    for source, colour in (cow, [1, 1, 1]), (discs, [0, 0, 0]):
        shown = simple.Show(source, view)
        example.paint(shown, colour)
        shown.Ambient, shown.Diffuse = 1, 0
    look(view, [0, 0.1, 0.15], [-10, 3, -7], [0, 1, 0], 1.95)
    simple.SetActiveSource(dots)
    return view, "%d dots, %.4f of ink" % (
        example.result(dots).GetNumberOfPoints(), figure(dots, 0, "TotalMass"))


def main():
    parser = example.parser(
        __doc__, pixels=example.number(900, "side of the pictures", 16),
        frames=example.number(25, "pictures of the morph", 2),
        resolution=example.number(96, "values along the sides of the morph", 8),
        states=dict(action="store_true", help="write the state files too"))
    arguments = parser.parse_args()
    example.load_plugin()

    def keep(name, view):
        path = example.output(arguments, "tutorial-%s.png" % name)
        example.save_picture(path, view)
        if arguments.states:
            example.save_state(os.path.join(HERE, name + ".pvsm"))
        return path

    view, words = stipple_a_slice(arguments.pixels)
    print("%s: %s" % (keep("slice", view), words))

    def keep_film(name, view, source):
        scene, moments = simple.GetAnimationScene(), []
        for moment in (0, 0.25, 0.5, 0.75, 1):
            scene.AnimationTime = moment
            moments.append(("%g" % moment, figures.drawn(example.save_picture, view)))
        path = example.output(arguments, "tutorial-%s.png" % name)
        figures.montage(path, [moments], arguments.pixels // 3)
        film = example.output(arguments, "tutorial-%s.ogv" % name)
        simple.SaveAnimation(film, view, ImageResolution=[arguments.pixels] * 2, FrameRate=12)
        if arguments.states:
            scene.AnimationTime = 0.5
            example.save_state(os.path.join(HERE, name + ".pvsm"))
        print("%s, %s: %d time steps" % (film, path, len(source.TimestepValues)))

    keep_film("morph", *morph_two_volumes(arguments.pixels, arguments.frames, arguments.resolution))
    keep_film("between", *between_two_steps(arguments.pixels, arguments.frames))

    view, distance = compare_two_fields(arguments.pixels)
    print("%s: %.3f m" % (keep("compare", view), distance))

    view, distance = two_runs(arguments.pixels)
    print("%s: %.3f m" % (keep("runs", view), distance))

    view, error = areas_of_people(arguments.pixels)
    print("%s: areas within %.2f %%" % (keep("people", view), 100 * error))

    view, words = dots_on_a_mesh(arguments.pixels)
    print("%s: %s" % (keep("mesh", view), words))


if __name__ == "__main__":
    main()

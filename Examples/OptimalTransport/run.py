# SPDX-License-Identifier: BSD-3-Clause
"""Compares the flow with the optimal map: a stippled photograph, a morph in which a part stands
still, and a barycenter."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_shapes as shapes
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

METHODS = {"RectifiedFlow": {"Certify": 1}, "Optimal": {"Method": "Optimal"}}


def port(filter_, number):
    """What a filter that is up to date has at a port; not a copy."""
    return filter_.GetClientSideObject().GetOutputDataObject(number)


def field(data, name):
    """All numbers of an array of field data."""
    return vtk_to_numpy(data.GetFieldData().GetArray(name))


def per_cent(gap):
    return "%.2g %%" % (100 * gap)


def draw_dots(path, dots, image, most, radius, pixels):
    """Dots of a photograph, black where the map is optimal and red to orange where it is not."""
    x0, x1, y0, y1 = example.pixel_bounds(image)
    view = example.picture_view([pixels, round(pixels * (y1 - y0) / (x1 - x0))], [1, 1, 1])
    shown = simple.Show(dots, view, "GeometryRepresentation")
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Plain circle"
    shown.GaussianRadius = radius
    colours = example.colour_by(shown, view, ("POINTS", "Slack"), "Inferno")
    colours.RGBPoints = [0, 0.05, 0.05, 0.1, most / 4, 0.6, 0.05, 0.15, most, 1, 0.55, 0]
    colours.ColorSpace = "RGB"
    example.look_down(view, [(x0 + x1) / 2, (y0 + y1) / 2], y1 - y0, x1 - x0)
    example.save_picture(path, view)
    simple.Delete(view)


def stipple(arguments):
    """Pictures of a photograph's dots, and what both maps say of themselves."""
    photograph = example.open_image(arguments.image)
    image = example.fetch(photograph)
    dots, rows = {}, []
    for name, options in METHODS.items():
        dots[name] = simple.SampleDensity(photograph, InvertDensity=1,
                                          NumberOfParticles=arguments.particles, **options)
        data = example.result(dots[name])
        slack = np.sort(vtk_to_numpy(data.GetPointData().GetArray("Slack")))[::-1]
        cost, bound, gap = (field(data, array)[0] for array in
                            ("TransportCost", "TransportCostLowerBound", "OptimalityGap"))
        rows.append([name, "%.6g" % bound, "%.6g" % cost, per_cent(gap),
                     per_cent(2 * slack.mean() / bound), "%.3g" % np.median(slack),
                     "%.0f %%" % (100 * slack[:len(slack) // 10].sum() / slack.sum())])
        if name == "RectifiedFlow":
            most = slack[len(slack) // 50]
    figures.table("%d dots of a photograph, in squared pixels" % arguments.particles,
                  ["map", "lower bound", "cost", "gap", "gap by slack", "median slack",
                   "slack of a tenth of the dots"], rows)
    x0, x1, y0, y1 = example.pixel_bounds(image)
    radius = 0.3 * np.sqrt((x1 - x0) * (y1 - y0) / arguments.particles)
    return [("%s: gap %s" % (row[0], row[3]),
             figures.drawn(draw_dots, dots[row[0]], image, most, radius, arguments.panel))
            for row in rows]


def disks(size, places):
    """The image of disks, each with its middle and radius as parts of the image's side."""
    y, x = (np.mgrid[:size, :size] + 0.5) / size
    covered = np.zeros((size, size))
    for a, b, radius in places:
        # The share of a pixel at the edge is about that of a straight edge through it.
        covered += np.clip(size * (radius - np.hypot(x - a, y - b)) + 0.5, 0, 1)
    return figures.image_of(covered)


def circle(x, y, radius, count=96):
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=1)


def show(view, data, colour, width=1):
    shown = simple.Show(example.producer(data), view, "GeometryRepresentation")
    shown.LineWidth = width
    example.paint(shown, colour)
    return shown


def draw_ways(path, ways, places, size, pixels):
    """Straight ways from the grey disks, to a dot each."""
    shape = 0.84  # of the picture, as the disks leave room above and below
    view = example.picture_view([pixels, round(shape * pixels)], [1, 1, 1])
    for place in places:
        outline = circle(*(size * part for part in place))
        show(view, figures.shape(outline, [len(outline)], "Polys"), [0.85, 0.85, 0.85])
    # Above the disks.
    lifted = [np.column_stack([points, np.full(len(points), height)])
              for points, height in ((ways.reshape(-1, 2), 1), (ways[:, 1], 2))]
    show(view, figures.shape(lifted[0], [2] * len(ways)), [0.25, 0.45, 0.75])
    ends = show(view, figures.shape(lifted[1], [1] * len(ways), "Verts"), [0.75, 0.15, 0.2])
    ends.SetRepresentationType("Point Gaussian")
    ends.ShaderPreset = "Plain circle"
    ends.GaussianRadius = size / 220
    example.look_down(view, [size / 2, size / 2], shape * size, 10 * size)
    example.save_picture(path, view)
    for source in simple.GetSources().values():
        if source.GetXMLName() == "PVTrivialProducer":
            simple.Delete(source)
    simple.Delete(view)


def morph(arguments):
    """Pictures of the ways between two pairs of disks of which one stands still."""
    size, radius = arguments.size, 0.16
    still, start, end = (0.8, 0.74, radius), (0.2, 0.26, radius), (0.2, 0.74, radius)
    pictures, rows = [], []
    for background in 0, 0.01:
        images = []
        for places in (still, start), (still, end):
            image = disks(size, places)
            vtk_to_numpy(image.GetPointData().GetScalars())[:] += background
            images.append(example.producer(image))
        for name, options in METHODS.items():
            between = simple.MorphDensities(images[0], Target=images[1], NumberOfSteps=64,
                                            **options)
            example.result(between)
            data = port(between, 1)
            ways = np.stack([vtk_to_numpy(data.GetPointData().GetArray(array))[:, :2]
                             for array in ("SourcePosition", "TargetPosition")], axis=1)
            first = ways[:, 0] / size
            inside = np.hypot(first[:, 0] - still[0], first[:, 1] - still[1]) < still[2]
            moved = np.linalg.norm(ways[inside, 1] - ways[inside, 0], axis=1)
            rows.append([name, "%g" % background, "%.6g" % field(data, "TransportCost")[0],
                         per_cent(field(data, "OptimalityGap")[0]), "%.3f" % moved.mean(),
                         "%.1f %%" % (100 * (moved > 0.1).mean())])
            if background == 0:
                some = ways[np.random.default_rng(1).choice(len(ways), min(len(ways), 500), False)]
                pictures.append(("%s: the right disk moves %.2g pixels" % (name, moved.mean()),
                                 figures.drawn(draw_ways, some, (still, start), size,
                                               arguments.panel)))
    figures.table("Two disks on %d\u00b2 pixels, one of which stands still" % size,
                  ["map", "background", "cost", "gap", "it moves, pixels", "more than 0.1"], rows)
    return pictures


def star(size, a, b, radius):
    """The image of a star with five arms, its middle and radius as parts of the image's side."""
    y, x = (np.mgrid[:size, :size] + 0.5) / size
    edge = radius * (0.7 + 0.3 * np.cos(5 * np.arctan2(y - b, x - a)))
    return np.clip(size * (edge - np.hypot(x - a, y - b)) / 2 + 0.5, 0, 1)


def barycenter(arguments):
    """Pictures of three inputs and of their barycenters by both methods."""
    size = arguments.barycenter
    inputs = []
    for place in (0.22, 0.22), (0.5, 0.22), (0.22, 0.55):
        image = disks(size, [(*place, 0.12)])
        vtk_to_numpy(image.GetPointData().GetScalars())[:] += star(size, 0.72, 0.72, 0.22).ravel()
        image.GetPointData().GetScalars().SetName("Density")
        inputs.append(image)
    images = [example.producer(image) for image in inputs]
    panels = [("input", shapes.inked(image, shapes.COLOURS[2])) for image in inputs]
    for name, options in METHODS.items():
        mean = simple.DensityBarycenter(Input=images, DensityArray=["POINTS", "Density"],
                                        ParticlesPerCell=arguments.particles_per_cell,
                                        **shapes.SMOOTH, **options)
        image = example.result(mean)
        panels.append(("%s: %.1f" % (name, field(image, "TransportCostLowerBound")[0]),
                       shapes.inked(image, shapes.COLOURS[0])))
    figures.table("The functional of a barycenter on %d\u00b2 pixels, in squared pixels" % size,
                  ["iteration", "functional"],
                  [[str(i), "%.3f" % value]
                   for i, value in enumerate(field(image, "Functional"))])
    return panels


def main():
    arguments = example.parser(
        __doc__, small="--particles 2000 --size 64 --barycenter 48 --panel 240",
        image=example.file(),
        particles=example.number(20000, "number of dots", 100), size=256,
        barycenter=example.number(128, "pixels along the sides of the barycenter", 16),
        particles_per_cell=example.number(4, "of the barycenter"), panel=620).parse_args()

    example.load_plugin()
    for name, draw, part in (("stipples", stipple, 1), ("ways", morph, 1),
                             ("barycenter", barycenter, 0.4)):
        pictures = draw(arguments)
        path = example.output(arguments, "optimal-%s.png" % name)
        figures.montage(path, [pictures], round(part * arguments.panel))
        print(path)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of README.md and Documentation/."""
import os
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_shapes as shapes
from paraview import simple

STRIP = [560, 420]  # the size of a picture of the photograph


def draw_particles(path, stipple):
    dots, radius = stipple.stipple(example.open_image(example.PHOTOGRAPH), 10000)
    stipple.write_png(path, dots, [-0.5, 1023.5, -0.5, 767.5], radius, STRIP[0])


def draw_example(path, name, picture, *arguments):
    """A picture of another example, which is drawn apart: its own may lie beside this one."""
    draw_examples({path: picture}, name, *arguments)


def draw_examples(pictures, name, *arguments):
    """Pictures of another example, by the paths that they get."""
    with tempfile.TemporaryDirectory() as folder:
        sys.argv[1:] = [*arguments, "--output", folder]
        example.script(name).main()
        for path, picture in pictures.items():
            shutil.move(os.path.join(folder, picture), path)
    # What is left of it would be drawn and updated with the pictures that follow.
    for proxy in [*simple.GetViews(), *simple.GetSources().values()]:
        simple.Delete(proxy)


def draw_row(path, parts, size, radius, pixels, stipple):
    """Point sets that fill boxes of one size from the origin, side by side."""
    step = 1.06 * size[0]
    row = simple.AppendGeometry(Input=[example.moved(part, i * step, 0, 0)
                                       for i, part in enumerate(parts)])
    width = (len(parts) - 1) * step + size[0]
    stipple.write_png(path, row, [0, width, 0, size[1]], radius, pixels)


def draw_patterns(path, stipple):
    patterns = simple.UniformSeeds().GetProperty("Pattern").Available
    draw_row(path, [simple.UniformSeeds(Pattern=pattern, NumberOfPoints=900)
                    for pattern in patterns], [1, 1], 0.007, 1100, stipple)


def draw_flow(path, stipple):
    photograph = example.open_image(example.PHOTOGRAPH)
    draw_row(path, [simple.SampleDensity(photograph, InvertDensity=1, NumberOfParticles=3000,
                                         FlowTime=time) for time in (0, 0.5, 0.8, 1)],
             [1024, 768], 6, 1200, stipple)


def flat_picture(path, view, centre, half_height):
    """Keeps a view of the xy plane from above."""
    example.look_down(view, centre, 2 * half_height, 1000)
    example.save_picture(path, view)


def draw_map(path):
    """A grid as the map bends it: its cells hold equal masses."""
    transport = simple.TransportMap(example.open_image(example.PHOTOGRAPH), InvertDensity=1,
                                    SampleDimensions=[120, 90, 1])
    transport.UpdatePipeline()  # WarpByVector looks for its vectors when it is made
    view = example.picture_view(STRIP, [1, 1, 1])
    shown = simple.Show(simple.WarpByVector(Input=transport), view, "StructuredGridRepresentation")
    shown.SetRepresentationType("Wireframe")
    shown.LineWidth = 1.5
    colours = example.colour_by(shown, view, ("POINTS", "JacobianDeterminant"), "Viridis")
    colours.RescaleTransferFunction(0.5, 2.0)
    flat_picture(path, view, [511.5, 383.5], 384)


def draw_paths(path):
    paths = simple.SampleDensity(example.open_image(example.PHOTOGRAPH), InvertDensity=1,
                                 NumberOfParticles=250, OutputPaths=1)
    view = example.picture_view(STRIP, [1, 1, 1])
    shown = simple.Show(paths, view, "GeometryRepresentation")
    shown.SetRepresentationType("Wireframe")
    shown.LineWidth = 2
    example.colour_by(shown, view, ("POINTS", "Time"), "Viridis")
    flat_picture(path, view, [511.5, 383.5], 384)


def draw_splats(path, stipple, cells=(80, 60), side=240):
    """10,000 particles of the photograph's ink and what each kernel makes of them."""
    dots, radius = stipple.stipple(example.open_image(example.PHOTOGRAPH), 10000)
    row = [("particles", figures.drawn(stipple.write_png, dots, [-0.5, 1023.5, -0.5, 767.5],
                                       radius, side))]
    splat = simple.SplatMass(dots, Dimensions=[*cells, 1], MassArray=["POINTS", "Mass"])
    for kernel in ("NearestCell", "CloudInCell", "TriangularShapedCloud", "Gaussian"):
        splat.Kernel = kernel
        ink = np.clip(figures.values_of(example.result(splat)), 0, 255)
        row.append((kernel, figures.grey((255 - ink).round().astype(np.uint8))))
    figures.montage(path, [row], side)


def draw_solid(path, resolution=48, side=300):
    """Spot's surface, a slice of its density with one square a cell, and the density's contour."""
    spot = shapes.posed("spot")
    density = example.result(simple.SolidDensity(example.producer(spot), Resolution=resolution))
    values = figures.values_of(density, density.GetDimensions()[2] // 3)[..., None]
    cells = (255 - values * (255 - shapes.COLOURS[0])).round().astype(np.uint8)
    cells = figures.fitted(cells, side // resolution * cells.shape[1])
    low, left = ((side - n) // 2 for n in cells.shape[:2])
    cut = np.full((side, side, 3), 255, np.uint8)
    cut[low:low + cells.shape[0], left:left + cells.shape[1]] = cells
    figures.montage(path, [[
        ("closed surface", shapes.lit(spot, shapes.COLOURS[0], side)),
        ("Density, a slice", cut),
        ("Density, contour at 0.5", shapes.lit(shapes.surface(density), shapes.COLOURS[0], side)),
    ]], side)


def main():
    arguments = example.parser(__doc__, output=example.IMAGES).parse_args()
    example.load_plugin()
    stipple = example.script("StippleImage")

    drawn = []

    def path(name):
        drawn.append(name)
        return example.output(arguments, name + ".png")

    draw_particles(path("particles"), stipple)
    draw_example(path("volume"), "SampleVolume", "particles-brain-t1.png", "--particles", "100000",
                 "--pixels", str(STRIP[1]))
    draw_example(path("warped-photograph"), "WarpedPhotograph", "warped-raccoon.png", "--pixels", "720")
    draw_example(path("cartogram"), "Cartogram", "cartogram.png")
    draw_example(path("gaps"), "RasterWithGaps", "gaps.png")
    draw_example(path("districts"), "Districts", "districts.png")
    draw_example(path("area-errors"), "AreaErrors", "area-errors.png", "--pixels", "720")
    draw_example(path("map-target"), "FieldDifference", "field-difference.png")
    draw_example(path("distances"), "PlumeEnsemble", "plume-ensemble.png")
    draw_example(path("cells"), "Figure5Cells", "figure5-cells.png", "--sites", "256",
                 "--resolution", "512", "--pixels", "1020")
    draw_example(path("cells-shapes"), "PowerCells", "power-cells-random.png", "--sites", "150")
    for name, shape in (("territories", "power"), ("territories-flow", "flow")):
        draw_example(path(name), "Territories", "territories-night-europe-%s.png" % shape,
                     "--pixels", "1026")
    draw_example(path("colours"), "ColourStippling", "colours-raccoon.png", "--particles", "20000",
                 "--pixels", "760")
    draw_patterns(path("patterns"), stipple)
    draw_flow(path("flow"), stipple)
    draw_example(path("flow-maps"), "FlowMaps", "flow-maps.png")
    draw_map(path("map"))
    draw_paths(path("paths"))
    draw_example(path("morph"), "Morph2D", "morph-2d.png", "bunny", "camel+dinosaur",
                 "--frames", "6", "--panel", "140")
    draw_example(path("morph-3d"), "Morph3D", "morph-3d.png", "--panel", "180")
    draw_example(path("morph-3d-optimal"), "Morph3D", "morph-3d.png", "spot", "bunny", "--method",
                 "RectifiedFlow", "Optimal", "--panel", "180")
    draw_examples({path("optimal-" + name): "optimal-%s.png" % name
                   for name in ("stipples", "ways", "barycenter")}, "OptimalTransport",
                  "--particles", "8000", "--panel", "420")
    draw_example(path("barycenters"), "Barycenters2D", "barycenters-2d.png", "--panel", "90")
    draw_splats(path("splats"), stipple)
    draw_solid(path("solid"))
    draw_example(path("parameterization"), "Figure11Parameterization", "figure11-lion-head.png",
                 "lion-head", "--panel", "240")
    draw_example(path("closed-surfaces"), "ClosedSurfaces", "closed-surfaces.png", "bunny",
                 "armadillo", "--panel", "240")
    draw_example(path("surface-dots"), "StippleSurface", "stipple-surface-bunny.png",
                 "--dots", "10000", "--panel", "420")
    draw_example(path("print"), "StipplePrint", "print-raccoon.png", "--particles", "20000",
                 "--panel", "280")
    draw_example(path("video"), "VideoStippling", "video-stippling.png", "--panel", "220")
    draw_examples({path("tutorial-" + name): "tutorial-%s.png" % name
                   for name in ("slice", "morph", "compare", "people", "mesh")}, "Tutorial", "--pixels", "600")
    print("%s: %s" % (", ".join(drawn), arguments.output))


if __name__ == "__main__":
    main()

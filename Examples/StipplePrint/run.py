# SPDX-License-Identifier: BSD-3-Clause
"""Draws a photograph with dots for print: SVG and PDF, dots of one size or many, black or not."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_print as pages
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

STYLES = ["equal", "sizes", "colours", "inks"]
DETAIL = 6  # times that the picture's lower row enlarges the middle


def dots(colours, style, number, exponent):
    """The dots of a photograph, and the ink that they have to have, in pixels."""
    light = colours.min(axis=2) if style == "inks" else colours @ figures.LUMINANCE
    ink = (1 - light).clip(0)
    density = ink if style == "equal" else ink ** exponent
    source = example.producer(figures.image_of(density))
    sampler = simple.SampleDensity(source, NumberOfParticles=number)
    data = example.result(sampler)
    points = vtk_to_numpy(data.GetPoints().GetData())[:, :2].copy()
    share = data.GetPointData().GetArray("Mass").GetValue(0)
    simple.Delete(sampler)
    simple.Delete(source)

    height, width = ink.shape
    column, row = np.clip(points.astype(int), 0, [width - 1, height - 1]).T
    # Dots have equal shares of the density. A dot's ink is its share times ink over density there.
    weight = np.divide(ink, density, out=np.zeros_like(ink), where=density > 0)[row, column]
    drawn = colours[row, column]
    if style == "inks":  # the light that the pixel lacks, taken away by as little area as can be
        drawn = 1 - (1 - drawn) / np.maximum(ink[row, column], 1e-9)[:, None]
    black = style in ("equal", "sizes")
    return pages.Discs((width, height), points, np.sqrt(share * weight / np.pi),
                       None if black else figures.bytes_of(drawn)), ink.sum()


def main():
    parser = example.parser(
        __doc__, small="--particles 3000 --panel 160",
        image=example.file(), particles=example.number(40000, "number of dots"),
        width=pages.WIDTH,
        styles=dict(nargs="+", choices=STYLES, default=STYLES, metavar="STYLE",
                    help="of dots: " + ", ".join(STYLES) + " (default: all of them)"),
        exponent=dict(type=float, default=0.5,
                      help="the density is ink to this power, the dots' sizes do the rest; not of "
                           "equal (default: %(default)s)"),
        order=dict(choices=["File", "Path"], default="File",
                   help="of the dots in the files; Path: a short one, for plotters (default: "
                        "%(default)s)"),
        panel=480)
    arguments = parser.parse_args()
    if not 0 < arguments.exponent <= 1:
        parser.error("--exponent is %g; it must be more than 0 and at most 1" % arguments.exponent)

    example.load_plugin()
    colours = figures.colours_of(figures.photograph(arguments.image))
    name = "print-" + example.stem(arguments.image)
    rows, panels = [], []
    for style in arguments.styles:
        discs, ink = dots(colours, style, arguments.particles, arguments.exponent)
        path = example.output(arguments, name + "-" + style)
        for ending in ".svg", ".pdf":
            pages.write(path + ending, discs, arguments.width, arguments.order)
        panels.append(pages.pictures(discs, arguments.panel, [1, DETAIL]))
        unit = arguments.width / discs.size[0]
        rows.append([style, "%d" % len(discs.points),
                     "%.3f to %.3f" % tuple(2 * unit * np.quantile(discs.radii, [0, 1])),
                     "%.4f" % (discs.area() / ink),
                     *("%.2f" % (os.path.getsize(path + end) / 1e6) for end in (".svg", ".pdf"))])
    height = arguments.width * colours.shape[0] / colours.shape[1]
    figures.table("%s on pages of %.1f x %.1f mm" % (arguments.image, arguments.width, height),
                  ["style", "dots", "diameters, mm", "their area over the ink", "SVG, MB",
                   "PDF, MB"], rows)
    print("\n" + figures.write_montage(arguments, name + ".png", [
        [(style, whole) for style, (whole, _) in zip(arguments.styles, panels)],
        [("", detail) for _, detail in panels]]))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Divides Europe into territories of equal light at night, by either Shape of Equal Mass Cells."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray

# Colours of territories, as many as neighbours need nearly always; of lights and of borders.
TINTS = np.array([(28, 74, 110), (110, 46, 66), (34, 94, 76), (112, 84, 36), (74, 54, 112),
                  (46, 88, 34), (104, 56, 30), (30, 92, 104)])
LIGHT = np.array([255, 238, 190])
SEA = np.array([13, 15, 23])
BORDER = [0.05, 0.06, 0.09]
SITE = [1.0, 0.42, 0.32]


def place_sites(density, count, iterations, invert):
    """Sites like the density, in the middles of cells of equal mass."""
    sites = simple.SampleDensity(Input=density, NumberOfParticles=count, InvertDensity=invert,
                                 SampleArrays=0)
    sites.UpdatePipeline()
    return simple.RelaxBlueNoise(Input=sites, Density=density, InvertDensity=invert,
                                 Method="OptimalTransport", MaximumIterations=iterations)


def tints_of(labels, count):
    """The number of a tint for each territory: neighbours differ while there are tints enough."""
    pairs = np.concatenate([np.c_[labels[:, 1:].ravel(), labels[:, :-1].ravel()],
                            np.c_[labels[1:].ravel(), labels[:-1].ravel()]])
    pairs = np.unique(pairs[(pairs[:, 0] != pairs[:, 1]) & (pairs.min(axis=1) >= 0)], axis=0)
    neighbours = [set() for _ in range(count)]
    for one, other in pairs:
        neighbours[one].add(other)
        neighbours[other].add(one)
    found = np.full(count, -1)
    used = np.zeros(len(TINTS), int)
    for site in sorted(range(count), key=lambda site: -len(neighbours[site])):
        free = np.ones(len(TINTS), bool)
        free[[found[other] for other in neighbours[site] if found[other] >= 0]] = False
        choices = np.flatnonzero(free) if free.any() else np.arange(len(TINTS))
        found[site] = choices[used[choices].argmin()]
        used[found[site]] += 1
    return found


def picture_of(cells, density, count):
    """The image of labels in the tints of the territories, with what the density is of."""
    labels = example.result(cells)
    columns, rows = (n - 1 for n in labels.GetDimensions()[:2])
    sites = vtk_to_numpy(labels.GetCellData().GetArray("SiteId")).reshape(rows, columns)
    light = figures.values_of(figures.resized(density, columns, rows)).astype(float)
    light = (light / max(light.max(), 1)).clip(0, 1).reshape(rows, columns, -1).mean(axis=2)
    light = light[..., None] ** 0.6
    tints = np.vstack([TINTS[tints_of(sites, count)], SEA])  # of -1: no territory
    colours = tints[sites] * (1 - light) + LIGHT * light
    drawn = labels.NewInstance()
    drawn.CopyStructure(labels)
    array = numpy_to_vtk(colours.reshape(-1, 3).round().astype(np.uint8), deep=1)
    array.SetName("Colours")
    drawn.GetCellData().SetScalars(array)
    return drawn


def borders_of(cells):
    """The outlines; of Flow without the coasts: between two territories a line is there in both
    directions."""
    if cells.Shape == "Power":
        return simple.OutputPort(cells, 2)
    outlines = cells.GetClientSideObject().GetOutputDataObject(2)
    ends = vtk_to_numpy(outlines.GetLines().GetConnectivityArray()).reshape(-1, 2)
    places = np.unique(vtk_to_numpy(outlines.GetPoints().GetData()).round(6), axis=0,
                       return_inverse=True)[1].ravel()[ends]
    _, found, counts = np.unique(np.sort(places, axis=1), axis=0, return_inverse=True,
                                 return_counts=True)
    twice = ends[counts[found.ravel()] == 2]
    borders = outlines.NewInstance()
    borders.SetPoints(outlines.GetPoints())
    lines = vtkCellArray()
    lines.SetData(2, numpy_to_vtkIdTypeArray(twice.ravel(), deep=1))
    borders.SetLines(lines)
    return example.producer(borders)


def draw(path, cells, density, count, pixels):
    """Territories, their borders, and the sites."""
    drawn = picture_of(cells, density, count)
    x0, x1, y0, y1 = drawn.GetBounds()[:4]
    zoom = pixels / (x1 - x0)
    view = example.picture_view([pixels, round(zoom * (y1 - y0))], [0, 0, 0])
    shown = simple.Show(example.producer(drawn), view)
    simple.ColorBy(shown, ("CELLS", "Colours"))
    shown.MapScalars = 0
    layers = ((borders_of(cells), BORDER), (simple.OutputPort(cells, 1), SITE))
    for i, (above, colour) in enumerate(layers, 1):
        layer = simple.Show(example.moved(above, 0, 0, 0.002 * (x1 - x0) * i), view)
        example.paint(layer, colour)
        layer.LineWidth = 1.6
        layer.Ambient, layer.Diffuse = 1, 0
        if colour is SITE:
            layer.SetRepresentationType("Point Gaussian")
            layer.ShaderPreset = "Plain circle"
            layer.GaussianRadius = 3.5 / zoom
    shown.Ambient, shown.Diffuse = 1, 0
    example.look_down(view, [(x0 + x1) / 2, (y0 + y1) / 2], y1 - y0, 10 * (x1 - x0))
    example.save_picture(path, view)


def row(shape, cells, count):
    """What the territories are like: how unequal, how far to go."""
    example.result(cells)
    data = cells.GetClientSideObject().GetOutputDataObject(1)
    masses = vtk_to_numpy(data.GetPointData().GetArray("CellMass"))
    sites = vtk_to_numpy(example.result(cells).GetCellData().GetArray("SiteId"))
    sizes = np.bincount(sites[sites >= 0], minlength=count)
    cost = data.GetFieldData().GetArray("TransportCost").GetValue(0)
    return [shape, "%.2g" % abs(masses / masses.mean() - 1).max(),
            "%d to %d" % (sizes.min(), sizes.max()), "%.4g" % np.sqrt(cost)]


def main():
    arguments = example.parser(
        __doc__, small="--sites 40 --iterations 10 --resolution 342 --pixels 480",
        image=example.file(example.NIGHT, "a picture of which every territory gets an "
                           "equal share of the light"),
        sites=example.number(120, "how many territories"),
        iterations=example.number(40, "of the sites' relaxation", 0),
        resolution=example.number(1710, "pixels of the territories along the longest side"),
        pixels=example.number(1710, "width of the pictures", 64),
        ink=dict(action="store_true", help="shares of the ink of a photograph, not of the light")
    ).parse_args()

    example.load_plugin()
    source = example.open_image(arguments.image)
    density = example.fetch(source)
    sites = place_sites(source, arguments.sites, arguments.iterations, arguments.ink)
    sites.UpdatePipeline()
    rows = []
    for shape in ("Flow", "Power"):
        cells = simple.EqualMassCells(Input=sites, Domain=source, Measure="Density", Shape=shape,
                                      InvertDensity=arguments.ink,
                                      Resolution=arguments.resolution)
        rows.append(row(shape, cells, arguments.sites))
        path = example.output(arguments, "territories-%s-%s.png"
                              % (example.stem(arguments.image), shape.lower()))
        draw(path, cells, density, arguments.sites, arguments.pixels)
        print(path)
    figures.table("%d territories" % arguments.sites,
                  ["shape", "largest deviation of a share", "pixels", "distance, RMS"], rows)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Draws how a flow map works: a lattice of seeds, where the flow takes it while it is smooth, and
particles that follow the lattice and then go on alone."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

BLUE, PALE, RED, INK = [0.1, 0.4, 0.72], [1, 0.87, 0.62], [0.88, 0.28, 0.02], [0.15] * 3
CELL = 0.47, 0.5  # of the lattice, whose particles are red: where it lies in the picture


class LatticeAxis:
    """Nodes 0 to `cells` on [0, size]. They are evenly spaced in u = 2 sqrt(layer x) next to 0, in
    u = x + layer inside, and mirrored at the other end: denser towards both ends."""

    def __init__(self, size, layer, cells):
        self.size, self.layer, self.cells = size, layer, cells
        self.spacing = (size + 2 * layer) / cells

    def coordinates(self, nodes):
        """Where nodes lie, and the points between them that have parts of a node as numbers."""
        u = np.asarray(nodes) * self.spacing
        near = np.minimum(u, self.cells * self.spacing - u)  # from the nearer end
        x = np.where(near < 2 * self.layer, near ** 2 / (4 * self.layer), near - self.layer)
        return np.where(u == near, x, self.size - x)

    def places(self, x):
        """The reverse."""
        near = np.minimum(x, self.size - x)
        u = np.where(near < self.layer, 2 * np.sqrt(self.layer * near), near + self.layer)
        return np.where(x == near, u / self.spacing, self.cells - u / self.spacing)

    def stencils(self, x):
        """The first of the four nodes around each x, and the weights of the cubic through them."""
        place = self.places(x)
        first = np.clip(place.astype(int) - 1, 0, self.cells - 3)
        a = place - first
        return first, np.stack([-(a - 1) * (a - 2) * (a - 3) / 6, a * (a - 2) * (a - 3) / 2,
                                -a * (a - 1) * (a - 3) / 2, a * (a - 1) * (a - 2) / 6])


class FlowMap:
    """The positions at one time of the seeds that are the nodes of a lattice on a square."""

    def __init__(self, density, time, cells):
        size = density.GetDimensions()[0]
        rest = 1 - time
        width = size * rest / (1 - rest)  # of the box at that time
        self.axis = LatticeAxis(size, min(width, size / 2), cells)
        along = self.axis.coordinates(np.arange(cells + 1))
        self.seeds = np.stack(np.meshgrid(along, along), axis=-1)
        self.ends = advected(density, self.seeds.reshape(-1, 2), FlowTime=time,
                             FlowMaps="Off").reshape(self.seeds.shape)

    def interpolated(self, seeds):
        """The positions of other seeds at that time."""
        columns, across = self.axis.stencils(seeds[:, 0])
        rows, up = self.axis.stencils(seeds[:, 1])
        return sum((across[i] * up[j])[:, None] * self.ends[rows + j, columns + i]
                   for i in range(4) for j in range(4))


def contrasting(image):
    """An image with its ink squared."""
    ink = 255.0 - figures.values_of(image)
    return figures.image_of((255 - ink ** 2 / 255).round().astype(np.uint8))


def advected(density, seeds, **options):
    """Where Sample Density takes seeds in 32 steps."""
    points = figures.shape(seeds, [1] * len(seeds), "Verts")
    transport = simple.SampleDensity(example.producer(density), Seeds=example.producer(points),
                                     InvertDensity=1, NumberOfSteps=32)
    ends = vtk_to_numpy(example.result(transport, **options).GetPoints().GetData())[:, :2].copy()
    simple.Delete(transport)
    return ends


def uniform_seeds(density, number):
    sampler = simple.SampleDensity(example.producer(density), InvertDensity=1,
                                   NumberOfParticles=number)
    seeds = example.result(sampler).GetPointData().GetArray("SeedPosition")
    return vtk_to_numpy(seeds)[:, :2].copy()


def print_errors(density, time, seeds):
    """How far interpolation is off at the hand-over, and particles at time 1."""
    exact = advected(density, seeds, FlowTime=time, FlowMaps="Off")
    rows = []
    for cells in (16, 32, 64, 128):
        errors = figures.lengths(FlowMap(density, time, cells).interpolated(seeds) - exact)
        rows.append(["%d x %d cells" % (cells, cells), "%.4f" % errors.mean(),
                     "%.4f" % np.quantile(errors, 0.99), "%.4f" % errors.max()])
    figures.table("Positions at time %g by interpolation, against those by steps, in pixels" % time,
                  ["lattice", "mean error", "99 % below", "largest"], rows)

    exact = advected(density, seeds, Integrator="Adaptive", Tolerance=1e-4)
    rows = []
    for maps in "Off", "On":
        errors = figures.lengths(advected(density, seeds, FlowMaps=maps) - exact)
        rows.append([maps, *("%.4f" % e for e in (errors.mean(), np.quantile(errors, 0.99),
                                                  errors.max()))])
    figures.table("Positions at time 1 with 32 steps, against Adaptive, Tolerance 0.0001, in "
                  "pixels", ["FlowMaps", "mean error", "99 % below", "largest"], rows)


def draw(path, parts, size, pixels):
    """Draws parts, the lowest first: data, their colour, and the width of lines, the radius of
    points or, without a colour, the opacity of an image."""
    view = example.picture_view([pixels, pixels], [1, 1, 1])
    for height, (data, colour, measure) in enumerate(parts):
        source = example.moved(example.producer(data), 0, 0, height)
        shown = simple.Show(source, view)
        shown.SetRepresentationType("Surface")
        shown.Ambient, shown.Diffuse = 1, 0
        if colour is None:
            shown.MapScalars, shown.Opacity = 0, measure
            simple.ColorBy(shown, ("POINTS", "Values"))
            shown.SetScalarBarVisibility(view, False)
            continue
        example.paint(shown, colour)
        if data.GetNumberOfVerts():
            shown.SetRepresentationType("Point Gaussian")
            shown.ShaderPreset = "Plain circle"
            shown.GaussianRadius = measure
        else:
            shown.LineWidth = measure
    room = 1.02 * size  # lines on the border keep their width
    example.look_down(view, [size / 2, size / 2], room, size)
    example.save_picture(path, view)


def panels(density, time, seeds, cells, pixels):
    size = density.GetDimensions()[0]
    flow_map = FlowMap(density, time, cells)
    axis = flow_map.axis
    left, low = (int(axis.places(np.array(place * size))) for place in CELL)

    # In numbers of nodes and parts of them: the lattice's lines, the way around the cell, and the
    # 16 nodes that it is interpolated from.
    fine = np.linspace(0, cells, 20 * cells + 1)
    lines = np.concatenate([[np.stack([fine, 0 * fine + n], axis=-1),
                             np.stack([0 * fine + n, fine], axis=-1)] for n in range(cells + 1)])
    step = np.linspace(0, 1, 21)[:-1]
    around = np.concatenate([np.stack(side, axis=-1) for side in (
        (left + step, low + 0 * step), (left + 1 + 0 * step, low + step),
        (left + 1 - step, low + 1 + 0 * step), (left + 0 * step, low + 1 - step))])
    nodes = np.stack(np.meshgrid(left + np.arange(-1, 3), low + np.arange(-1, 3)), axis=-1)

    places = np.stack([axis.places(seeds[:, k]) for k in range(2)], axis=-1)
    inside = (np.floor(places) == [left, low]).all(axis=1)
    values = figures.values_of(density)
    radius = np.sqrt((1 - values / 255).sum() / len(seeds) / np.pi)  # as much ink as the density
    paper = figures.image_of(figures.grey(values))

    def dots(points, colour, times=1.0):
        return figures.shape(points, [1] * len(points), "Verts"), colour, times * radius

    def particles(points, times=1.0):
        return [dots(points[~inside], INK, times), dots(points[inside], RED, 1.3 * times)]

    def lattice(carry):
        return [(figures.shape(carry(axis.coordinates(around)), [len(around)], "Polys"), PALE, 1),
                (figures.shape(carry(axis.coordinates(lines.reshape(-1, 2))),
                               [len(fine)] * len(lines)), BLUE, 1.6),
                dots(carry(axis.coordinates(nodes.reshape(-1, 2))), BLUE, 2.3)]

    def stay(points):
        return points

    cell, net, stencil = lattice(stay)
    start = [(paper, None, 0.55), cell, net, dots(seeds[inside], RED), stencil]
    carry = flow_map.interpolated
    cell, net, stencil = lattice(carry)
    middle = [cell, *particles(carry(seeds), 0.75), net, stencil]
    end = particles(advected(density, seeds, FlowMaps="On"))
    return [(words, figures.drawn(draw, parts, size, pixels)) for words, parts in (
        ("time 0: the density and a lattice of seeds", start),
        ("time %g: particles follow the lattice" % time, middle),
        ("time 1: they went on by themselves", end))]


def main():
    parser = example.parser(
        __doc__, small="--size 128 --particles 1500 --panel 160",
        image=example.file(),
        size=example.number(512, "pixels along the sides of its middle square", 16),
        particles=example.number(8000, "number of particles"),
        cells=example.number(16, "cells of the lattice along an axis", 8),
        time=dict(type=float, default=0.79,
                  help="when particles leave the lattice (default: %(default)s)"),
        panel=384)
    arguments = parser.parse_args()
    if not 0 < arguments.time < 1:
        parser.error("--time is %g; it must lie between 0 and 1" % arguments.time)

    example.load_plugin()
    density = contrasting(figures.grey_square(figures.photograph(arguments.image), arguments.size))
    seeds = uniform_seeds(density, arguments.particles)
    print_errors(density, arguments.time, seeds)
    row = panels(density, arguments.time, seeds, arguments.cells, arguments.panel)
    print("\n" + figures.write_montage(arguments, "flow-maps.png", [row]))


if __name__ == "__main__":
    main()

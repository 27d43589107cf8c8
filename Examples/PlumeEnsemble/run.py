# SPDX-License-Identifier: BSD-3-Clause
"""An ensemble of plumes whose wind and source vary: points by Transport Distance find the order of the
winds, points by differences of values do not."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

WINDS = -50, 50  # degrees


def plume(size, wind, source, speed, phase):
    """Puffs that the wind carries away from a source and that widen and swing on the way; their mass
    is 1."""
    y, x = (np.mgrid[:size, :size] + 0.5) / size
    along = np.array([np.cos(wind), np.sin(wind)])
    across = np.array([-along[1], along[0]])
    smoke = np.zeros((size, size))
    for age in np.linspace(0, 1, 60):
        place = source + speed * age * along + 0.02 * age * np.sin(6 * age + phase) * across
        width = 0.006 + 0.022 * age
        squared = (x - place[0]) ** 2 + (y - place[1]) ** 2
        smoke += np.exp(-age - squared / (2 * width ** 2)) / width ** 2
    return smoke / smoke.sum()


def ensemble(size, members, seed):
    """The winds of the members in an order without meaning, and their plumes."""
    random = np.random.default_rng(seed)
    winds = random.permutation(np.linspace(*WINDS, members))
    plumes = [plume(size, np.radians(wind), np.array([0.12, 0.5]) + random.uniform(-0.04, 0.04, 2),
                    random.uniform(0.4, 0.56), random.uniform(0, 6))
              for wind in winds]
    return winds, plumes


def coordinates_of(table):
    return np.stack([vtk_to_numpy(table.GetColumnByName("Coordinate%d" % k)) for k in (0, 1)], axis=1)


def by_values(plumes):
    """Points by classical scaling of the root mean square differences of the values."""
    squares = np.array([[((a - b) ** 2).mean() for a in plumes] for b in plumes])
    centred = np.eye(len(plumes)) - 1 / len(plumes)
    values, vectors = np.linalg.eigh(-0.5 * centred @ squares @ centred)
    return vectors[:, :-3:-1] * np.sqrt(values[:-3:-1])


def rank_correlation(a, b):
    """Spearman's, of numbers without ties."""
    ranks = [np.argsort(np.argsort(numbers)) for numbers in (a, b)]
    return abs(np.corrcoef(ranks)[0, 1])


def colours_of(winds):
    """From blue over grey to orange."""
    part = ((winds - WINDS[0]) / (WINDS[1] - WINDS[0]))[:, None]
    ends = np.array([[25, 90, 190], [150, 150, 150], [225, 105, 20]])
    low = 2 * np.minimum(part, 0.5)
    high = 2 * np.maximum(part, 0.5) - 1
    return (ends[0] + low * (ends[1] - ends[0]) + high * (ends[2] - ends[1])).round().astype(np.uint8)


def draw_points(path, points, winds, pixels):
    """The members as points in the colours of their winds, joined in the order of the winds."""
    low, high = points.min(axis=0), points.max(axis=0)
    points = (points - (low + high) / 2) / (high - low).max()
    view = example.picture_view([pixels, pixels], [1, 1, 1])
    order = np.argsort(winds)
    line = simple.Show(example.producer(figures.shape(points[order], [len(points)])), view,
                       "GeometryRepresentation")
    example.paint(line, [0.75, 0.75, 0.75])
    line.LineWidth = 2
    dots = figures.shape(np.c_[points, np.full(len(points), 0.01)], [1] * len(points), "Verts")
    colours = numpy_to_vtk(colours_of(winds), deep=1)
    colours.SetName("Wind")
    dots.GetPointData().AddArray(colours)
    shown = simple.Show(example.producer(dots), view, "GeometryRepresentation")
    shown.ColorArrayName = ["POINTS", "Wind"]
    shown.MapScalars = 0
    shown.PointSize = max(6, pixels // 26)
    shown.RenderPointsAsSpheres = 1
    shown.Ambient, shown.Diffuse = 1, 0
    example.look_down(view, [0, 0], 1.1, 10)
    example.save_picture(path, view)


def overlay(plumes, winds, panel):
    """Every sixth plume by its wind, in the colour of this, as ink on white."""
    picture = np.full((*plumes[0].shape, 3), 255.0)
    for member in np.argsort(winds)[::max(1, len(winds) // 6)]:
        share = plumes[member] / np.quantile(plumes[member], 0.99)
        picture -= np.clip(share, 0, 1)[..., None] * (255.0 - colours_of(winds[[member]]))
    return figures.fitted(np.clip(picture, 0, 255).round().astype(np.uint8), panel)


def main():
    arguments = example.parser(
        __doc__, small="--size 48 --panel 220",
        size=128, members=example.number(40, "plumes of the ensemble", 3),
        seed=example.number(1, "of the random numbers", 0), panel=360).parse_args()
    example.load_plugin()
    winds, plumes = ensemble(arguments.size, arguments.members, arguments.seed)
    inputs = [example.producer(figures.image_of(values)) for values in plumes]
    distances = simple.TransportDistance(Input=inputs, InputNames=["%.0f" % wind for wind in winds])
    seconds = figures.seconds(distances)
    table = distances.GetClientSideObject().GetOutputDataObject(2)
    points = {"Transport Distance": coordinates_of(table), "differences of values": by_values(plumes)}
    figures.table(
        "%d plumes of %d\u00b2 cells: %.1f s; Stress %.2f"
        % (arguments.members, arguments.size, seconds,
           table.GetFieldData().GetArray("Stress").GetValue(0)),
        ["points by", "rank correlation of Coordinate0 and the wind"],
        [[name, "%.3f" % rank_correlation(found[:, 0], winds)] for name, found in points.items()])
    pictures = [("every sixth wind", overlay(plumes, winds, arguments.panel))]
    for name, found in points.items():
        pictures.append((name, figures.drawn(draw_points, found, winds, arguments.panel)))
    print("\n" + figures.write_montage(arguments, "plume-ensemble.png", [pictures]))


if __name__ == "__main__":
    main()

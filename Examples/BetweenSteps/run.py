# SPDX-License-Identifier: BSD-3-Clause
"""Keeps every tenth step of two series of densities, and compares what comes out between them with the steps
that were left out: by Transport Temporal Interpolator, and by ParaView's Temporal Interpolator."""
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_video as video
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

STEPS = 41
NAMES = "transport", "fade"

trapezoid = np.trapezoid if hasattr(np, "trapezoid") else np.trapz  # numpy 2 renamed it


def disc(x, y, width, size):
    """A smooth spot of mass 1 about a place in the unit square."""
    c = (np.arange(size) + 0.5) / size
    squared = (c[None, :] - x) ** 2 + (c[:, None] - y) ** 2
    spot = np.exp(-squared / (2 * width ** 2)) * (squared < (5 * width) ** 2)
    return spot / spot.sum()


def plume(time, size):
    """Smoke from a chimney, puff by puff, in a wind that turns; at a time from 0 to 1. Puffs grow as
    they drift."""
    puffs = np.linspace(-0.35, time, 60 + round(60 * time))
    image = np.zeros((size, size))
    for start in puffs:
        way = np.linspace(start, time, 20)
        east = trapezoid(0.25 + 0.35 * way, way)
        north = trapezoid(0.55 * np.cos(2.2 * way), way)
        image += disc(0.2 + east, 0.15 + north, 0.018 + 0.05 * (time - start), size)
    return image


def pair(time, size):
    """Two spots that meet and become one."""
    way = 0.5 - 0.5 * np.cos(np.pi * min(1, time * 1.25))
    return (disc(0.2 + 0.28 * way, 0.35 + 0.15 * way, 0.06, size) +
            0.6 * disc(0.8 - 0.28 * way, 0.7 - 0.15 * way, 0.05, size))


def time_series(folder, images):
    """A reader of images as time steps 0, 1 ..."""
    files = []
    for image in images:
        files.append(os.path.join(folder, "step-%d.vti" % len(files)))
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(files[-1])
        writer.SetInputData(figures.image_of(image))
        writer.SetDataModeToBinary()  # appended: see Testing/Data/README.md
        writer.Write()
    return simple.XMLImageDataReader(FileName=files)


def at_times(proxy, times):
    """The images of a filter at times."""
    images = []
    for time in times:
        proxy.UpdatePipeline(time)
        data = proxy.GetClientSideObject().GetOutputDataObject(0)
        if data.GetNumberOfPoints() == 0:
            sys.exit(1)  # the filter has said why
        width, height = data.GetDimensions()[:2]
        images.append(vtk_to_numpy(data.GetPointData().GetArray("Values")).reshape(height, width).copy())
    return images


def way(a, b):
    """W2 of two images, each divided by its mass, in pixels, near enough: the cost of the optimal map."""
    morph = simple.MorphDensities(example.producer(figures.image_of(a)),
                                  Target=example.producer(figures.image_of(b)), Method="Optimal")
    found = example.result(morph).GetFieldData().GetArray("TransportCost").GetValue(0) ** 0.5
    simple.Delete(morph)
    return found


def errors(images, truth, left_out):
    """The mean over steps of the relative L2 error, and of W2."""
    squared = [np.linalg.norm(images[i] - truth[i]) / np.linalg.norm(truth[i]) for i in left_out]
    return np.mean(squared), np.mean([way(images[i], truth[i]) for i in left_out])


def panels(images, largest, steps):
    return [figures.grey(figures.bytes_of(1 - (images[i] / largest) ** 0.5)) for i in steps]


def main():
    parser = example.parser(
        __doc__, small="--size 40 --every 12 --panel 96",
        size=128, keep=example.number(10, "every how many steps one is kept", 2),
        every=example.number(3, "every how many steps left out are compared"), panel=176)
    arguments = parser.parse_args()
    example.load_plugin()
    shown = [round(i * (STEPS - 1) / 8) for i in (0, 1, 2, 3, 4)]  # two intervals of ten steps
    rows, results = [], []
    film = []
    for series in (plume, pair):
        truth = [series(i / (STEPS - 1), arguments.size) for i in range(STEPS)]
        kept = truth[::arguments.keep]
        times = np.arange(STEPS) / arguments.keep
        left_out = [i for i in range(STEPS) if i % arguments.keep][::arguments.every]
        left_out = [i for i in left_out if times[i] <= len(kept) - 1]
        with tempfile.TemporaryDirectory() as folder:
            reader = time_series(folder, kept)
            filters = (simple.TransportTemporalInterpolator(reader, DensityArray=["POINTS", "Values"]),
                       simple.TemporalInterpolator(Input=reader))
            images = [at_times(filter_, times) for filter_ in filters]
        largest = max(image.max() for image in truth)
        for words, given in zip(("as it was", *NAMES), (truth, *images)):
            rows.append([("%s, step %d" % (words, i), panel)
                         for i, panel in zip(shown, panels(given, largest, shown))])
        found = [errors(given, truth, left_out) for given in images]
        for name, (squared, distance) in zip(NAMES, found):
            results.append([series.__name__, name, "%.3f" % squared, "%.2f" % distance])
        if series is plume:
            everything = [panels(given, largest, range(STEPS)) for given in (truth, *images)]
            film = [figures.fitted(np.concatenate(frame, axis=1), 3 * arguments.panel) for frame in zip(*everything)]
    figures.table("%d of %d steps kept, %d² pixels: mean errors at those left out" % (
        len(kept), STEPS, arguments.size), ["series", "by", "L2, relative", "W2, pixels"], results)
    path = example.output(arguments, "between-steps")
    figures.montage(path + ".png", rows, arguments.panel)
    video.write_film(path + ".gif", film, 0.12)
    print("%s.png, and the plume as it was, moved and faded: %s.gif" % (path, path))


if __name__ == "__main__":
    main()

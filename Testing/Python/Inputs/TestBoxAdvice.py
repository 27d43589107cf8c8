# SPDX-License-Identifier: BSD-3-Clause
"""Densities in different boxes or planes: the error says with which filter and which numbers they come into
one, and with these there is a result."""
import re
import unittest

import numpy as np
from rt_filters import FILTERS, by_label
from rt_testing import Listener, load_plugin, main, output_of, producer, size_of
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

simple = load_plugin()
NUMBER = r"-?[0-9.]+(?:e[+-]?[0-9]+)?"


def numbers(text, count):
    return [float(number) for number in re.findall(NUMBER, text)][:count]


def blob(centre, shape, cells, origin):
    """A blob around a place in the middle of an image."""
    image = vtkImageData()
    image.SetDimensions(*(n + (1 if cells and n > 1 else 0) for n in shape))
    image.SetOrigin(*origin)
    places = np.stack(np.meshgrid(*(np.arange(n) + (0.5 if cells and n > 1 else 0.0) for n in shape),
                                  indexing="ij"), -1) + origin
    values = np.exp(-((places - centre) ** 2)[..., [n > 1 for n in shape]].sum(-1) / 6)
    array = numpy_to_vtk(values.ravel(order="F"), deep=1)
    array.SetName("Density")
    (image.GetCellData() if cells else image.GetPointData()).AddArray(array)
    return producer(simple, image)


def first_array(source):
    source.UpdatePipeline()
    data = source.GetClientSideObject().GetOutputDataObject(0)
    return ["POINTS" if data.GetPointData().HasArray("Density") else "CELLS", "Density"]


def of_several(filter_, sources):
    return filter_.make(simple, {"densities": lambda: sources}, DensityArray=first_array(sources[0]),
                        DensityResolution=32)


def distance(sources):
    return of_several(by_label("Transport Distance"), sources)


def morph(sources):
    return simple.MorphDensities(Input=sources[0], Target=sources[1], Parameter=0, DensityResolution=32,
                                 DensityArray=first_array(sources[0]),
                                 TargetArray=first_array(sources[1]))


def error_of(proxy):
    listener = Listener(proxy.GetClientSideObject())
    proxy.UpdatePipeline()
    return listener.errors[0]


def found_distance(proxy):
    proxy.UpdatePipeline()
    table = proxy.GetClientSideObject().GetOutputDataObject(0)
    return vtk_to_numpy(table.GetColumn(1))[0]


def slices(centres, heights, axis=2):
    """What Slice cuts out of volumes, at heights."""
    cut = []
    for centre, height in zip(centres, heights):
        volume = blob(np.array(centre), (20, 20, 20), False, (0, 0, 0))
        made = simple.Slice(Input=volume)
        made.SliceType.Normal = np.eye(3)[axis].tolist()
        made.SliceType.Origin = (np.eye(3)[axis] * height).tolist()
        cut.append(made)
    return cut


class Planes(unittest.TestCase):
    def follow(self, sources, message):
        """Transform of each, with its Translate."""
        parts = re.search(r"Transform of each makes it so, with the Translate (.*) and (.*)\)", message)
        moved = []
        for source, text in zip(sources, parts.groups()):
            moved.append(simple.Transform(Input=source))
            moved[-1].Transform.Translate = numbers(text, 3)
        return moved

    def check(self, sources, expected):
        for make in (distance, morph):
            message = error_of(make(sources))
            self.assertIn("must lie in one plane", message)
            moved = self.follow(sources, message)
            if make is distance:
                self.assertLess(abs(found_distance(make(moved)) - expected), 0.1)
            else:
                proxy = make(moved)
                proxy.UpdatePipeline()
                cost = proxy.FieldData["TransportCost"].GetRange()[0]
                self.assertLess(abs(cost ** 0.5 - expected), 0.3)

    def test_flat_images(self):
        for cells in (True, False):
            for axis in range(3):
                shape, origins = [24, 24, 24], np.zeros((2, 3))
                shape[axis] = 1
                origins[:, axis] = 3, -7.25
                centres = np.full((2, 3), 11.0)
                centres[1, (axis + 1) % 3] += 3
                with self.subTest(cells=cells, axis=axis):
                    self.check([blob(centre, shape, cells, origin)
                                for centre, origin in zip(centres, origins)], 3)

    def test_slices_of_volumes(self):
        self.check(slices(((9, 9, 5), (11, 9, 12)), (5, 12)), 2)


class Boxes(unittest.TestCase):
    def follow(self, sources, message):
        """Resample To Image of each."""
        text = message.split("Sampling Dimensions; ")[1]
        bounds, dimensions = text.split(" and ")[:2]
        return [simple.ResampleToImage(Input=source, UseInputBounds=0, SamplingBounds=numbers(bounds, 6),
                                       SamplingDimensions=[int(n) for n in numbers(dimensions, 3)])
                for source in sources]

    def check(self, sources, expected):
        for filter_ in FILTERS:
            if filter_.one_box:
                message = error_of(of_several(filter_, sources))
                self.assertIn("all must fill the same box (Resample To Image of each, ", message)
                resampled = self.follow(sources, message)
                proxy = of_several(filter_, resampled)
                self.assertGreater(size_of(output_of(proxy)), 0, filter_.label)
        self.assertLess(abs(found_distance(distance(resampled)) - expected), 0.1)

    def test_crops(self):
        """Of the same size elsewhere, and of another size; in planes and in space."""
        for cells in (True, False):
            for shape in ((24, 20, 1), (1, 24, 20), (16, 14, 18)):
                real = np.array([n > 1 for n in shape])
                first = np.full(3, 8.0) * real
                for size in (shape, tuple(n + 5 if n > 1 else 1 for n in shape)):
                    origin = np.array([4.0, 3.0, -2.0]) * real
                    with self.subTest(cells=cells, shape=shape, size=size):
                        self.check([blob(first, shape, cells, (0, 0, 0)),
                                    blob(first + 2 * real, size, cells, origin)], 2 * real.sum() ** 0.5)

    def test_crops_of_other_data(self):
        parts = []
        for bounds, centre in (((0, 16), 8.0), ((4, 19), 10.0)):
            volume = blob(np.full(3, centre), (20, 20, 20), False, (0, 0, 0))
            box = simple.Threshold(Input=simple.Elevation(Input=volume, LowPoint=[0, 0, 0], HighPoint=[19, 0, 0],
                                                          ScalarRange=[0, 19]),
                                   Scalars=["POINTS", "Elevation"], LowerThreshold=bounds[0],
                                   UpperThreshold=bounds[1])
            parts.append(box)
        self.check(parts, 2 * 3 ** 0.5)

    def test_surfaces(self):
        """What Solid Density makes of each."""
        balls = [simple.Sphere(Center=[x, 0, 0], ThetaResolution=24, PhiResolution=24) for x in (0, 1.5)]
        message = error_of(simple.TransportDistance(Input=balls, DensityResolution=16))
        solids = self.follow([simple.SolidDensity(ball, Resolution=16) for ball in balls], message)
        self.assertLess(abs(found_distance(distance(solids)) - 1.5), 0.1)


if __name__ == "__main__":
    main()

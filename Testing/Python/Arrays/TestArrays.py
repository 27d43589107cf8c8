# SPDX-License-Identifier: BSD-3-Clause
"""rectifiedtransport.arrays: numpy in, numpy out, with the bits of the filters. Missing data are in
TestArraysMissing.py, errors and warnings in TestArraysErrors.py, triangles and regions in
TestArraysSurfaces.py and TestArraysCartogram.py."""
import gc
import inspect
import pydoc
import subprocess
import sys
import threading
import typing
import unittest
import warnings

import numpy as np
from rt_testing import main, positions
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

import rectifiedtransport
from rectifiedtransport import arrays
from rectifiedtransport.arrays import _data

FUNCTIONS = [name for name in arrays.__all__ if name.islower()]
RNG = np.random.default_rng(5)
FLAT = RNG.random((20, 30)) + 0.1
OTHER = RNG.random((20, 30)) ** 3
SOLID = RNG.random((6, 7, 8)) + 0.1
PLACED = {"spacing": (0.5, 2.0), "origin": (3.0, -1.0)}
SITES = RNG.random((12, 2)) * (14, 38) + (3, -1)
SPOTS = RNG.random((9, 3)) * (7, 6, 5)


def image_of(values, spacing=(1, 1, 1), origin=(0, 0, 0), components=1):
    """The image that a user of VTK would make; a copy."""
    shape = values.shape[:2] if components > 1 else values.shape
    image = vtkImageData()
    image.SetDimensions(*shape[::-1], *[1] * (3 - len(shape)))
    image.SetSpacing(*spacing, *[1] * (3 - len(spacing)))
    image.SetOrigin(*origin, *[0] * (3 - len(origin)))
    rows = np.ascontiguousarray(values).reshape((-1, components) if components > 1 else -1)
    scalars = numpy_to_vtk(rows, deep=1)
    scalars.SetName("Density")
    image.GetPointData().SetScalars(scalars)
    return image


def points_of(rows):
    coordinates = np.zeros((len(rows), 3))
    coordinates[:, :rows.shape[1]] = rows
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(coordinates, deep=1))
    return data


def filtered(name, *inputs, **properties):
    """A filter, run through VTK."""
    algorithm = getattr(rectifiedtransport, name)()
    for port, data in enumerate(inputs):
        for block in data if isinstance(data, list) else [data]:
            algorithm.AddInputDataObject(port, block)
    for key, value in properties.items():
        getattr(algorithm, "Set" + key)(*(value if isinstance(value, tuple) else (value,)))
    algorithm.Update()
    return algorithm


def array_of(data, name):
    return vtk_to_numpy(data.GetArray(name))


def same(found, expected):
    """To the last bit, and of the same type."""
    assert found.dtype == expected.dtype, (found.dtype, expected.dtype)
    np.testing.assert_array_equal(found, expected)


def blob(shape, x, y, radius=6):
    rows, columns = np.mgrid[:shape[0], :shape[1]]
    return np.maximum(radius - np.hypot(rows - y, columns - x), 0) ** 2


class Bits(unittest.TestCase):
    """Each function gives what the filter gives through VTK."""

    def test_sample(self):
        for properties, given in (({}, {}), ({"Method": 1}, {"Method": "Optimal"}),
                                  ({"SeedPattern": 4, "RandomSeed": 7},
                                   {"SeedPattern": "Random", "RandomSeed": 7})):
            with self.subTest(given):
                run = filtered("vtkTransportSampler", image_of(FLAT, **PLACED),
                               NumberOfParticles=300, **properties)
                same(arrays.sample(FLAT, 300, **PLACED, **given),
                     positions(run.GetOutput())[:, :2])
        run = filtered("vtkTransportSampler", image_of(SOLID), NumberOfParticles=100)
        same(arrays.sample(SOLID, 100), positions(run.GetOutput()))

    def test_transport_map(self):
        for density, properties, given in (
                (FLAT, {"Direction": 1}, {"Direction": "DensityToUniform"}),
                (SOLID, {}, {}), (FLAT, {"SampleDimensions": (5, 4, 0)}, {"SampleDimensions": (5, 4, 0)})):
            axes = density.ndim
            with self.subTest(given):
                data = filtered("vtkTransportMap", image_of(density), **properties).GetOutput()
                found = arrays.transport_map(density, **given)
                shape = data.GetDimensions()[axes - 1::-1]
                values = data.GetPointData()
                same(found.displacement,
                     array_of(values, "Displacement").reshape(*shape, 3)[..., :axes])
                same(found.divergence, array_of(values, "Divergence").reshape(shape))
                same(found.determinant, array_of(values, "JacobianDeterminant").reshape(shape))
                self.assertEqual(found.fields["TransportCost"],
                                 data.GetFieldData().GetArray("TransportCost").GetValue(0))
                self.assertEqual(np.shape(found.fields["LargestBlockError"]), (1, 2))

    def test_morph(self):
        for a, b, properties, given in ((FLAT, OTHER, {}, {}), (SOLID, SOLID[::-1], {}, {}),
                                        (FLAT, OTHER[:9], {"Method": 1}, {"Method": "Optimal"})):
            with self.subTest((a.shape, given)):
                run = filtered("vtkTransportInterpolator", image_of(a), image_of(b), Parameter=0.25,
                               **properties)
                expected = array_of(run.GetDensity().GetPointData(), "Density").reshape(a.shape)
                same(arrays.morph(a, b, 0.25, **given), expected)
                series = arrays.morph(a, b, [0, 0.25, 1], **given)
                self.assertEqual(series.shape, (3, *a.shape))
                same(series[1], expected)

    def test_barycenter(self):
        for weights in None, [1, 2, 0.5]:
            with self.subTest(weights):
                run = filtered("vtkTransportBarycenter",
                               [image_of(values) for values in (FLAT, OTHER, FLAT[::-1])])
                for i, weight in enumerate(weights or []):
                    run.SetWeight(i, weight)
                run.Update()
                same(arrays.barycenter([FLAT, OTHER, FLAT[::-1]], weights),
                     vtk_to_numpy(run.GetDensity().GetPointData().GetScalars()).reshape(20, 30))
        same(arrays.barycenter(np.stack([FLAT, OTHER])), arrays.barycenter([FLAT, OTHER], [3, 3]))
        self.assertEqual(arrays.barycenter([SOLID, SOLID[::-1]]).shape, SOLID.shape)
        same(arrays.barycenter([FLAT, OTHER], ResultArrayName="rho"), arrays.barycenter([FLAT, OTHER]))

    def test_distance(self):
        run = filtered("vtkTransportDistance", [image_of(FLAT, **PLACED), image_of(OTHER, **PLACED)],
                       Method=1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = arrays.distance(FLAT, OTHER, **PLACED)
        self.assertEqual(found.lower, run.GetBounds().GetValueByName(0, "LowerBound").ToDouble())
        self.assertEqual(found.upper, run.GetBounds().GetValueByName(0, "UpperBound").ToDouble())

    def test_cells(self):
        for sites, density, placed, properties, given in (
                (SITES, FLAT, PLACED, {"Resolution": 20}, {}),
                (SITES, FLAT, PLACED, {"Resolution": 40, "Shape": 1},
                 {"Resolution": 40, "Shape": "Power"}),
                (SPOTS, SOLID, {}, {"Resolution": 8}, {})):
            axes = density.ndim
            with self.subTest(given):
                run = filtered("vtkEqualMassCells", points_of(sites), image_of(density, **placed),
                               Measure=1, **properties)
                found = arrays.cells(sites, density, **placed, **given)
                shape = [n - 1 for n in run.GetLabels().GetDimensions()[axes - 1::-1]]
                same(found.labels, array_of(run.GetLabels().GetCellData(), "SiteId").reshape(shape))
                figures = run.GetSites().GetPointData()
                same(found.masses, array_of(figures, "CellMass"))
                same(found.centroids, array_of(figures, "CellCentroid")[:, :axes])
                same(found.costs, array_of(figures, "CellCost"))
        self.assertEqual(arrays.cells(SPOTS, SOLID).labels.shape, SOLID.shape)

    def test_relax(self):
        for points, density, placed, properties, given in (
                (SITES, FLAT, PLACED, {}, {}), (SPOTS, SOLID, {}, {}, {}),
                (SITES, FLAT, PLACED, {"Method": 1}, {"Method": "OptimalTransport"})):
            with self.subTest(given):
                run = filtered("vtkBlueNoiseRelaxation", points_of(points),
                               image_of(density, **placed), MaximumIterations=5, **properties)
                same(arrays.relax(points, density, 5, **placed, **given),
                     positions(run.GetOutput())[:, :density.ndim])

    def test_stipple(self):
        colours = (255 * RNG.random((20, 30, 3))).astype(np.uint8)
        for picture, components, properties in (
                (FLAT, 1, {}), (colours, 3, {}), (colours, 3, {"Component": 1})):
            with self.subTest((components, properties)):
                image = image_of(picture, components=components)
                dots = filtered("vtkTransportSampler", image, NumberOfParticles=80, InvertDensity=1,
                                **properties).GetOutput()
                same(arrays.stipple(picture, 80, 0, **properties), positions(dots)[:, :2])
                run = filtered("vtkBlueNoiseRelaxation", dots, image, MaximumIterations=4,
                               InvertDensity=1, **properties)
                same(arrays.stipple(picture, 80, 4, **properties),
                     positions(run.GetOutput())[:, :2])


class Meaning(unittest.TestCase):
    """Axes, units and numbers are what the texts say, whatever the filter is."""

    def test_axes(self):
        for shape in (20, 30), (6, 7, 8):
            density = np.zeros(shape)
            density[(3, 5, 2)[:len(shape)]] = 1
            spacing, origin = (0.5, 2, 3)[:len(shape)], (10, 20, 30)[:len(shape)]
            points = arrays.sample(density, 40, spacing=spacing, origin=origin)
            self.assertEqual(points.shape, (40, len(shape)))
            place = np.array((3, 5, 2)[:len(shape)][::-1])
            middle = origin + place * spacing
            self.assertLessEqual(np.abs((points - middle) / spacing).max(), 0.5 + 1e-9)

    def test_displacement(self):
        """It leads to the density: to the right, where the right half is heavier."""
        density = np.ones((16, 24))
        density[:, 12:] = 3
        moved = arrays.transport_map(density).displacement
        self.assertGreater(moved[..., 0].mean(), 1)
        self.assertLess(np.abs(moved[..., 1]).max(), 0.5)

    def test_masses(self):
        between = arrays.morph(FLAT, 3 * OTHER, [0, 0.5, 1])
        masses = FLAT.sum(), 3 * OTHER.sum()
        np.testing.assert_allclose(between.sum(axis=(1, 2)), [masses[0], sum(masses) / 2, masses[1]])
        found = arrays.cells(SITES, FLAT, **PLACED, Resolution=400, Shape="Power")
        np.testing.assert_allclose(found.masses, FLAT.sum() / len(SITES), rtol=1e-6)

    def test_labels(self):
        density = np.ones((16, 16))
        density[:, :5] = 0
        found = arrays.cells([[7, 3], [12, 3], [7, 12], [12, 12]], density)
        self.assertTrue((found.labels[:, :5] == -1).all())
        np.testing.assert_allclose(found.masses, np.bincount(found.labels[:, 5:].ravel()))

    def test_rows_of_pictures(self):
        """Dots are on the dark pixels, as column and row."""
        for dtype, white in ((np.uint8, 255), (float, 1), (bool, True)):
            with self.subTest(dtype):
                picture = np.full((12, 20), white, dtype)
                picture[2:4, 10:18] = 0
                dots = arrays.stipple(picture, 30, 3)
                self.assertTrue((np.abs(dots - (13.5, 2.5)) <= (4.001, 1.001)).all())
                light = arrays.stipple(picture, 30, 0, invert=False)
                self.assertFalse((np.abs(light - (13.5, 2.5)) < (3.9, 0.9)).all(axis=1).any())

    def test_distance(self):
        """What is moved as a whole is as far apart as it was moved, whatever its mass."""
        a, b = blob((48, 64), 15, 20), blob((48, 64), 45, 28)
        moved = np.hypot(30, 8)
        for scale, spacing, density in (1, 1, b), (1, 0.25, 7 * b), (3, 2, b[:40]):
            with self.subTest((scale, spacing)):
                found = arrays.distance(scale * a, density, spacing=spacing)
                self.assertLessEqual(found.lower, moved * spacing)
                self.assertGreater(found.lower, 0.999 * moved * spacing)
                self.assertGreaterEqual(found.upper, moved * spacing)
                self.assertLess(found.upper, 1.002 * moved * spacing)
        self.assertEqual(arrays.distance(b, a), arrays.distance(a, b))
        self.assertEqual(arrays.distance(a, a), (0, 0))
        self.assertEqual(arrays.Distance._fields, ("lower", "upper"))

    def test_solids_are_apart(self):
        solid = np.zeros((12, 12, 12))
        solid[2:5, 3:6, 2:5] = 1
        found = arrays.distance(solid, np.roll(solid, 5, axis=2))
        self.assertLessEqual(found.lower, 5)
        self.assertGreater(found.lower, 4.9)


class Memory(unittest.TestCase):
    """What is copied, what is not, and that results live on."""

    def scalars(self, values):
        return vtk_to_numpy(_data.image_of(values, "density")[0].GetPointData().GetScalars())

    def test_read_in_place(self):
        for dtype in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"):
            with self.subTest(dtype):
                values = np.ones((4, 5), dtype)
                self.assertTrue(np.shares_memory(self.scalars(values), values))
        values = np.ones((4, 5), bool)
        self.assertTrue(np.shares_memory(self.scalars(values), values))
        values = np.ones((4, 5))
        values.setflags(write=False)
        self.assertTrue(np.shares_memory(self.scalars(values), values))
        for dtype in "f4", "f8":
            points = np.ones((4, 3), dtype)
            self.assertTrue(np.shares_memory(
                vtk_to_numpy(_data.point_set(points, "points", 3).GetPoints().GetData()), points))

    def test_orders_and_types(self):
        """The same numbers give the same points, however they lie in memory; inputs stay as they are."""
        numbers = RNG.integers(1, 100, (20, 30))
        expected = arrays.sample(numbers.astype(float), 60)
        wide = np.zeros((40, 90), np.int32)
        wide[::2, ::3] = numbers
        bytes_ = np.zeros(8 * 600 + 1, np.uint8)
        unaligned = bytes_[1:].view(float).reshape(20, 30)
        unaligned[...] = numbers

        class Other:
            """As those of xarray or of a device."""
            def __array__(self, dtype=None, copy=None):
                return numbers.astype(dtype or float)

        cases = {"list": numbers.tolist(), "Fortran": np.asfortranarray(numbers),
                 "transposed": numbers.T.copy().T, "strided": wide[::2, ::3],
                 "flipped": numbers[::-1, ::-1].copy()[::-1, ::-1], "unaligned": unaligned,
                 "other": Other(), "big-endian": numbers.astype(">f4"),
                 "little-endian": numbers.astype("<i8"), ">i2": numbers.astype(">i2"),
                 **{name: numbers.astype(name) for name in
                    ("float16", "float32", "longdouble", "int8", "uint8", "uint16", "uint64")}}
        for name, values in cases.items():
            with self.subTest(name):
                same(arrays.sample(values, 60), expected)
        same(wide[::2, ::3], numbers.astype(np.int32))
        same(arrays.sample(numbers > 50, 60), arrays.sample((numbers > 50).astype(float), 60))
        points = arrays.sample(numbers, 60)
        relaxed = arrays.relax(points, numbers, 3)
        same(points, expected)
        for name, given in (("list", points.tolist()), ("Fortran", np.asfortranarray(points)),
                            ("twice", np.repeat(points, 2, axis=0)[::2])):
            with self.subTest("points: " + name):
                same(arrays.relax(given, numbers, 3), relaxed)
        same(arrays.relax([[3, 4], [9, 8]], numbers, 3), arrays.relax([[3., 4.], [9., 8.]], numbers, 3))

    def test_texts_that_are_numbers(self):
        """Columns of files, and integers that are too large for numpy's types."""
        expected = arrays.sample(FLAT, 50)
        for kind in ("U", "S", object):
            same(arrays.sample(FLAT.astype(kind), 50), expected)
        same(arrays.sample(FLAT.astype("U").astype(object), 50), expected)
        large = np.array([[10 ** 20, 2 * 10 ** 20], [3 * 10 ** 20, 0]])
        self.assertEqual(large.dtype, object)
        same(arrays.sample(large, 50), arrays.sample(large.astype(float), 50))
        same(arrays.sample([[" 1e2", "3 "], ["+4", ".5"]], 50), arrays.sample([[100, 3], [4, 0.5]], 50))

    def test_results_live_on(self):
        """Later runs and the end of the filter leave results alone."""
        results = [arrays.morph(FLAT, OTHER, t) for t in (0.2, 0.7)]
        results += [arrays.sample(FLAT, 50), arrays.transport_map(FLAT).displacement,
                    arrays.cells(SITES, FLAT, **PLACED).labels]
        copies = [result.copy() for result in results]
        gc.collect()
        arrays.morph(OTHER, FLAT, 0.4)
        arrays.sample(OTHER, 50)
        for result, copy in zip(results, copies):
            same(result, copy)
            result[...] = 0  # their own memory

    def test_threads(self):
        """Python's threads get their own results and errors."""
        expected = [arrays.sample(FLAT, n) for n in range(20, 28)]
        found = [None] * 8

        def run(i):
            try:
                found[i] = arrays.sample(FLAT, 20 + i) if i % 2 else arrays.sample(-FLAT, 9)
            except ValueError as error:
                found[i] = str(error)
        threads = [threading.Thread(target=run, args=(i,)) for i in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i in range(8):
            if i % 2:
                same(found[i], expected[i])
            else:
                self.assertIn("negative", found[i])


class Texts(unittest.TestCase):
    def test_help(self):
        text = pydoc.render_doc(rectifiedtransport, renderer=pydoc.plaintext)
        classes = [name for name in dir(rectifiedtransport) if name.startswith("vtk")
                   and isinstance(getattr(rectifiedtransport, name), type)]
        self.assertGreater(len(classes), 20)
        for name in FUNCTIONS + classes:
            self.assertRegex(text, r"(?m)^ +%s( |$)" % name)

    def test_functions(self):
        """Each argument has a hint and a text; so have units, shapes and errors."""
        self.assertEqual(len(FUNCTIONS), 12)
        for name in FUNCTIONS:
            function = getattr(arrays, name)
            with self.subTest(name):
                hints = typing.get_type_hints(function)
                text = inspect.getdoc(function)
                for argument in inspect.signature(function).parameters:
                    self.assertIn(argument, hints)
                    self.assertRegex(text, r"(?m)^(\w+, )?%s\b" % argument)
                self.assertIn("return", hints)
                for word in "\nReturns ", "\nRaises ":
                    self.assertIn(word, text)
                self.assertRegex(text, r"\[|\(n")

    def test_without_numpy(self):
        """The classes need no numpy, if VTK's own do not; the functions come when they are asked for."""
        code = ("import sys, vtkmodules.vtkCommonDataModel; loaded = 'numpy' in sys.modules; "
                "import rectifiedtransport; assert ('numpy' in sys.modules) == loaded; "
                "rectifiedtransport.arrays.sample([[1, 2], [3, 4]], 5); "
                "assert not hasattr(rectifiedtransport, 'array')")
        subprocess.run([sys.executable, "-c", code], check=True)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""rectifiedtransport.arrays of missing data: masks, columns of pandas, objects and texts."""
import unittest
from decimal import Decimal
from fractions import Fraction

import numpy as np
from rt_testing import main
from TestArrays import OTHER, SITES, same

from rectifiedtransport import arrays
from rectifiedtransport.arrays import _numbers

RNG = np.random.default_rng(6)


class NAType:
    """In place of that of pandas."""


class Column:
    """In place of an array of pandas with a type of its own."""
    dtype = object()

    def __init__(self, values, mask):
        self.values, self.mask = np.asarray(values), np.asarray(mask)

    def isna(self):
        return self.mask

    def to_numpy(self, dtype=None):
        made = self.values.astype(dtype)
        made[self.mask] = NAType()
        return made

    __array__ = None  # with pandas 2, numpy would get NaN and fewer digits


class Missing(unittest.TestCase):
    """A mask is missing data, in the bits of NaN with NaNValues Empty."""
    values = RNG.integers(1, 200, (20, 30))
    mask = RNG.random((20, 30)) < 0.2

    def ways(self, values):
        yield np.ma.array(values, mask=self.mask)
        yield np.ma.array(np.where(self.mask, -1, values), mask=self.mask)
        yield [np.ma.array(row, mask=gaps) for row, gaps in zip(values, self.mask)]
        yield np.where(self.mask, None, values)
        yield np.where(self.mask, NAType(), values)
        yield Column(values, self.mask)
        yield np.ma.array(np.asfortranarray(values), mask=self.mask)

    def test_masks(self):
        for kind in (np.int16, np.uint16, np.int64, np.uint64, np.float32, np.float64):
            values = self.values.astype(kind)
            holes = np.where(self.mask, np.nan, values)
            for properties in ({}, {"InvertDensity": True}):
                expected = arrays.sample(holes, 200, NaNValues="Empty", **properties)
                for way in self.ways(values):
                    with self.subTest(kind=kind, way=type(way)):
                        same(arrays.sample(way, 200, **properties), expected)

    def test_lists_in_lists(self):
        """numpy itself forgets the masks of arrays in lists of lists."""
        values, mask = self.values[:12, :12].reshape(4, 6, 6), self.mask[:12, :12].reshape(4, 6, 6)
        slices = [[np.ma.array(row, mask=gaps) for row, gaps in zip(*pair)] for pair in zip(values, mask)]
        same(arrays.sample(slices, 200), arrays.sample(np.ma.array(values, mask=mask), 200))

    def test_functions(self):
        masked = np.ma.array(self.values, mask=self.mask)
        holes, empty = np.where(self.mask, np.nan, self.values), {"NaNValues": "Empty"}
        other = np.ma.array(OTHER[:12], mask=self.mask[:12])
        zeros = np.ma.filled(other, 0.0)
        same(arrays.morph(masked, other, 0.3), arrays.morph(holes, zeros, 0.3, **empty))
        same(arrays.barycenter([masked, other], [1, 2]),
             arrays.barycenter([holes, zeros], [1, 2], **empty))
        self.assertEqual(arrays.distance(masked, other), arrays.distance(holes, zeros, **empty))
        same(arrays.relax(SITES[:, ::-1], masked, 3), arrays.relax(SITES[:, ::-1], holes, 3, **empty))
        labels = arrays.cells(SITES, masked).labels
        same(labels, arrays.cells(SITES, holes, **empty).labels)
        self.assertTrue((labels[self.mask] == -1).all())
        properties = {"Direction": "DensityToUniform", "EmptyCells": "Mean"}
        same(arrays.transport_map(masked, **properties).displacement,
             arrays.transport_map(holes, **properties, **empty).displacement)

    def test_pictures(self):
        """A pixel is missing where a channel is. White stays 255."""
        picture = np.ma.array(RNG.integers(0, 100, (20, 30, 3)).astype(np.uint8))
        picture[:, :10, 1] = np.ma.masked
        dots = arrays.stipple(picture, 100, 0)
        self.assertGreater(dots[:, 0].min(), 9.5 - 1e-9)
        grey = np.full((20, 30), 250, np.uint8)
        whole = arrays.stipple(grey, 50, 0)
        same(arrays.stipple(np.ma.array(grey, mask=np.zeros((20, 30), bool)), 50, 0), whole)

    def test_objects_and_texts(self):
        """Numbers of other kinds, whole ones with all their digits."""
        large = np.array([[2 ** 53 + 1, 3], [2 ** 63 - 1, 5]])
        with self.subTest("integers"):
            for given in (large.astype(object), large.astype(str), large.astype("S")):
                array, gaps = _numbers.numbers_and_gaps(given, "a")
                same(array, large)
                self.assertIsNone(gaps)
        array, _ = _numbers.numbers_and_gaps([[" 1e3 ", "2"], ["-.5", "18446744073709551615"]], "a")
        same(array, np.array([[1e3, 2], [-0.5, 2.0 ** 64]]))
        array, _ = _numbers.numbers_and_gaps([[Decimal("0.5"), Fraction(1, 4)], [10 ** 30, True]], "a")
        same(array, np.array([[0.5, 0.25], [1e30, 1]]))
        texts = np.ma.array([["1", "none"], ["3", "4"]], mask=[[0, 1], [0, 0]])
        array, gaps = _numbers.numbers_and_gaps(texts, "a")
        same(array, np.array([[1, 0], [3, 4]]))
        same(gaps, np.array([[False, True], [False, False]]))

    def test_pandas(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not installed")
        expected = arrays.sample(np.ma.array(self.values, mask=self.mask), 200)
        frame = pandas.DataFrame(self.values).mask(self.mask)
        for kind in ("Int64", "Float64", object, "string"):
            with self.subTest(kind):
                same(arrays.sample(frame.astype("Int64").astype(kind), 200), expected)
        same(arrays.sample(frame, 200, NaNValues="Empty"), expected)
        self.assertRaises(ValueError, arrays.sample, frame, 200)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""What rectifiedtransport.arrays refuses, and says: errors of filters are exceptions with their text,
warnings are Python's."""
import unittest
import warnings

import numpy as np
from rt_testing import main
from vtkmodules.vtkCommonCore import vtkObject, vtkOutputWindow

from rectifiedtransport import arrays

RNG = np.random.default_rng(5)
FLAT = RNG.random((20, 30)) + 0.1
OTHER = RNG.random((20, 30)) + 0.1
SOLID = RNG.random((6, 7, 8)) + 0.1
SITES = RNG.random((12, 2)) * (29, 19)
SPOTS = RNG.random((9, 3)) * (7, 6, 5)


class Refused(unittest.TestCase):
    def refused(self, error, text, function, *arguments, **properties):
        with self.subTest(text), self.assertRaises(error) as raised, \
                warnings.catch_warnings(record=True):
            function(*arguments, **properties)
        self.assertIn(text, str(raised.exception))

    def calls(self):
        """Every function, of a density alone."""
        yield lambda density: arrays.sample(density, 9), "density"
        yield arrays.transport_map, "density"
        yield lambda density: arrays.morph(density, np.ones((4, 5))), "a"
        yield lambda density: arrays.morph(np.ones((4, 5)), density), "b"
        yield lambda density: arrays.distance(density, np.ones((4, 5))), "a"
        yield lambda density: arrays.barycenter([density, density]), "densit"
        yield lambda density: arrays.cells([[1, 1]], density), "density"
        yield lambda density: arrays.relax([[1, 1]], density), "density"
        yield lambda density: arrays.stipple(density, 9), "image"

    def test_densities(self):
        nan, negative = np.ones((4, 5)), np.ones((4, 5))
        nan[2, 3] = np.nan
        negative[1, 4] = -1
        for function, name in self.calls():
            for error, text, density in (
                    (ValueError, "must have two axes, [y, x], or three, [z, y, x]", np.ones(5)),
                    (ValueError, "must have two axes", np.ones((2, 2, 2, 2))),
                    (ValueError, "must have two axes", 3.0),
                    (ValueError, "no values: its shape is (0, 5)", np.ones((0, 5))),
                    (TypeError, "of type complex128; they must be real", np.ones((4, 5), complex)),
                    (TypeError, "of type <U1; they must be real", np.full((4, 5), "a")),
                    (TypeError, "[0, 1] is 'n/a'", np.array([["1", "n/a"], ["2", "?"]])),
                    (TypeError, "[1, 0] is '1_0'", np.array([["1", "2"], ["1_0", "3"]])),
                    (TypeError, "of type object; they must be real", np.full((4, 5), object())),
                    (TypeError, "of type object; they must be real", np.full((4, 5), print)),
                    (ValueError, "all 20 are missing", np.full((4, 5), None)),
                    (ValueError, "all 20 are missing", np.ma.masked_equal(np.ones((4, 5)), 1)),
                    (ValueError, "[2, 3]", nan), (ValueError, "total mass of zero", np.zeros((4, 5))),
                    (ValueError, "NaN or infinite", np.full((4, 5), np.inf)),
                    (ValueError, "[1, 4]", negative)):
                if name == "image" and density is negative:
                    continue  # InvertDensity: what is less than white is ink
                self.refused(error, text, function, density)
                self.refused(error, name, function, density)

    def test_index_in_any_order(self):
        values = np.asfortranarray(np.ones((4, 5)))
        values[3, 1] = np.nan
        self.refused(ValueError, "density[3, 1]", arrays.sample, values, 9)
        solid = np.ones((4, 5, 6))
        solid[1, 2, 3] = np.nan
        self.refused(ValueError, "density[1, 2, 3]", arrays.sample, solid, 9)

    def test_arguments(self):
        for error, text, function, arguments, properties in (
                (ValueError, "NumberOfParticles is 0", arrays.sample, (FLAT, 0), {}),
                (TypeError, "integer", arrays.sample, (FLAT, 9.5), {}),
                (ValueError, "one point along every axis", arrays.sample, ([[1]], 9), {}),
                (ValueError, "spacing is 0; it must be finite and above 0", arrays.sample, (FLAT, 9),
                 {"spacing": 0}),
                (ValueError, "or 2 in the order x, y", arrays.sample, (FLAT, 9), {"spacing": (1, 2, 3)}),
                (ValueError, "origin is nan", arrays.sample, (FLAT, 9), {"origin": np.nan}),
                (TypeError, "no property 'Steps'; it has AreaTolerance", arrays.sample, (FLAT, 9),
                 {"Steps": 3}),
                (TypeError, "NumberOfParticles is set by the function", arrays.sample, (FLAT, 9),
                 {"NumberOfParticles": 3}),
                (TypeError, "no property 'InputData'", arrays.sample, (FLAT, 9), {"InputData": 3}),
                (ValueError, "Method is 'Best'; it must be Optimal or RectifiedFlow", arrays.sample,
                 (FLAT, 9), {"Method": "Best"}),
                (ValueError, "Integrator is 9; it must be 0 (Multistep)", arrays.sample, (FLAT, 9),
                 {"Integrator": 9}),
                (ValueError, "Parameter is 1.5; it must be from 0 to 1", arrays.morph,
                 (FLAT, OTHER, 1.5), {}),
                (TypeError, "Parameter is set by the function", arrays.morph, (FLAT, OTHER, 0.5),
                 {"Parameter": 0.2}),
                (ValueError, "t has no times", arrays.morph, (FLAT, OTHER, []), {}),
                (ValueError, "as many axes", arrays.morph, (FLAT, SOLID), {}),
                (ValueError, "as many axes", arrays.barycenter, ([FLAT, SOLID],), {}),
                (ValueError, "densities has none", arrays.barycenter, ([],), {}),
                (ValueError, "eight", arrays.barycenter, ([FLAT, OTHER], [1]), {}),
                (ValueError, "eight", arrays.barycenter, ([FLAT, OTHER], [1, 2, 3]), {}),
                (ValueError, "eight", arrays.barycenter, ([FLAT, OTHER], [1, -1]), {}),
                (ValueError, "MassDifference Normalize", arrays.distance, (FLAT, OTHER),
                 {"MassDifference": "Error"}),
                (TypeError, "Method is set by the function", arrays.distance, (FLAT, OTHER),
                 {"Method": "Linearized"}),
                (ValueError, "as many axes", arrays.distance, (FLAT, SOLID), {}),
                (ValueError, "sites has no points", arrays.cells, (np.ones((0, 2)), FLAT), {}),
                (ValueError, "must be (number of points, 2)", arrays.cells, (SPOTS, FLAT), {}),
                (ValueError, "must be (number of points, 3)", arrays.relax, (SITES, SOLID), {}),
                (ValueError, "must be (number of points, 2)", arrays.relax, (np.ones(2), FLAT), {}),
                (ValueError, "NaN or infinite, the first at index 1", arrays.cells,
                 ([[1, 1], [np.nan, 1]], FLAT), {}),
                (ValueError, "mass in 4 of 2 x 2 pixels", arrays.cells, (SITES, np.ones((2, 2))), {}),
                (ValueError, "MaximumIterations is -1", arrays.relax, (SITES, FLAT, -1), {}),
                (TypeError, "has no property 'Method'", arrays.stipple, (FLAT, 9), {"Method": "Optimal"}),
                (ValueError, "Component is -2, but the density array 'image' has 5 components",
                 arrays.stipple, (np.ones((4, 4, 5)), 9), {})):
            self.refused(error, text, function, *arguments, **properties)

    def test_what_may_not_be_missing(self):
        """Weights, times and points; numpy would take what is under a mask."""
        pair = np.ma.array([1.0, 2.0], mask=[False, True])
        for text, function, arguments, properties in (
                ("weights has missing values, the first at weights[1]", arrays.barycenter,
                 ([FLAT, OTHER], pair), {}),
                ("t has missing values", arrays.morph, (FLAT, OTHER, pair / 4), {}),
                ("points has missing values, the first at points[0, 1]", arrays.relax,
                 (np.ma.array([pair, pair]), FLAT), {}),
                ("sites has missing values", arrays.cells, ([[1, None], [3, 4]], FLAT), {}),
                ("it must be a number, or 2", arrays.sample, (FLAT, 9), {"spacing": pair}),
                ("it must be a number, or 2", arrays.sample, (FLAT, 9), {"origin": pair})):
            self.refused(ValueError, text, function, *arguments, **properties)

    def test_memory(self):
        self.refused(MemoryError, "Not enough memory for", arrays.sample, FLAT, 10 ** 15)

    def test_no_points(self):
        self.assertEqual(arrays.relax(np.ones((0, 2)), FLAT).shape, (0, 2))

    def test_missing_values(self):
        values = FLAT.copy()
        values[:, :10] = np.nan
        points = arrays.sample(values, 40, NaNValues="Empty")
        self.assertGreaterEqual(points[:, 0].min(), 9.5)


class Messages(unittest.TestCase):
    def test_warnings(self):
        """They are Python's, at the line of the call."""
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            arrays.relax(SITES + 1000, FLAT, 2)
        self.assertEqual([warning.category for warning in said], [RuntimeWarning])
        self.assertRegex(str(said[0].message), "^12 of 12 points outside the domain")
        self.assertEqual(said[0].filename, __file__)
        with warnings.catch_warnings(), self.assertRaises(RuntimeWarning):
            warnings.simplefilter("error")
            arrays.relax(SITES + 1000, FLAT, 2)

    def test_window(self):
        """VTK's window of messages stays as it is, and gets none."""
        window = vtkOutputWindow.GetInstance()
        mode, shown = window.GetDisplayMode(), []
        observers = [window.AddObserver(event, lambda *_: shown.append(1))
                     for event in ("ErrorEvent", "WarningEvent", "MessageEvent")]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            arrays.relax(SITES + 1000, FLAT, 2)
            self.assertRaises(ValueError, arrays.sample, -FLAT, 9)
        for observer in observers:
            window.RemoveObserver(observer)
        self.assertEqual(shown, [])
        self.assertIs(vtkOutputWindow.GetInstance(), window)
        self.assertEqual(window.GetDisplayMode(), mode)
        self.assertTrue(vtkObject.GetGlobalWarningDisplay())

    def test_without_messages(self):
        """Where a program has turned VTK's messages off, a failure is an exception all the same."""
        vtkObject.GlobalWarningDisplayOff()
        try:
            with self.assertRaises(ValueError) as raised:
                arrays.sample(-FLAT, 9)
        finally:
            vtkObject.GlobalWarningDisplayOn()
        self.assertIn("GlobalWarningDisplayOn", str(raised.exception))


if __name__ == "__main__":
    main()

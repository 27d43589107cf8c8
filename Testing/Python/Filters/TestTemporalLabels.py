# SPDX-License-Identifier: BSD-3-Clause
"""Transport Temporal Interpolator: integers, bits and texts have a value of one of two steps between them,
the one that has most of the mass there."""
import unittest

import numpy as np
from rt_series import Series
from rt_temporal import N, blob, interpolator, values
from rt_testing import Listener, main
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonCore import vtkBitArray, vtkIdTypeArray, vtkStringArray, vtkVariantArray
from vtkmodules.vtkCommonDataModel import vtkDataObject

X, Y = (np.mgrid[0:N, 0:N][::-1] + 0.5)
PLACES = (14.0, 32.0)
TIMES = (0.25, 0.5, 0.75)
FORMS = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8"]


def bits_of(flags):
    array = vtkBitArray()
    for flag in np.ravel(flags):
        array.InsertNextValue(int(flag))
    return array


def texts_of(texts):
    array = vtkStringArray()
    for text in np.ravel(texts):
        array.InsertNextValue(str(text))
    return array


def ids_of(numbers):
    array = vtkIdTypeArray()
    for number in np.ravel(numbers):
        array.InsertNextValue(int(number))
    return array


class Labelled(Series):
    """Other arrays of each step, on points or on cells, which may be VTK's."""

    def __init__(self, densities, others, onto="cells", **properties):
        super().__init__(densities, **properties)
        self.others, self.onto = others, onto

    def image(self, step):
        image = super().image(step)
        owner = image.GetPointData() if self.onto == "points" else image.GetCellData()
        for name, given in self.others[step].items():
            array = given if not isinstance(given, np.ndarray) else numpy_to_vtk(given, deep=1)
            array.SetName(name)
            owner.AddArray(array)
        return image


def moving():
    return [0.01 + blob(x, 24) for x in PLACES]


def between(series, time, **properties):
    algorithm = interpolator(series, **properties)
    listener = Listener(algorithm)
    algorithm.UpdateTimeStep(time)
    assert listener.errors == [], listener.errors
    return algorithm


def array_of(algorithm, name, onto="cells"):
    return algorithm.GetDensity().GetAttributes(
        vtkDataObject.POINT if onto == "points" else vtkDataObject.CELL).GetAbstractArray(name)


class Labels(unittest.TestCase):
    def test_no_label_is_invented(self):
        """Extremes of all types, in bands that stay and in a disk that moves."""
        for form in FORMS:
            low, high = (np.array(bound, form) for bound in (np.iinfo(form).min, np.iinfo(form).max))
            steps = [{"band": np.where(X > 24, high, low).ravel(),
                      "disk": np.where((X - x) ** 2 + (Y - 24) ** 2 < 100, high, high - high // 4).astype(form).ravel()}
                     for x in PLACES]
            series = Labelled(moving(), steps)
            for chain in (0, 1):
                for time in TIMES:
                    algorithm = between(series, time, TrackParticles=chain)
                    for name in ("band", "disk"):
                        with self.subTest(form, name=name, time=time, chain=chain):
                            found = values(algorithm, name)
                            self.assertEqual(found.dtype, np.dtype(form))
                            self.assertLessEqual(set(found.tolist()), set(steps[0][name].tolist()))
                            self.assertEqual(len(set(found.tolist())), 2)

    def test_they_move_with_the_mass(self):
        """A disk of 9 on a ground of 2, on points and cells, goes straight to its place in the next step."""
        for points in (False, True):
            for onto in ("cells", "points"):
                shape = N + (onto == "points" and not points) - (onto == "cells" and points)
                shift = 0.0 if onto == ("points" if points else "cells") else 0.5 if points else -0.5
                y, x = np.mgrid[0:shape, 0:shape] + 0.5 + shift
                steps = [{"owner": np.where((x - c) ** 2 + (y - 24) ** 2 < 64, 9, 2).astype("i4").ravel()}
                         for c in PLACES]
                series = Labelled(moving(), steps, onto=onto, points=points)
                for time in TIMES:
                    with self.subTest(points=points, onto=onto, time=time):
                        owner = vtk_to_numpy(array_of(between(series, time), "owner", onto)).reshape(shape, shape)
                        self.assertEqual(set(owner.ravel()), {2, 9})
                        middle = x[owner == 9].mean(), y[owner == 9].mean()
                        expected = PLACES[0] + time * (PLACES[1] - PLACES[0])
                        self.assertLess(abs(middle[0] - expected), 0.7)
                        self.assertLess(abs(middle[1] - 24), 0.3)
                        self.assertLess(abs((owner == 9).sum() / (np.pi * 64) - 1), 0.15)

    def test_the_step_with_most_of_the_mass(self):
        """Labels of all cells that change alike: those of the nearer step."""
        steps = [{"step": np.full(N * N, step, "i8")} for step in (2 ** 62 + 1, 2 ** 62 + 3)]
        series = Labelled([blob(24, 24)] * 2, steps)
        # In the middle both have as much, and the first one counts.
        for time, step in ((0.1, 0), (0.4, 0), (0.5, 0), (0.6, 1), (0.9, 1)):
            algorithm = between(series, time)
            inside = values(algorithm) > 0.02
            self.assertEqual(set(values(algorithm, "step")[inside]), {2 ** 62 + 1 + 2 * step})

    def test_without_mass_those_at_the_place(self):
        ring = np.where(blob(24, 24) > 0.5, 1.0, 0.0)
        steps = [{"place": (np.arange(N * N) + 10000 * step).astype("u2")} for step in range(2)]
        series = Labelled([ring, ring], steps)
        for time, step in ((0.3, 0), (0.7, 1)):
            found = values(between(series, time), "place")
            empty = blob(24, 24).ravel() == 0  # cells at its border may have some
            np.testing.assert_array_equal(found[empty], steps[step]["place"][empty])

    def test_other_kinds_of_arrays(self):
        """Bits, texts, ids, variants and colours, at and between steps."""
        inside = [(X - x) ** 2 + (Y - 24) ** 2 < 64 for x in PLACES]
        variants = []
        for mask in inside:
            variants.append(vtkVariantArray())
            for flag in mask.ravel():
                variants[-1].InsertNextValue("moved" if flag else 3)
        steps = [{"bits": bits_of(mask), "texts": texts_of(np.where(mask, "moved, and so on", "")),
                  "ids": ids_of(np.where(mask, 2 ** 60 + 1, -1)), "variants": variants[i],
                  "colours": np.where(mask.reshape(-1, 1), [[255, 3, 7]], [[0, 200, 9]]).astype("u1")}
                 for i, mask in enumerate(inside)]
        series = Labelled(moving(), steps)
        for time in (0, *TIMES, 1):
            algorithm = between(series, time)
            given = {name: array_of(algorithm, name) for name in steps[0]}
            with self.subTest(time=time):
                self.assertTrue(all(given.values()), given)
                for name, array in given.items():
                    expected = VTK_UNSIGNED_CHAR if name == "colours" else steps[0][name].GetDataType()
                    self.assertEqual(array.GetDataType(), expected)
                texts = [given["texts"].GetValue(i) for i in range(N * N)]
                self.assertEqual(set(texts), {"", "moved, and so on"})
                where = np.array([text != "" for text in texts])
                self.assertLess(abs(where.sum() / (np.pi * 64) - 1), 0.15)
                # All go the same way.
                np.testing.assert_array_equal([given["bits"].GetValue(i) for i in range(N * N)], where)
                np.testing.assert_array_equal([given["ids"].GetValue(i) for i in range(N * N)],
                                              np.where(where, 2 ** 60 + 1, -1))
                np.testing.assert_array_equal([given["variants"].GetValue(i).ToString() for i in range(N * N)],
                                              np.where(where, "moved", "3"))
                np.testing.assert_array_equal(vtk_to_numpy(given["colours"]),
                                              np.where(where[:, None], [[255, 3, 7]], [[0, 200, 9]]))

    def test_volumes_and_grids_that_differ(self):
        """In space, and between steps of other spacings and places."""
        n = 16
        z, y, x = np.mgrid[0:n, 0:n, 0:n] + 0.5
        density = 0.01 + np.exp(-((x - 8) ** 2 + (y - 8) ** 2 + (z - 8) ** 2) / 12)
        steps = [{"label": np.where(z > 8, 7, 2 ** 63 - 1 - step).ravel()} for step in range(2)]
        series = Labelled([density] * 2, steps, origins=[0.0, 5.0])
        for time, step in ((0.3, 0), (0.7, 1)):
            algorithm = between(series, time)
            found = values(algorithm, "label")
            self.assertEqual(algorithm.GetDensity().GetDimensions(), (22, 17, 17))
            self.assertLessEqual(set(found.tolist()), {7, 2 ** 63 - 1, 2 ** 63 - 2})
            # That of the mass, which is in both steps and moves as one.
            inside = values(algorithm) > 0.2
            self.assertLessEqual(set(found[inside].tolist()), {7, 2 ** 63 - 1 - step})

    def test_threads_change_nothing(self):
        rng = np.random.default_rng(4)
        steps = [{"label": rng.integers(0, 9, N * N)} for _ in range(2)]
        series = Labelled([0.1 + rng.random((N, N)) for _ in range(2)], steps)
        found = [values(between(series, 0.4, Threading=threading), "label") for threading in (2, 3)]
        np.testing.assert_array_equal(*found)


if __name__ == "__main__":
    main()

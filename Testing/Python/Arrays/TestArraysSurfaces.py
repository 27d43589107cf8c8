# SPDX-License-Identifier: BSD-3-Clause
"""rectifiedtransport.arrays on triangles: points inside and on a surface, and what it encloses."""
import unittest
import warnings

import numpy as np
from rt_testing import closed_surface, main, positions
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

import rectifiedtransport
from rectifiedtransport import arrays

# A cube of side 2 about the origin, its triangles seen from outside.
CORNERS = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)])
CUBE = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                 [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]])


def triangulated(data):
    """The data as triangles, and these as arrays."""
    cut = vtkTriangleFilter()
    cut.SetInputData(data)
    cut.PassVertsOff()
    cut.PassLinesOff()
    cut.Update()
    made = cut.GetOutput()
    made.GetPointData().Initialize()
    made.GetCellData().Initialize()
    return made, positions(made), vtk_to_numpy(made.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def run(name, data, **properties):
    algorithm = getattr(rectifiedtransport, name)()
    algorithm.SetInputData(data)
    for key, value in properties.items():
        getattr(algorithm, "Set" + key)(value)
    algorithm.Update()
    return algorithm.GetOutput()


class Surfaces(unittest.TestCase):
    def test_bits_of_the_filters(self):
        data, points, triangles = triangulated(closed_surface())
        np.testing.assert_array_equal(
            arrays.inside(points, triangles, 300, DensityResolution=20, RandomSeed=3),
            positions(run("vtkTransportSampler", data, NumberOfParticles=300, DensityResolution=20,
                          RandomSeed=3)))
        found = arrays.surface_points(points, triangles, 200, RelaxationIterations=3)
        made = run("vtkSurfaceSampler", data, NumberOfParticles=200, RelaxationIterations=3)
        np.testing.assert_array_equal(found.points, positions(made))
        for values, name in ((found.triangles, "CellId"), (found.normals, "Normal")):
            np.testing.assert_array_equal(values, vtk_to_numpy(made.GetPointData().GetArray(name)))
        solid = arrays.solid_density(points, triangles, 20, Padding=0.1)
        image = run("vtkSolidDensity", data, Resolution=20, Padding=0.1)
        np.testing.assert_array_equal(solid.values.reshape(-1), vtk_to_numpy(
            image.GetPointData().GetArray("Density")))
        self.assertEqual(solid.values.shape, image.GetDimensions()[::-1])
        self.assertEqual((solid.spacing, *solid.origin), (image.GetSpacing()[0], *image.GetOrigin()))

    def test_a_cube(self):
        made = arrays.solid_density(2 * CORNERS + [5, 0, 0], CUBE, 22, Padding=0.05)
        self.assertEqual(made.values.shape, (22, 22, 22))
        self.assertAlmostEqual(made.values.sum() * made.spacing ** 3, 64, 9)
        np.testing.assert_allclose(made.origin, [2.9, -2.1, -2.1], atol=1e-9)
        spread = arrays.sample(made.values, 400, spacing=made.spacing, origin=made.origin)
        np.testing.assert_allclose(spread.mean(axis=0), [5, 0, 0], atol=0.05)
        within = arrays.inside(2 * CORNERS + [5, 0, 0], CUBE, 400, DensityResolution=16)
        self.assertEqual((within.shape, within.dtype), ((400, 3), np.float64))
        self.assertLessEqual(abs(within - [5, 0, 0]).max(), 2)
        on = arrays.surface_points(CORNERS, CUBE, 600)
        np.testing.assert_allclose(abs(on.points).max(axis=1), 1, atol=1e-12)
        # A twelfth of them on each triangle, whose normal they have.
        self.assertLess(np.ptp(np.bincount(on.triangles, minlength=12)), 12)
        corners = CORNERS[CUBE]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 4
        np.testing.assert_allclose(on.normals, normals[on.triangles], atol=1e-12)

    def test_types(self):
        """Single precision and lists are points; integers of any size are numbers of points."""
        expected = arrays.inside(CORNERS.astype(float), CUBE, 50, DensityResolution=8)
        for points, triangles in ((CORNERS.astype(np.float32), CUBE.astype(np.uint8)),
                                  (CORNERS.tolist(), CUBE.tolist()), (CORNERS, np.asfortranarray(CUBE))):
            np.testing.assert_array_equal(
                arrays.inside(points, triangles, 50, DensityResolution=8), expected)

    def test_refused(self):
        for error, text, function, triangles, properties in (
                (ValueError, "3 open edges", arrays.inside, CUBE[1:], {}),
                (ValueError, "Sample Surface", arrays.inside, CUBE[1:], {}),
                (ValueError, "3 open edges", arrays.solid_density, CUBE[1:], {}),
                (ValueError, "triangles has none", arrays.inside, np.empty((0, 3), int), {}),
                (ValueError, "lie in one plane", arrays.inside, CUBE[:2], {}),
                (ValueError, "triangles[0, 1] is 8; there are 8 points", arrays.inside, [[0, 8, 1]], {}),
                (ValueError, "triangles[1, 0] is -1", arrays.surface_points, [[0, 2, 1], [-1, 2, 3]], {}),
                (ValueError, "triangles has the shape (3,)", arrays.solid_density, [0, 2, 1], {}),
                (TypeError, "they must be integers", arrays.inside, CUBE.astype(float), {}),
                (TypeError, "has no property 'Resolution'", arrays.inside, CUBE, {"Resolution": 8}),
                (TypeError, "set by the function itself", arrays.solid_density, CUBE, {"Resolution": 8}),
                (ValueError, "NumberOfParticles is 0", lambda *given: arrays.inside(*given[:2], 0), CUBE, {})):
            with self.subTest(text), self.assertRaises(error) as raised, \
                    warnings.catch_warnings(record=True):
                function(CORNERS, triangles, 8, **properties)
            self.assertIn(text, str(raised.exception))
        for function in (arrays.inside, arrays.surface_points, arrays.solid_density):
            with self.assertRaises(ValueError) as raised:
                function(np.ones((8, 2)), CUBE, 8)
            self.assertIn("(number of points, 3), rows of x, y and z", str(raised.exception))
            points = CORNERS.astype(float)
            points[3, 1] = np.nan
            with self.assertRaises(ValueError):
                function(points, CUBE, 8)

    def test_a_hole(self):
        """By a density of its winding number, as the error says."""
        made = arrays.solid_density(CORNERS, CUBE[1:], 20, OpenSurfaces="WindingNumber")
        points = arrays.sample(made.values, 100, spacing=made.spacing, origin=made.origin)
        self.assertLess(abs(points).max(), 1.1)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Transport Map in ParaView: its arrays are found by other filters, its image by the panel."""
import os
import unittest

import numpy as np
from rt_testing import (OUTPUT, SOURCE, Listener, density_image, load_plugin, main, output_of,
                        producer)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray

simple = load_plugin()


def cell_array(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))


class Map(unittest.TestCase):
    def setUp(self):
        simple.ResetSession()

    def map(self, image=None, **properties):
        return simple.TransportMap(Input=producer(simple, image or density_image()), **properties)

    def test_defaults(self):
        transport = self.map()
        self.assertEqual(transport.Direction, "UniformToDensity")
        self.assertEqual(list(transport.SampleDimensions), [0, 0, 0])
        self.assertEqual(list(transport.DensityArray), ["CELLS", "Density"])
        self.assertEqual(list(transport.GetProperty("Direction").GetAvailable()),
                         ["UniformToDensity", "DensityToUniform"])

    def test_information(self):
        transport = self.map(SampleDimensions=[6, 20, 1])
        transport.UpdatePipeline()
        known = transport.GetDataInformation()
        self.assertEqual(list(known.GetExtent()), [0, 6, 0, 20, 0, 0])
        np.testing.assert_allclose(known.GetBounds(), [0, 6, 0, 20, 0, 0])
        self.assertEqual(set(transport.CellData.keys()),
                         {"Displacement", "Divergence", "JacobianDeterminant"})
        self.assertEqual(transport.FieldData["TotalMass"].GetNumberOfComponents(), 1)
        self.assertGreater(transport.FieldData["TransportCost"].GetRange()[0], 0)

    def test_directions(self):
        transport = self.map()
        there = cell_array(output_of(transport), "Displacement").copy()
        transport.Direction = "DensityToUniform"
        back = cell_array(output_of(transport), "Displacement")
        # Not inverse at one and the same point, but against each other.
        self.assertLess((there * back).sum(), -0.5 * (there * there).sum())

    def test_target(self):
        """Where two fields differ: the input is optional, and can be taken away again."""
        transport = self.map()
        alone = cell_array(output_of(transport), "Displacement").copy()
        self.assertIsNone(transport.Target)
        transport.Target = producer(simple, density_image(values=np.arange(1.0, 121.0)))
        transport.UpdatePipeline()
        self.assertEqual(list(transport.TargetArray), ["CELLS", "Density"])
        self.assertEqual(set(transport.CellData.keys()) - {"Density"},
                         {"Displacement", "Divergence", "JacobianDeterminant", "CostDensity"})
        output = output_of(transport)
        costs = cell_array(output, "CostDensity")
        cost = transport.FieldData["TransportCost"].GetRange()[0]
        np.testing.assert_allclose(costs.sum(), cost, rtol=1e-12)
        shares = cell_array(output, "Density") / cell_array(output, "Density").sum()
        squares = (cell_array(output, "Displacement") ** 2).sum(axis=1)
        np.testing.assert_allclose(costs, shares * squares, atol=1e-9 * cost)
        transport.Target = None
        np.testing.assert_array_equal(cell_array(output_of(transport), "Displacement"), alone)
        self.assertEqual(set(transport.CellData.keys()) & {"CostDensity"}, set())

    def test_arrays_of_one_target(self):
        """Two arrays of one data set: the density before and after."""
        image = density_image()
        after = vtkDoubleArray()
        after.SetName("After")
        for i in range(image.GetNumberOfCells()):
            after.InsertNextValue(1.0 + i % 5)
        image.GetCellData().AddArray(after)
        data = producer(simple, image)
        transport = simple.TransportMap(Input=data, Target=data, TargetArray=["CELLS", "After"])
        ways = cell_array(output_of(transport), "Displacement").copy()
        self.assertEqual(list(transport.DensityArray), ["CELLS", "Density"])
        other = density_image()
        other.GetCellData().SetScalars(after)
        other.GetCellData().RemoveArray("Density")
        apart = self.map()
        apart.Target = producer(simple, other)
        np.testing.assert_array_equal(cell_array(output_of(apart), "Displacement"), ways)

    def test_bad_target(self):
        transport = self.map()
        transport.Target = producer(simple, density_image((6, 5, 4)))
        reported = Listener(transport.GetClientSideObject())
        transport.UpdatePipeline()
        self.assertIn("Source has the axes x and y, Target has the axes x and y and z", reported.errors[0])

    def test_warp_by_vector_finds_the_displacement(self):
        points = density_image((12, 10), cells=False)
        transport = self.map(points)
        transport.UpdatePipeline()
        warped = output_of(simple.WarpByVector(Input=transport))
        moved = np.array([warped.GetPoint(i) for i in range(warped.GetNumberOfPoints())])
        start = np.array([points.GetPoint(i) for i in range(points.GetNumberOfPoints())])
        displacement = vtk_to_numpy(
            output_of(transport).GetPointData().GetArray("Displacement"))
        self.assertGreater(np.abs(displacement).max(), 0)
        np.testing.assert_allclose(moved, start + displacement, atol=1e-5)

    def test_contour_of_the_determinant(self):
        transport = self.map(density_image((12, 10), cells=False))
        contour = simple.Contour(Input=transport, ContourBy=["POINTS", "JacobianDeterminant"],
                                 Isosurfaces=[1.0])
        self.assertGreater(output_of(contour).GetNumberOfCells(), 0)

    def test_scaled_spacing(self):
        image = density_image()
        unit = output_of(self.map(image))
        wide = density_image()
        wide.SetSpacing(5, 20, 1)
        scaled = output_of(self.map(wide))
        np.testing.assert_allclose(cell_array(scaled, "Displacement"),
                                   10 * cell_array(unit, "Displacement"), rtol=1e-12)
        np.testing.assert_array_equal(cell_array(scaled, "JacobianDeterminant"),
                                      cell_array(unit, "JacobianDeterminant"))

    def test_error(self):
        transport = self.map(SampleDimensions=[4, 4, 4])
        reported = Listener(transport.GetClientSideObject())
        result = output_of(transport)
        self.assertEqual(result.GetClassName(), "vtkImageData")
        self.assertEqual(result.GetNumberOfPoints(), 0)
        self.assertIn("SampleDimensions is 4 4 4; it must be 0 or 1 along z", reported.errors[0])
        transport.SampleDimensions = [4, 4, 1]
        self.assertEqual(output_of(transport).GetNumberOfCells(), 16)

    def test_state(self):
        photograph = simple.PNGSeriesReader(
            FileNames=[os.path.join(SOURCE, "Testing", "Data", "ascent.png")])
        transport = simple.TransportMap(Input=photograph, Direction="DensityToUniform",
                                        SampleDimensions=[30, 40, 1])
        expected = output_of(transport).GetPointData().GetArray("Displacement").GetRange(-1)
        path = os.path.join(OUTPUT, "map.pvsm")
        simple.SaveState(path)
        simple.ResetSession()
        simple.LoadState(path)
        found = [source for source in simple.GetSources().values()
                 if source.GetXMLName() == "TransportMap"]
        self.assertEqual(len(found), 1)
        self.assertEqual(found[0].Direction, "DensityToUniform")
        self.assertEqual(list(found[0].SampleDimensions), [30, 40, 1])
        displacement = output_of(found[0]).GetPointData().GetArray("Displacement")
        self.assertEqual(displacement.GetRange(-1), expected)


if __name__ == "__main__":
    main()

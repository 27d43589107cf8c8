# SPDX-License-Identifier: BSD-3-Clause
"""Equal-Mass Cells in ParaView: cells at the resolution of the paper, and the cost of exact ones."""
import unittest

import numpy as np
from rt_testing import density_image, load_plugin, main, output_of, producer
from scipy.optimize import linear_sum_assignment
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

simple = load_plugin()


def sites_at(coordinates):
    """A source of sites, given as rows of x and y."""
    points = vtkPoints()
    flat = np.c_[coordinates, np.zeros(len(coordinates))]
    points.SetData(numpy_to_vtk(flat, deep=1))
    data = vtkPolyData()
    data.SetPoints(points)
    return producer(simple, data)


def unit_square():
    image = vtkImageData()
    image.SetDimensions(2, 2, 1)
    return producer(simple, image)


def disc(count, seed):
    random = np.random.default_rng(seed)
    angle, radius = 2 * np.pi * random.random(count), 0.4 * np.sqrt(random.random(count))
    return np.c_[0.5 + radius * np.cos(angle), 0.5 + radius * np.sin(angle)]


def labels_of(cells):
    return vtk_to_numpy(output_of(cells).GetCellData().GetArray("SiteId"))


def cost_of(cells):
    return output_of(cells).GetFieldData().GetArray("TransportCost").GetValue(0)


class Cells(unittest.TestCase):
    def check_cells_of_the_paper(self, sites):
        """1024 sites at 1024 x 1024: all pixels have a label, and all sites the same mass."""
        cells = simple.EqualMassCells(Input=sites_at(sites), Domain=unit_square(), Resolution=1024)
        counts = np.bincount(labels_of(cells), minlength=len(sites))
        self.assertEqual(len(counts), 1024)
        self.assertEqual(counts.sum(), 1024 ** 2)
        np.testing.assert_array_equal(counts, 1024)
        data = cells.GetClientSideObject().GetOutputDataObject(1).GetPointData()
        np.testing.assert_allclose(vtk_to_numpy(data.GetArray("CellMass")), 1 / 1024)
        self.assertAlmostEqual(vtk_to_numpy(data.GetArray("CellCost")).sum(), cost_of(cells))

    def test_random_sites(self):
        self.check_cells_of_the_paper(np.random.default_rng(1).random((1024, 2)))

    def test_sites_on_a_disc(self):
        self.check_cells_of_the_paper(disc(1024, 2))

    def test_cost_of_exact_assignment(self):
        """64 sites of 16 pixels each at 32 x 32: the cost is above the least one, but not far."""
        centres = (np.stack(np.meshgrid(np.arange(32), np.arange(32)), -1).reshape(-1, 2) + .5) / 32
        for name, sites in (("random", np.random.default_rng(3).random((64, 2))),
                            ("disc", disc(64, 4))):
            cells = simple.EqualMassCells(Input=sites_at(sites), Domain=unit_square(),
                                          Resolution=32)
            for p, q in ((2, 2), (4, 4), (2, 4), (4, 1.6)):
                cells.NormExponent, cells.CostExponent = p, q
                found = cost_of(cells)
                distances = np.linalg.norm(centres[:, None] - sites[None], ord=p, axis=2) ** q
                repeated = np.repeat(distances, 16, axis=1)
                least = repeated[linear_sum_assignment(repeated)].mean()
                print("%s, W_%g^%g: %.3f of the least cost" % (name, p, q, found / least))
                self.assertGreaterEqual(found, least * (1 - 1e-12))
                self.assertLess(found, (1.35 if q < 4 else 1.8) * least)
                np.testing.assert_array_equal(np.bincount(labels_of(cells)), 16)
                self.assertAlmostEqual(
                    found, distances[np.arange(1024), labels_of(cells)].mean())

    def test_power_cells_cost_least(self):
        """Shape Power: equal areas, below the cost of the exact assignment of whole pixels."""
        centres = (np.stack(np.meshgrid(np.arange(32), np.arange(32)), -1).reshape(-1, 2) + .5) / 32
        for sites in (np.random.default_rng(3).random((64, 2)), disc(64, 4)):
            cells = simple.EqualMassCells(Input=sites_at(sites), Domain=unit_square(),
                                          Resolution=32, Shape="Power")
            found = cost_of(cells)
            distances = ((centres[:, None] - sites[None]) ** 2).sum(axis=2)
            repeated = np.repeat(distances, 16, axis=1)
            whole = repeated[linear_sum_assignment(repeated)].mean() + 2 / 12 / 32 ** 2
            self.assertLess(found, whole)
            self.assertGreater(found, 0.97 * whole)
            data = cells.GetClientSideObject().GetOutputDataObject(1).GetPointData()
            masses = vtk_to_numpy(data.GetArray("CellMass"))
            np.testing.assert_allclose(masses, 1 / 64, rtol=1e-6)
            self.assertAlmostEqual(vtk_to_numpy(data.GetArray("CellCost")).sum(), found)
            # There are weights that explain the labels: no cycle of exchanges of pixels between
            # cells gains anything.
            labels = labels_of(cells)
            bounds = np.full((64, 64), np.inf)
            for i in range(64):
                bounds[i] = (distances[labels == i] - distances[labels == i][:, [i]]).min(
                    axis=0, initial=np.inf)
            for k in range(64):  # shortest paths
                bounds = np.minimum(bounds, bounds[:, [k]] + bounds[[k], :])
            self.assertGreater(bounds.diagonal().min(), -1e-12)

    def test_domain_is_optional_and_can_be_taken_away(self):
        cells = simple.EqualMassCells(Input=sites_at(disc(20, 5)), Resolution=40)
        self.assertIsNotNone(
            cells.GetProperty("Domain").SMProperty.GetHints().FindNestedElementByName("Optional"))
        own = output_of(cells).GetBounds()
        self.assertLess(own[1], 0.95)
        cells.Domain = producer(simple, density_image((4, 3)))
        self.assertEqual(output_of(cells).GetBounds(), (0, 2, 0, 6, 0, 0))
        cells.Domain = None
        self.assertEqual(output_of(cells).GetBounds(), own)

    def test_ports(self):
        cells = simple.EqualMassCells(Input=sites_at(disc(20, 5)), Resolution=40)
        names = [cells.SMProxy.GetOutputPortName(i) for i in range(3)]
        self.assertEqual(names, ["Labels", "Sites", "Outlines"])
        cell_bounds = simple.Threshold(Input=simple.OutputPort(cells, 2),
                                       Scalars=["CELLS", "SiteId"], LowerThreshold=3,
                                       UpperThreshold=3)
        self.assertGreater(output_of(cell_bounds).GetNumberOfCells(), 10)


if __name__ == "__main__":
    main()

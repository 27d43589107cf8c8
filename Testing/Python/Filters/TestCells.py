# SPDX-License-Identifier: BSD-3-Clause
"""Equal Mass Cells in ParaView: cells at the resolution of the paper, and the cost of exact ones."""
import unittest

import numpy as np
import rectifiedtransport as rt
from rt_testing import (Listener, density_image, load_plugin, main, output_of, points_in,
                        producer)
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
        names = [cells.SMProxy.GetOutputPortName(i) for i in range(4)]
        self.assertEqual(names, ["Labels", "Sites", "Outlines", "Polygons"])
        cell_bounds = simple.Threshold(Input=simple.OutputPort(cells, 2),
                                       Scalars=["CELLS", "SiteId"], LowerThreshold=3,
                                       UpperThreshold=3)
        self.assertGreater(output_of(cell_bounds).GetNumberOfCells(), 10)


class Mass(unittest.TestCase):
    """Measure Density."""

    def cells(self, image, count=60, **properties):
        return simple.EqualMassCells(
            Input=producer(simple, points_in(image, count)), Domain=producer(simple, image),
            Measure="Density", **properties)

    def statistics(self, cells):
        cells.UpdatePipeline()
        data = cells.GetClientSideObject().GetOutputDataObject(1).GetPointData()
        return [vtk_to_numpy(data.GetArray(name))
                for name in ("CellMass", "CellCentroid", "CellCost")]

    def check_flow(self, shape, values, count):
        """A pixel a cell of the density: sums over the labels are what the sites have, and no share
        is off by more than the heaviest pixel."""
        image = density_image(shape, values=values.ravel())
        image.SetSpacing(1, 1, 1)
        cells = self.cells(image, count, Resolution=max(shape))
        labels = labels_of(cells)
        self.assertEqual(len(labels), values.size)
        np.testing.assert_array_equal(labels < 0, values.ravel() == 0)
        labels = np.maximum(labels, 0)
        sums = np.bincount(labels, values.ravel(), count)
        self.assertLessEqual(np.abs(sums - values.sum() / count).max(), values.max())
        masses, centroids, costs = self.statistics(cells)
        np.testing.assert_allclose(masses, sums, rtol=1e-12)
        axes = np.meshgrid(*(np.arange(n) + .5 for n in shape[::-1]), indexing="ij")
        centres = np.zeros((values.size, 3))
        for axis, coordinates in enumerate(axes[::-1]):
            centres[:, axis] = coordinates.ravel()
        sites = vtk_to_numpy(points_in(image, count).GetPoints().GetData())
        squares = ((centres - sites[labels]) ** 2).sum(axis=1) * values.ravel() / values.sum()
        np.testing.assert_allclose(costs, np.bincount(labels, squares, count), rtol=1e-9)
        self.assertAlmostEqual(cost_of(cells), squares.sum())
        for axis in range(3):
            np.testing.assert_allclose(
                centroids[:, axis],
                np.bincount(labels, values.ravel() * centres[:, axis], count) / sums, atol=1e-9)

    def test_flow_in_a_plane(self):
        x, y = np.meshgrid(np.linspace(-1, 1, 90), np.linspace(-1, 1, 70))
        self.check_flow((90, 70), np.exp(-8 * (x ** 2 + (y - .3) ** 2)) + .02, 80)
        self.check_flow((90, 70), np.random.default_rng(6).random((70, 90)) ** 4, 150)
        self.check_flow((90, 70), (x ** 2 + y ** 2 < .5) * 1., 50)

    def test_flow_in_space(self):
        z, y, x = np.meshgrid(*(np.linspace(-1, 1, n) for n in (20, 22, 26)), indexing="ij")
        self.check_flow((26, 22, 20), np.exp(-4 * (x ** 2 + (y - .3) ** 2 + z ** 2)), 40)

    def test_flow_on_a_line(self):
        self.check_flow((300,), np.random.default_rng(6).random(300), 20)

    def test_power(self):
        """Exactly equal masses at a cost below that of the flow, by three figures: the field data,
        the sum over the sites, and the sum over fine pixels."""
        x, y = np.meshgrid(np.linspace(-1, 1, 60), np.linspace(-1, 1, 45))
        values = np.exp(-6 * (x ** 2 + (y - .3) ** 2)) + .02
        image = density_image((60, 45), values=values.ravel())
        image.SetSpacing(1, 1, 1)
        cells = self.cells(image, 70, Resolution=600, Shape="Power")
        masses, _, costs = self.statistics(cells)
        np.testing.assert_allclose(masses, values.sum() / 70, rtol=1e-6)
        self.assertAlmostEqual(costs.sum(), cost_of(cells))
        labels = labels_of(cells).reshape(450, 600)
        fine = np.kron(values, np.ones((10, 10))) / values.sum() / 100
        centres = np.stack(np.meshgrid((np.arange(600) + .5) / 10, (np.arange(450) + .5) / 10), -1)
        sites = vtk_to_numpy(points_in(image, 70).GetPoints().GetData())[:, :2]
        by_pixels = (((centres - sites[labels]) ** 2).sum(axis=-1) * fine).sum()
        self.assertLess(abs(by_pixels / cost_of(cells) - 1), 2e-3)
        least = cost_of(cells)
        cells.Shape = "Flow"
        cells.Resolution = 300
        self.assertGreater(cost_of(cells), 1.01 * least)

    def test_the_sea(self):
        """Pixels without mass are of no site, hidden, and outside of the polygons and outlines."""
        x, y = np.meshgrid(np.linspace(-1, 1, 60), np.linspace(-1, 1, 45))
        radius = np.hypot(x, y * .75)
        values = ((radius < .6) & (radius > .2)) * (1.5 + x)
        image = density_image((60, 45), values=values.ravel())
        image.SetSpacing(1, 1, 1)
        sea = values.ravel() == 0
        for shape in ("Flow", "Power"):
            cells = self.cells(image, 12, Resolution=60, Shape=shape)
            labels = labels_of(cells)
            self.assertEqual(labels[~sea].min(), 0)
            np.testing.assert_array_equal(labels == -1, sea)
            outputs = [cells.GetClientSideObject().GetOutputDataObject(i) for i in range(4)]
            hidden = vtk_to_numpy(outputs[0].GetCellData().GetArray("vtkGhostType"))
            np.testing.assert_array_equal(hidden, 32 * sea)  # HIDDENCELL
            colours = vtk_to_numpy(outputs[0].GetCellData().GetArray("SiteColor"))
            self.assertLess(colours.max(), 9)
            self.assertEqual(colours[sea].max(), 0)
            surface = simple.ExtractSurface(Input=cells)
            self.assertEqual(output_of(surface).GetNumberOfCells(), (~sea).sum())
            # CellSize takes polygons for convex.
            areas = simple.CellSize(Input=simple.Triangulate(Input=simple.OutputPort(cells, 3)))
            areas = vtk_to_numpy(output_of(areas).GetCellData().GetArray("Area")).sum()
            self.assertAlmostEqual(areas, (~sea).sum() if shape == "Flow" else sea.size, 6)
            masses = self.statistics(cells)[0]
            self.assertAlmostEqual(masses.sum(), values.sum())
            of_polygons = outputs[3].GetCellData()
            ids = vtk_to_numpy(of_polygons.GetArray("SiteId"))
            np.testing.assert_array_equal(vtk_to_numpy(of_polygons.GetArray("CellMass")),
                                          masses[ids])

    def test_a_constant_density_is_uniform(self):
        """Power: the same polygons to the accuracy of their masses. Flow: the same but for pixels
        on borders, which are given away in another order, 3 % of all."""
        image = density_image((40, 30), values=np.full(1200, 7.0))
        for shape in ("Power", "Flow"):
            cells = self.cells(image, 30, Resolution=200, Shape=shape)
            by_mass, cost = labels_of(cells).copy(), cost_of(cells)
            masses = self.statistics(cells)[0].copy()
            cells.Measure = "Uniform"
            np.testing.assert_allclose(masses, 7 * self.statistics(cells)[0],
                                       rtol=1e-6 if shape == "Power" else 3e-3)
            self.assertLess((by_mass != labels_of(cells)).mean(),
                            1e-4 if shape == "Power" else .03)
            self.assertLess(abs(cost_of(cells) / cost - 1), 1e-6 if shape == "Power" else 1e-2)

    def test_properties_of_the_density(self):
        """The array, a component and ink are those of the other filters."""
        values = np.random.default_rng(1).integers(0, 200, (1200, 3)).astype(np.uint8)
        image = density_image((40, 30), values=values)
        image.SetSpacing(1, 1, 1)
        other = numpy_to_vtk(np.arange(1200.), deep=1)
        other.SetName("Other")
        image.GetCellData().AddArray(other)
        cells = self.cells(image, 20, Resolution=40)
        luminance = values @ [.2126, .7152, .0722]
        for properties, density in (
                ({"DensityArray": ["CELLS", "Density"]}, luminance),
                ({"InvertDensity": 1}, 255 - luminance),
                ({"InvertDensity": 0, "Component": 2}, values[:, 2]),
                ({"DensityArray": ["CELLS", "Other"], "Component": -1}, np.arange(1200.))):
            for name, value in properties.items():
                setattr(cells, name, value)
            self.assertAlmostEqual(self.statistics(cells)[0].sum() / density.sum(), 1)
            np.testing.assert_allclose(np.bincount(np.maximum(labels_of(cells), 0), density, 20),
                                       self.statistics(cells)[0], rtol=1e-9)

    def test_values_on_points(self):
        """Their cells reach half a spacing further, as in every density."""
        image = density_image((40, 30), cells=False)
        cells = self.cells(image, 20, Resolution=40)
        self.assertEqual(output_of(cells).GetBounds(), (-.25, 19.75, -1, 59, 0, 0))

    def test_a_mesh(self):
        """A density of any other data: the mass is that of the mesh."""
        wavelet = simple.Tetrahedralize(Input=simple.Wavelet())
        mass = simple.IntegrateVariables(Input=wavelet)
        mass = vtk_to_numpy(output_of(mass).GetPointData().GetArray("RTData"))[0]
        sites = simple.UniformSeeds(Dimension=3, Bounds=[-10, 10] * 3, NumberOfPoints=20)
        for source in (wavelet, sites):
            source.UpdatePipeline()
        cells = simple.EqualMassCells(Input=sites, Domain=wavelet, Measure="Density",
                                      Resolution=24, DensityResolution=16)
        masses = self.statistics(cells)[0]
        self.assertLess(abs(masses.sum() / mass - 1), .005)
        self.assertLess(np.ptp(masses) / masses.mean(), .03)

    def test_automatic_resolution(self):
        """512 pixels in a plane, 64 in space; a warning of many before they are made."""
        flat = rt.vtkEqualMassCells()
        flat.SetInputData(points_in(density_image((40, 30)), 20))
        flat.SetShapeToPower()
        flat.Update()
        self.assertEqual(max(flat.GetLabels().GetDimensions()), 513)
        solid = rt.vtkEqualMassCells()
        solid.SetInputData(points_in(density_image((5, 5, 5)), 20))
        solid.Update()
        self.assertEqual(max(solid.GetLabels().GetDimensions()), 65)
        flat.SetResolution(5500)
        reported = Listener(flat)
        flat.Update()
        self.assertEqual(len(reported.warnings), 1)
        self.assertRegex(reported.warnings[0], "pixels take about .* MB; a lower Resolution")

    def test_labels_are_kept(self):
        """Costs of another exponent need no flow; another density does, also one that is written
        in place."""
        for shape in (0, 1):
            image = density_image((40, 30))
            image.SetSpacing(1, 1, 1)
            cells = rt.vtkEqualMassCells()
            cells.SetInputData(points_in(image, 20))
            cells.SetDomainData(image)
            cells.SetMeasureToDensity()
            cells.SetResolution(60)
            cells.SetShape(shape)

            def array():
                cells.Update()
                return cells.GetLabels().GetCellData().GetArray("SiteId")

            first = array()
            masses = vtk_to_numpy(cells.GetSites().GetPointData().GetArray("CellMass")).copy()
            if shape == 0:
                cells.SetCostExponent(1)
                self.assertIs(array(), first)
            cells.Modified()
            self.assertIs(array(), first)
            np.testing.assert_array_equal(
                vtk_to_numpy(cells.GetSites().GetPointData().GetArray("CellMass")), masses)
            cells.SetInvertDensity(1)
            self.assertIsNot(array(), first)
            cells.SetInvertDensity(0)
            first = vtk_to_numpy(array()).copy()
            vtk_to_numpy(image.GetCellData().GetScalars())[:600] *= 4
            image.Modified()
            self.assertGreater((vtk_to_numpy(array()) != first).mean(), .05)

    def refused(self, text, image, count=9, sites=None, **properties):
        """One error, all of whose words are in it, and empty outputs."""
        cells = rt.vtkEqualMassCells()
        cells.SetInputData(sites or points_in(image, count))
        if image:
            cells.SetDomainData(image)
        cells.SetMeasureToDensity()
        cells.SetResolution(24)
        for name, value in properties.items():
            getattr(cells, "Set" + name)(value)
        reported = Listener(cells)
        cells.Update()
        self.assertEqual(len(reported.errors), 1)
        for part in text if isinstance(text, tuple) else (text,):
            self.assertIn(part, reported.errors[0])
        for port in range(4):
            self.assertEqual(cells.GetOutputDataObject(port).GetNumberOfPoints(), 0)

    def test_errors(self):
        good = density_image((8, 6))
        self.refused("Measure is Density, but there is no Domain; connect data with a density",
                     None, sites=points_in(good, 9))
        self.refused("Measure is 2; it must be 0 (Uniform) or 1 (Density)", good, Measure=2)
        for shape in (0, 1):
            def wrong(text, values, **properties):
                image = density_image((8, 6), values=values)
                self.refused(text, image, Shape=shape, **properties)
            negative = np.ones(48)
            negative[[5, 7]] = -1
            wrong(("'Density'", "2 negative", "5"), negative)
            nan = np.ones(48)
            nan[11] = np.nan
            wrong(("'Density'", "1 value", "11"), nan)
            wrong(("'Density'", "mass"), np.zeros(48))
            wrong(("'Density'", "mass"), np.full(48, 1e308))
            wrong("Component is 3", np.ones((48, 3)), Component=3)
        bare = density_image((8, 6))
        bare.GetCellData().SetScalars(None)
        bare.GetCellData().RemoveArray("Density")
        self.refused("no active scalars for a density", bare)
        array = (0, 1, 0, 1, "Nothing")
        cells = rt.vtkEqualMassCells()
        cells.SetInputData(points_in(good, 9))
        cells.SetDomainData(good)
        cells.SetMeasureToDensity()
        cells.SetInputArrayToProcess(*array)
        reported = Listener(cells)
        cells.Update()
        self.assertIn("no density array 'Nothing'", reported.errors[0])
        self.refused("Shape Power needs a domain of two dimensions; this one has 3",
                     density_image((4, 4, 4)), Shape=1)
        one = np.zeros(48)
        one[20] = 1
        one = density_image((8, 6), values=one)
        one.SetSpacing(1, 1, 1)
        self.refused(("9 sites", "has mass in 4 of 16 x 12 pixels", "raise Resolution"), one,
                     Resolution=16)

    def test_clamped_and_outside(self):
        values = np.ones(48)
        values[5] = -1
        image = density_image((8, 6), values=values)
        cells = self.cells(image, 4, NegativeValues="Clamp", Resolution=48)
        self.assertAlmostEqual(self.statistics(cells)[0].sum(), 47)
        sites = points_in(image, 9)
        sites.GetPoints().SetPoint(3, -50, 1, 0)
        for shape in (0, 1):
            outside = rt.vtkEqualMassCells()
            outside.SetInputData(sites)
            outside.SetDomainData(density_image((8, 6)))
            outside.SetMeasureToDensity()
            outside.SetShape(shape)
            outside.SetResolution(60)
            reported = Listener(outside)
            outside.Update()
            self.assertEqual(reported.errors, [])
            self.assertEqual(len(reported.warnings), 1)
            self.assertIn("1 of 9 sites is outside the domain", reported.warnings[0])

    def test_cells_without_mass_warn(self):
        """One pixel has more than half of all: it cannot be divided."""
        values = np.full(64, 1e-6)
        values[27] = 1
        image = density_image((8, 8), values=values)
        image.SetSpacing(1, 1, 1)
        cells = rt.vtkEqualMassCells()
        cells.SetInputData(points_in(image, 20))
        cells.SetDomainData(image)
        cells.SetMeasureToDensity()
        cells.SetResolution(8)
        reported = Listener(cells)
        cells.Update()
        self.assertEqual(reported.errors, [])
        masses = vtk_to_numpy(cells.GetSites().GetPointData().GetArray("CellMass"))
        self.assertAlmostEqual(masses.sum(), values.sum())
        without = np.count_nonzero(masses == 0)
        self.assertGreater(without, 0)
        value, steps, without_mass = reported.warnings
        self.assertIn("The value 1 of the density array 'Density', in 1 of 64 cells (index 27)", value)
        # Cells take 128 steps or more, and as many times more than other filters.
        self.assertRegex(steps, r"AreaTolerance 0\.02 is not reached: .* 8 times as long as 128, areas")
        self.assertIn("%d of 20 sites have cells without mass" % without, without_mass)
        # They are where they were, and cost nothing.
        centroids = vtk_to_numpy(cells.GetSites().GetPointData().GetArray("CellCentroid"))
        sites = vtk_to_numpy(points_in(image, 20).GetPoints().GetData())
        np.testing.assert_allclose(centroids[masses == 0], sites[masses == 0], atol=1e-12)


if __name__ == "__main__":
    main()

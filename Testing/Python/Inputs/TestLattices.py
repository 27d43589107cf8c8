# SPDX-License-Identifier: BSD-3-Clause
"""Cells that are those of an image still, hyper tree grids, and which array is a density at first."""
import unittest

import numpy as np
from rt_testing import Listener, digest, load_plugin, main, output_of, positions, producer
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (VTK_HEXAHEDRON, vtkDataSetAttributes, vtkImageData,
                                           vtkMolecule, vtkMultiBlockDataSet, vtkRectilinearGrid,
                                           vtkTable, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersSources import vtkHyperTreeGridSource

simple = load_plugin()
LIMIT = 0.5  # Threshold keeps what is above


def cell_array(data, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values).ravel(), deep=True)
    array.SetName(name)
    data.GetCellData().AddArray(array)
    return array


def image_of(values, origin=(0, 0, 0), spacing=(1, 1, 1), flat=2, direction=None, name="d"):
    """Values on the cells, the first axis last; `flat` is the axis of one point where they are 2D."""
    image = vtkImageData()
    points = [count + 1 for count in values.shape[::-1]]
    if values.ndim == 2:
        points.insert(flat, 1)
    image.SetDimensions(*(points + [1, 1])[:3])
    image.SetOrigin(*origin)
    image.SetSpacing(*spacing)
    if direction is not None:
        image.SetDirectionMatrix(*np.ravel(direction))
    cell_array(image, name, values)
    image.GetCellData().SetActiveScalars(name)
    return image


def with_border(shape, seed=1):
    """Uneven values; those at the border are kept, so that the box is that of all."""
    values = np.random.default_rng(seed).random(shape)
    inner = tuple(slice(1, -1) for _ in shape)
    border = np.ones(shape, bool)
    border[inner] = False
    return np.where(border, values / 2 + LIMIT, values)


def blanked(image):
    hidden = vtk_to_numpy(image.GetCellData().GetArray("d")) < LIMIT
    copy = vtkImageData()
    copy.DeepCopy(image)
    cell_array(copy, vtkDataSetAttributes.GhostArrayName(),
               (hidden * vtkDataSetAttributes.HIDDENCELL).astype(np.uint8))
    return copy


def threshold(data):
    return simple.Threshold(producer(simple, data), Scalars=["CELLS", "d"], LowerThreshold=LIMIT,
                            UpperThreshold=1e9)


def structured(image):
    return output_of(simple.AppendDatasets(Input=[producer(simple, image)]))


def turned(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def mass_of(data):
    array = data.GetFieldData().GetArray("TotalMass")
    return array.GetValue(0) if array else None


def blocks_of(*data):
    blocks = vtkMultiBlockDataSet()
    for i, block in enumerate(data):
        blocks.SetBlock(i, block)
    return blocks


def integral(source, name, cells=True):
    integrated = output_of(simple.IntegrateVariables(source))
    values = integrated.GetCellData() if cells else integrated.GetPointData()
    return values.GetArray(name).GetValue(0)


class Lattices(unittest.TestCase):
    def sample(self, source, array=("CELLS", "d"), **properties):
        properties.setdefault("NumberOfParticles", 2000)
        return output_of(simple.SampleDensity(source, DensityArray=list(array), **properties))

    def dimensions(self, source, array=("CELLS", "d"), **properties):
        """Of the image that the density is put on."""
        return output_of(simple.TransportMap(source, DensityArray=list(array),
                                             **properties)).GetDimensions()

    def check_same(self, source, image, **properties):
        """The same bits as of an image with the cells that are missing blanked."""
        found, expected = (self.sample(data, **properties)
                           for data in (source, producer(simple, image)))
        self.assertTrue(np.array_equal(positions(found), positions(expected)))
        self.assertEqual(mass_of(found), mass_of(expected))

    def test_threshold_of_an_image(self):
        for shape, flats in (((9, 14), (0, 1, 2)), ((5, 8, 7), (2,)), ((30,), (2,))):
            for flat in flats:
                image = image_of(with_border(shape), origin=(3, -2, 7), flat=flat)
                kept = threshold(image)
                self.assertEqual(output_of(kept).GetClassName(), "vtkUnstructuredGrid")
                self.assertEqual(self.dimensions(kept), image.GetDimensions())
                self.check_same(kept, blanked(image))
                self.check_same(kept, blanked(image), InvertDensity=1)

    def test_no_particle_where_cells_were_taken_out(self):
        values = np.random.default_rng(0).random((33, 47))
        result = self.sample(threshold(image_of(values)), NumberOfParticles=20000)
        x, y, _ = np.floor(positions(result)).astype(int).T
        there = values[y.clip(0, 32), x.clip(0, 46)]
        self.assertEqual((there < LIMIT).sum(), 0)
        self.assertAlmostEqual(mass_of(result), values[values >= LIMIT].sum(), 9)
        self.assertTrue(np.array_equal(vtk_to_numpy(result.GetPointData().GetArray("d")), there))

    def test_any_spacing_place_and_direction(self):
        values = with_border((6, 9, 8))
        total = values[values >= LIMIT].sum() * 0.1 * 0.3 * 0.7
        for origin in ((3.3, -2, 100), (1e4, 2e4, -3e4)):
            for direction in (None, turned(0.4), [[0, 1, 0], [1, 0, 0], [0, 0, 1]]):
                image = image_of(values, origin, (0.1, 0.3, 0.7), direction=direction)
                kept = threshold(image)
                self.assertEqual(sorted(self.dimensions(kept)), [7, 9, 10])
                mass = mass_of(self.sample(kept))
                self.assertLess(abs(mass / total - 1), 1e-2 if origin[0] > 100 else 1e-5)

    def test_planes_that_are_transformed(self):
        kept = threshold(image_of(with_border((9, 14))))
        moved = simple.Transform(kept)
        moved.Transform.Rotate = [20, 30, 40]
        moved.Transform.Translate = [50, 10, 0]
        self.assertEqual(sorted(self.dimensions(moved)), [1, 10, 15])
        self.assertLess(abs(mass_of(self.sample(moved)) / mass_of(self.sample(kept)) - 1), 1e-6)

    def test_values_of_any_type(self):
        values = with_border((9, 14))
        for converted in (values.astype(np.float32), (values * 200).astype(np.uint8)):
            image = image_of(converted)
            source = simple.Threshold(producer(simple, image), Scalars=["CELLS", "d"],
                                      LowerThreshold=0, UpperThreshold=1e9)
            self.check_same(source, image, InvertDensity=1)

    def hexahedra(self, image, orders):
        """Cells with their corners in other orders, one after another."""
        voxels = structured(image)
        cells = vtkUnstructuredGrid()
        cells.SetPoints(voxels.GetPoints())
        for cell in range(voxels.GetNumberOfCells()):
            ids = voxels.GetCell(cell).GetPointIds()
            around = [ids.GetId(i) for i in (0, 1, 3, 2, 4, 5, 7, 6)]
            cells.InsertNextCell(VTK_HEXAHEDRON, 8,
                                 [around[i] for i in orders[cell % len(orders)]])
        cells.GetCellData().ShallowCopy(voxels.GetCellData())
        return cells

    def test_cells_of_any_kind(self):
        image = image_of(with_border((5, 8, 7)))
        orders = ([0, 1, 2, 3, 4, 5, 6, 7], [1, 2, 3, 0, 5, 6, 7, 4], [4, 7, 6, 5, 0, 3, 2, 1],
                  [0, 4, 5, 1, 3, 7, 6, 2])
        grid = vtkRectilinearGrid()
        grid.SetDimensions(image.GetDimensions())
        for axis, count in zip("XYZ", image.GetDimensions()):
            coordinates = numpy_to_vtk(np.arange(count, dtype=float), deep=True)
            getattr(grid, "Set%sCoordinates" % axis)(coordinates)
        grid.GetCellData().ShallowCopy(image.GetCellData())
        for data in (structured(image), self.hexahedra(image, orders), grid):
            self.check_same(producer(simple, data), image)
            self.check_same(threshold(data), blanked(image))
        plane = image_of(with_border((6, 9)))
        faces = simple.ExtractSurface(producer(simple, plane))
        self.assertEqual(output_of(faces).GetClassName(), "vtkPolyData")
        self.check_same(faces, plane)

    def test_blocks_of_cells(self):
        image = image_of(with_border((5, 8, 14)))
        parts = [threshold(output_of(simple.ExtractSubset(producer(simple, image),
                                                          VOI=[low, high, 0, 8, 0, 5])))
                 for low, high in ((0, 6), (6, 14))]
        self.check_same(simple.GroupDatasets(Input=parts), blanked(image))

    def test_cells_that_are_no_lattice(self):
        image = image_of(with_border((5, 8, 7)))
        moved = self.hexahedra(image, [range(8)])
        vtk_to_numpy(moved.GetPoints().GetData())[5] += 0.3
        twisted = self.hexahedra(image, [[0, 2, 1, 3, 4, 6, 5, 7]])
        far = image_of(np.ones((2, 2, 2)), origin=(1e5, 0, 3e4))
        sparse = output_of(simple.AppendDatasets(
            Input=[producer(simple, data) for data in (image, far)]))
        for data in (moved, twisted, sparse):
            found = self.dimensions(producer(simple, data), DensityResolution=32)
            self.assertEqual(max(found), 33)
        # Cells that overlap add up.
        cells = producer(simple, structured(image))
        twice = self.sample(simple.GroupDatasets(Input=[cells, cells]), DensityResolution=32)
        total = vtk_to_numpy(image.GetCellData().GetArray("d")).sum()
        self.assertAlmostEqual(mass_of(twice) / total, 2, 9)

    def test_ghost_cells(self):
        cells = output_of(threshold(image_of(with_border((9, 14)))))
        flags = np.zeros(cells.GetNumberOfCells(), np.uint8)
        flags[::7] = vtkDataSetAttributes.DUPLICATECELL
        flags[1::9] = vtkDataSetAttributes.HIDDENCELL
        copy = vtkUnstructuredGrid()
        copy.DeepCopy(cells)
        cell_array(copy, vtkDataSetAttributes.GhostArrayName(), flags)
        mass = mass_of(self.sample(producer(simple, copy)))
        self.assertAlmostEqual(mass, vtk_to_numpy(cells.GetCellData().GetArray("d"))[flags == 0].sum())

    def test_points_of_cells_that_are_left(self):
        values = with_border((9, 14))
        image = image_of(values)
        array = numpy_to_vtk(np.random.default_rng(5).random(150), deep=True)
        array.SetName("p")
        image.GetPointData().AddArray(array)
        kept = threshold(image)
        result = self.sample(kept, ("POINTS", "p"), DensityResolution=70, NumberOfParticles=5000)
        self.assertEqual(self.dimensions(kept, ("POINTS", "p"), DensityResolution=70), (71, 46, 1))
        self.assertEqual(self.dimensions(kept, ("POINTS", "p"), DensityResolution=3), (15, 10, 1))
        self.assertLess(abs(mass_of(result) / integral(kept, "p", False) - 1), 1e-6)
        x, y, _ = np.floor(positions(result)).astype(int).T
        self.assertTrue((values[y.clip(0, 8), x.clip(0, 13)] >= LIMIT).all())

    def test_other_filters(self):
        image = image_of(with_border((9, 14)))
        kept, hidden = threshold(image), producer(simple, blanked(image))
        for make in (lambda data: simple.TransportMap(data, DensityArray=["CELLS", "d"]),
                     lambda data: simple.MorphDensities(data, Target=data, TargetArray=["CELLS", "d"],
                                                        DensityArray=["CELLS", "d"]),
                     lambda data: simple.DensityBarycenter(Input=[data], DensityArray=["CELLS", "d"])):
            first, second = (output_of(make(data)) for data in (kept, hidden))
            for name in ("Density", "Displacement"):
                if second.GetCellData().HasArray(name):
                    a, b = (vtk_to_numpy(data.GetCellData().GetArray(name))
                            for data in (first, second))
                    self.assertTrue(np.array_equal(a, b))


def trees(dimensions, branches, descriptor, mask=None, scale=(1.5, 1.0, 0.5)):
    source = vtkHyperTreeGridSource()
    source.SetMaxDepth(4)
    source.SetDimensions(*dimensions)
    source.SetBranchFactor(branches)
    source.SetGridScale(*scale)
    source.SetDescriptor(descriptor)
    if mask:
        source.SetUseMask(1)
        source.SetMask(mask)
    source.Update()
    grid = source.GetOutput()
    cell_array(grid, "rho", np.random.default_rng(4).random(grid.GetNumberOfCells()) + 0.1)
    return grid


class HyperTreeGrids(unittest.TestCase):
    GRIDS = (((4, 1, 1), 2, "RR.|.. .R|.."), ((3, 3, 1), 2, "R.R.|.R.. ....|...."),
             ((3, 3, 1), 2, "R.R.|.R.. ....|....", "1011|1111 1110|1101"),
             ((3, 1, 3), 3, "R..R|..R...... .........|........."),
             ((1, 3, 3), 2, "R.R.|.R.. ....|...."), ((3, 2, 2), 2, "R.|.R......|........"),
             ((3, 2, 2), 2, "R.|.R......|........", "11|11110111|11110000"))

    def test_mass_is_that_of_the_cells(self):
        for grid in self.GRIDS:
            source = producer(simple, trees(*grid))
            expected = integral(simple.HyperTreeGridToUnstructuredGrid(source), "rho")
            result = output_of(simple.SampleDensity(source, DensityArray=["CELLS", "rho"],
                                                    DensityResolution=32, NumberOfParticles=200))
            self.assertAlmostEqual(mass_of(result) / expected, 1, 7)
            self.assertEqual(result.GetNumberOfPoints(), 200)
            self.assertTrue(result.GetPointData().HasArray("rho"))

    def test_lines_along_any_axis(self):
        masses = [mass_of(output_of(simple.SampleDensity(
            producer(simple, trees(dimensions, 2, "RR.|.. .R|..", None, (1, 1, 1))),
            DensityArray=["CELLS", "rho"], NumberOfParticles=50)))
            for dimensions in ((4, 1, 1), (1, 4, 1), (1, 1, 4))]
        self.assertAlmostEqual(masses[1] / masses[0], 1, 12)
        self.assertAlmostEqual(masses[2] / masses[0], 1, 12)

    def test_every_filter_takes_them(self):
        grid = simple.HyperTreeGridRandom()
        expected = integral(simple.HyperTreeGridToUnstructuredGrid(grid), "Depth")
        density = {"DensityArray": ["CELLS", "Depth"], "DensityResolution": 24}
        dots = simple.SampleDensity(grid, NumberOfParticles=200, DensityResolution=24)
        self.assertEqual(list(dots.DensityArray), ["CELLS", "Depth"])
        with_mass = [dots, simple.TransportMap(grid, **density),
                     simple.MorphDensities(grid, Target=grid, TargetArray=["CELLS", "Depth"],
                                           **density),
                     simple.DensityBarycenter(Input=[grid, grid], **density)]
        for proxy in with_mass:
            self.assertAlmostEqual(mass_of(output_of(proxy)) / expected, 1, 6)
        quality = output_of(simple.TransportQuality(dots, Density=grid, **density))
        self.assertAlmostEqual(quality.GetColumnByName("TotalMass").GetValue(0) / expected, 1, 6)
        for proxy in (simple.DensityEqualizingWarp(dots, Density=grid, **density),
                      simple.RelaxBlueNoise(dots, Density=grid, MaximumIterations=1, **density)):
            self.assertEqual(output_of(proxy).GetNumberOfPoints(), 200)
        for measure in ("Uniform", "Density"):
            labels = output_of(simple.EqualMassCells(dots, Domain=grid, Measure=measure,
                                                     Resolution=20, **density))
            off = np.array(labels.GetBounds()) - [-10, 10, -10, 10, -10, 10]
            self.assertLess(np.abs(off).max(), 1e-9)

    def test_in_blocks_and_kept(self):
        grid = trees(*self.GRIDS[5])
        image = image_of(np.full((2, 2, 2), 3.0), origin=(10, 0, 0), name="rho")
        blocks = producer(simple, blocks_of(grid, image))
        sampler = simple.SampleDensity(blocks, DensityArray=["CELLS", "rho"], DensityResolution=48)
        alone = mass_of(output_of(simple.SampleDensity(producer(simple, grid),
                                                       DensityArray=["CELLS", "rho"])))
        self.assertAlmostEqual(mass_of(output_of(sampler)), alone + 24, 9)
        built = sampler.GetClientSideObject().GetTableBuildTime()
        sampler.RandomSeed = 3
        output_of(sampler)
        self.assertEqual(sampler.GetClientSideObject().GetTableBuildTime(), built)


class WhichArray(unittest.TestCase):
    def block(self, x, *names):
        image = image_of(np.full((4, 4, 4), 2.0), origin=(x, 0, 0), name="rho")
        block = structured(image)
        if "rho" not in names:
            block.GetCellData().RemoveArray("rho")
        for name in names:
            if name != "rho":
                cell_array(block, name, np.arange(64.0) + 1)
        return block

    def run_on(self, *data, array=("CELLS", "rho"), make=None):
        source = producer(simple, blocks_of(*data))
        sampler = make(source) if make else simple.SampleDensity(source, NumberOfParticles=300)
        if array:
            sampler.DensityArray = list(array)
        reported = Listener(sampler.GetClientSideObject())
        return output_of(sampler), reported, sampler

    def test_blocks_without_it_have_no_mass(self):
        """An array that element blocks of a file lack, "partial" in ParaView."""
        for lacking in range(3):
            blocks = [self.block(4 * i, *([] if i == lacking else ["rho"])) for i in range(3)]
            result, reported, _ = self.run_on(*blocks)
            self.assertAlmostEqual(mass_of(result), 256, 9)
            self.assertEqual(reported.errors, [])
            self.assertEqual(len(reported.warnings), 1)
            self.assertIn("1 of 3 blocks of the input have no cell array 'rho' and carry no mass (the first is "
                          f"block {1 + lacking} of the input)", reported.warnings[0])
            x = positions(result)[:, 0]
            self.assertFalse(((x > 4 * lacking + 0.01) & (x < 4 * lacking + 3.99)).any())

    def test_images_without_it(self):
        first, second = (image_of(np.full((4, 4, 4), 2.0), origin=(x, 0, 0), name=name)
                         for x, name in ((0, "q"), (4, "rho")))
        result, reported, _ = self.run_on(first, second)
        self.assertEqual(mass_of(result), 128)
        self.assertIn("1 of 2 blocks", reported.warnings[0])
        self.assertGreater(positions(result)[:, 0].min(), 4)
        seeds = output_of(simple.SampleDensity(producer(simple, blocks_of(first, second)),
                                               DensityArray=["CELLS", "rho"], FlowTime=0))
        self.assertLess(positions(seeds)[:, 0].min(), 0.5)  # it is part of the domain

    def test_no_block_has_it(self):
        result, reported, _ = self.run_on(self.block(0, "x"), self.block(4, "y"))
        self.assertEqual(result.GetNumberOfPoints(), 0)
        self.assertIn("block 1 of the input has no density array 'rho'; it has no point arrays and x",
                      reported.errors[0])

    def test_blocks_of_another_kind(self):
        result, reported, _ = self.run_on(self.block(0, "rho"), vtkTable(), vtkMolecule())
        self.assertAlmostEqual(mass_of(result), 128, 9)
        self.assertIn("2 blocks of the input without cells of a data set (the first a vtkTable, "
                      "block 2 of the input) passed over", reported.warnings[0])
        result, reported, _ = self.run_on(vtkTable(), vtkTable())
        self.assertIn("no image, mesh or grid, but 2 blocks of another type (the first a vtkTable",
                      reported.errors[0])
        images = [image_of(np.full((4, 4, 4), value), name="rho") for value in (1.0, 2.0)]
        result, reported, _ = self.run_on(
            *images, vtkTable(), make=lambda source: simple.DensityBarycenter(Input=[source]))
        self.assertAlmostEqual(mass_of(result), 96, 9)
        self.assertIn("1 block of the inputs", reported.warnings[0])

    def test_first_choice_is_no_id(self):
        image = image_of(np.random.default_rng(2).random((4, 5, 6)), name="zeta")
        for name in ("ids", "GlobalNodeId", "vtkOriginalCellIds", "Id", "cell_id", "ElementIDs",
                     vtkDataSetAttributes.GhostArrayName()):
            cell_array(image, name, np.zeros(120, np.uint8 if "Ghost" in name else np.int64))
        points = numpy_to_vtk(np.arange(210.0), deep=True)
        points.SetName("PointIds")
        image.GetPointData().SetScalars(points)
        image.GetCellData().SetActiveScalars("ids")
        source = producer(simple, image)
        dots = simple.SampleDensity(source, NumberOfParticles=50)
        for proxy in (dots, simple.TransportMap(source), simple.TransportQuality(dots, Density=source),
                      simple.MorphDensities(source, Target=source),
                      simple.DensityBarycenter(Input=[source]),
                      simple.RelaxBlueNoise(dots, Density=source),
                      simple.EqualMassCells(dots, Domain=source)):
            self.assertEqual(list(proxy.DensityArray), ["CELLS", "zeta"])
            # Ids may be a density where they are chosen, flags never.
            listed = proxy.GetProperty("DensityArray").GetDomain("array_list")
            names = {listed.GetString(i) for i in range(listed.GetNumberOfStrings())}
            self.assertIn("GlobalNodeId", names)
            self.assertNotIn(vtkDataSetAttributes.GhostArrayName(), names)
        self.assertEqual(list(simple.MorphDensities(source, Target=source).TargetArray),
                         ["CELLS", "zeta"])
        for name in ("Solid", "FLUID", "Humid", "vtkness"):  # which end or begin so, but are words
            cell_array(image, name, np.ones(120))
        image.GetCellData().RemoveArray("zeta")
        self.assertEqual(list(simple.SampleDensity(producer(simple, image)).DensityArray),
                         ["CELLS", "FLUID"])

    def test_ids_only_where_they_are_named(self):
        data = self.block(0, "ids")
        result, reported, sampler = self.run_on(data, array=None)
        self.assertEqual(sampler.DensityArray[1], "")
        self.assertEqual(result.GetNumberOfPoints(), 0)
        self.assertIn("ids and flags are a density only where they are named", reported.errors[0])
        result, reported, _ = self.run_on(data, array=("CELLS", "ids"))
        self.assertAlmostEqual(mass_of(result), 64 * 65 / 2, 6)

    def test_active_scalars_and_whole_arrays_come_first(self):
        first, second = self.block(0, "rho", "b"), self.block(4, "rho", "a", "b")
        for block in (first, second):
            block.GetCellData().SetActiveAttribute(-1, vtkDataSetAttributes.SCALARS)
        _, _, sampler = self.run_on(first, second, array=None)
        self.assertEqual(list(sampler.DensityArray), ["CELLS", "b"])
        for block in (first, second):
            block.GetCellData().SetActiveScalars("rho")
        _, _, sampler = self.run_on(first, second, array=None)
        self.assertEqual(list(sampler.DensityArray), ["CELLS", "rho"])


if __name__ == "__main__":
    main()

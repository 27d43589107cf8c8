# SPDX-License-Identifier: BSD-3-Clause
"""Densities on data that are no images: their mass, the arrays of particles, and what is an error."""
import os
import unittest

import numpy as np
from rt_testing import (Listener, SOURCE, density_image, digest, load_plugin, main, output_of,
                        positions, producer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_TETRA, vtkDataSetAttributes, vtkMultiBlockDataSet,
                                           vtkPolyData, vtkRectilinearGrid, vtkUnstructuredGrid)

simple = load_plugin()
DATA = os.path.join(SOURCE, "Testing", "Data")


def wavelet(reach=10):
    return simple.Wavelet(WholeExtent=[-reach, reach] * 3)


def brain():
    return simple.XMLImageDataReader(FileName=[os.path.join(DATA, "brain-t1.vti")])


def density_name(source):
    """The association and the name of the scalars of an image's points or cells."""
    source.UpdatePipeline()
    points = source.PointData.keys()
    return ("POINTS", points[0]) if points else ("CELLS", source.CellData.keys()[0])


def with_values(data, cells, seed=1):
    count = data.GetNumberOfCells() if cells else data.GetNumberOfPoints()
    array = numpy_to_vtk(np.random.default_rng(seed).random(count), deep=True)
    array.SetName("c" if cells else "p")
    (data.GetCellData() if cells else data.GetPointData()).AddArray(array)
    return data


def uneven_grid(shape=(23, 17, 11)):
    grid = vtkRectilinearGrid()
    grid.SetDimensions(*(count + 1 for count in shape))
    for axis, count in zip("XYZ", shape):
        steps = np.random.default_rng(count).uniform(0.1, 2.0, count)
        places = numpy_to_vtk(np.concatenate([[-3.0], -3.0 + np.cumsum(steps)]), deep=True)
        getattr(grid, "Set%sCoordinates" % axis)(places)
    return with_values(with_values(grid, True), False, 2)


def as_unstructured(data):
    return output_of(simple.AppendDatasets(Input=[producer(simple, data)]))


def blocks_of(*data):
    blocks = vtkMultiBlockDataSet()
    for i, block in enumerate(data):
        blocks.SetBlock(i, block)
    return blocks


class AnyData(unittest.TestCase):
    def sample(self, source, array, **properties):
        sampler = simple.SampleDensity(source, DensityArray=list(array), **properties)
        return output_of(sampler)

    def mass(self, source, array):
        integral = output_of(simple.IntegrateVariables(source))
        values = integral.GetPointData() if array[0] == "POINTS" else integral.GetCellData()
        return values.GetArray(array[1]).GetValue(0)

    def outside(self, source, particles):
        """The share of the particles that are in no cell."""
        simple_source = producer(simple, particles)
        probed = output_of(simple.ResampleWithDataset(
            SourceDataArrays=source, DestinationMesh=simple_source, SnapToCellWithClosestPoint=0))
        return 1 - vtk_to_numpy(probed.GetPointData().GetArray("vtkValidPointMask")).mean()

    def check_mass(self, source, array, tolerance=1e-4, **properties):
        result = self.sample(source, array, **properties)
        self.assertEqual(result.GetClassName(), "vtkPolyData")
        self.assertEqual(result.GetNumberOfPoints(), 8192)
        expected = self.mass(source, array)
        total = result.GetFieldData().GetArray("TotalMass").GetValue(0)
        self.assertLess(abs(total / expected - 1), tolerance)
        particles = result.GetPointData().GetArray("Mass")
        self.assertAlmostEqual(vtk_to_numpy(particles).sum() / total, 1, 12)
        return result

    def check_values(self, result, source, name, tolerance):
        """The particles' values are those that ParaView probes, where it finds a cell."""
        probed = output_of(simple.ResampleWithDataset(
            SourceDataArrays=source, DestinationMesh=producer(simple, result),
            SnapToCellWithClosestPoint=0)).GetPointData()
        valid = vtk_to_numpy(probed.GetArray("vtkValidPointMask")).astype(bool)
        self.assertGreater(valid.mean(), 0.9)
        found = vtk_to_numpy(result.GetPointData().GetArray(name))
        expected = vtk_to_numpy(probed.GetArray(name))
        self.assertFalse(np.isnan(found).any())
        off = np.abs(found - expected)[valid]
        self.assertLess(np.quantile(off, 0.99), tolerance)

    def test_tetrahedra(self):
        mesh = simple.Tetrahedralize(wavelet())
        result = self.check_mass(mesh, ("POINTS", "RTData"), 1e-12)
        self.assertEqual(self.outside(mesh, result), 0)
        self.check_values(result, mesh, "RTData", 1e-4)

    def test_mesh_of_a_brain(self):
        """Hexahedra, tetrahedra, wedges and pyramids, cut by a sphere."""
        image = brain()
        array = density_name(image)
        middle = np.mean(np.reshape(image.GetDataInformation().GetBounds(), (3, 2)), axis=1)
        clipped = simple.Clip(image, ClipType="Sphere", Invert=1)
        clipped.ClipType.Center = list(middle)
        clipped.ClipType.Radius = 60
        result = self.check_mass(clipped, array, 5e-3)
        self.assertLess(self.outside(clipped, result), 0.01)

    def test_delaunay_mesh_of_a_surface(self):
        """Tetrahedra of very different sizes."""
        cow = simple.XMLPolyDataReader(FileName=[os.path.join(DATA, "spot.vtp")])
        solid = simple.Elevation(simple.Delaunay3D(cow), LowPoint=[0, -1, 0], HighPoint=[0, 1, 0])
        result = self.check_mass(solid, ("POINTS", "Elevation"), 1e-12)
        self.assertLess(self.outside(solid, result), 0.02)
        self.check_values(result, solid, "Elevation", 1e-5)

    def test_amr(self):
        for properties in ({}, {"TwoDimensional": 0, "MaximumLevel": 3}):
            fractal = simple.HierarchicalFractal(**properties)
            result = self.check_mass(fractal, ("CELLS", "Fractal Volume Fraction"), 5e-3)
            self.assertIsNotNone(result.GetPointData().GetArray("Depth"))

    def test_uneven_grid(self):
        grid = producer(simple, uneven_grid())
        for array, places in ((("CELLS", "c"), 1e-12), (("POINTS", "p"), 1e-12)):
            result = self.check_mass(grid, array, places)
            self.assertEqual(self.outside(grid, result), 0)

    def test_structured_grid(self):
        """Of the same values, the mass of a curved grid is that of its cells."""
        warped = simple.WarpByVector(simple.Calculator(
            producer(simple, uneven_grid()),
            ResultArrayName="shift", Function="0.3*sin(coordsY)*iHat+0.2*coordsX*kHat"),
            Vectors=["POINTS", "shift"])
        self.check_mass(warped, ("POINTS", "p"), 5e-3)

    def test_oblique_slice(self):
        image = brain()
        array = density_name(image)
        cut = simple.Slice(image)
        cut.SliceType.Normal = [1, 0.5, 0.3]
        result = self.check_mass(cut, array, 1e-6)
        normal = np.array([1, 0.5, 0.3]) / np.linalg.norm([1, 0.5, 0.3])
        off = (positions(result) - np.array(cut.SliceType.Origin)) @ normal
        self.assertLess(np.abs(off).max(), 1e-3)
        self.assertLess(self.outside(cut, result), 0.05)

    def test_map_of_a_slice_is_in_its_plane(self):
        cut = simple.Slice(wavelet())
        cut.SliceType.Normal = [1, 0.5, 0.3]
        field = simple.TransportMap(cut, DensityArray=["POINTS", "RTData"], DensityResolution=40)
        image = output_of(field)
        self.assertEqual(max(image.GetDimensions()), 41)
        self.assertEqual(sorted(image.GetDimensions())[0], 1)
        displacement = vtk_to_numpy(image.GetCellData().GetArray("Displacement"))
        normal = np.array([1, 0.5, 0.3]) / np.linalg.norm([1, 0.5, 0.3])
        self.assertGreater(np.abs(displacement).max(), 0.1)
        self.assertLess(np.abs(displacement @ normal).max(), 1e-4)

    def test_what_follows_knows_the_extent(self):
        mesh = simple.Tetrahedralize(wavelet(5))
        field = simple.TransportMap(mesh, DensityArray=["POINTS", "RTData"], DensityResolution=16)
        contour = simple.Contour(simple.CellDatatoPointData(field), ContourBy=["POINTS", "Divergence"],
                                 Isosurfaces=[0.0])
        self.assertGreater(output_of(contour).GetNumberOfCells(), 0)

    def test_morph_between_kinds(self):
        mesh = simple.Tetrahedralize(wavelet(5))
        image = wavelet(5)
        morph = simple.MorphDensities(mesh, Target=image, DensityResolution=20,
                                      DensityArray=["POINTS", "RTData"],
                                      TargetArray=["POINTS", "RTData"])
        result = output_of(morph)
        total = result.GetFieldData().GetArray("TotalMass").GetValue(0)
        cells = vtk_to_numpy(result.GetCellData().GetScalars())
        volume = np.prod(result.GetSpacing())
        self.assertAlmostEqual(cells.sum() * volume / total, 1, 9)

    def test_tiles_are_joined_exactly(self):
        for cells in (True, False):
            image = density_image((12, 9, 7), cells=cells)
            whole = producer(simple, image)
            array = ("CELLS" if cells else "POINTS", "Density")
            expected = self.sample(whole, array)
            extent = np.array(image.GetExtent())
            tiles = []
            for cut in ((extent[0], extent[0] + 5), (extent[0] + 5, extent[1])):
                tile = simple.ExtractSubset(whole, VOI=[*cut, *extent[2:]])
                tiles.append(tile)
            group = simple.GroupDatasets(Input=tiles)
            self.assertEqual(digest(self.sample(group, array)), digest(expected))

    def dimensions(self, source, array, **properties):
        """Of the image that the density is put on."""
        return output_of(simple.TransportMap(source, DensityArray=list(array),
                                             **properties)).GetDimensions()

    def shifted(self, offset, seed=3):
        image = density_image((6, 5, 4), seed=seed)
        image.SetSpacing(1, 1, 1)
        image.SetOrigin(6 + offset, 0, 0)
        return image

    def test_images_off_the_lattice_are_put_on_one(self):
        array = ("CELLS", "Density")
        first = self.shifted(-6)
        joined = producer(simple, blocks_of(first, self.shifted(2)))
        self.assertEqual(self.dimensions(joined, array, DensityResolution=28), (15, 6, 5))
        apart = producer(simple, blocks_of(first, self.shifted(1.5)))
        self.assertEqual(self.dimensions(apart, array, DensityResolution=27)[0], 28)

    def test_gaps_between_tiles_have_no_mass(self):
        first, second = self.shifted(-6), self.shifted(2, seed=4)
        values = np.concatenate([vtk_to_numpy(image.GetCellData().GetScalars())
                                 for image in (first, second)])
        particles = self.sample(producer(simple, blocks_of(first, second)), ("CELLS", "Density"),
                                InvertDensity=1, NumberOfParticles=500)
        mass = particles.GetFieldData().GetArray("TotalMass").GetValue(0)
        self.assertAlmostEqual(mass / (values.max() - values).sum(), 1, 9)
        x = positions(particles)[:, 0]
        self.assertFalse(((x > 6.01) & (x < 7.99)).any())

    def test_tiles_that_differ_where_they_meet_are_blocks(self):
        images = [density_image((6, 5, 4), cells=False, seed=seed) for seed in (3, 4)]
        images[1].SetOrigin(images[0].GetBounds()[1], 0, 0)
        source = producer(simple, blocks_of(*images))
        array = ("POINTS", "Density")
        mass = self.sample(source, array).GetFieldData().GetArray("TotalMass").GetValue(0)
        self.assertLess(abs(mass / self.mass(source, array) - 1), 5e-3)

    def test_cells_with_hidden_points_have_no_mass(self):
        mesh = as_unstructured(uneven_grid((4, 3, 2)))
        flags = np.zeros(mesh.GetNumberOfPoints(), np.uint8)
        flags[0] = vtkDataSetAttributes.HIDDENPOINT
        ghosts = numpy_to_vtk(flags, deep=True)
        ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
        mesh.GetPointData().AddArray(ghosts)
        values = vtk_to_numpy(mesh.GetCellData().GetArray("c"))
        volumes = np.array([np.prod(np.diff(np.array(mesh.GetCell(i).GetBounds()).reshape(3, 2)))
                            for i in range(mesh.GetNumberOfCells())])
        holds = [mesh.GetCell(i).GetPointIds().IsId(0) < 0 for i in range(mesh.GetNumberOfCells())]
        self.assertEqual(holds.count(False), 1)
        result = self.sample(producer(simple, mesh), ("CELLS", "c"))
        mass = result.GetFieldData().GetArray("TotalMass").GetValue(0)
        self.assertAlmostEqual(mass / (values * volumes)[holds].sum(), 1, 6)

    def test_mass_in_cells_smaller_than_those_of_the_image(self):
        """Of a mesh that is wide for the most, but has most of its mass in one small cell."""
        wide = output_of(simple.Tetrahedralize(producer(simple, uneven_grid((3, 3, 3)))))
        small = vtkUnstructuredGrid()
        points = vtkPoints()
        centre = np.array(wide.GetCenter()) + 0.123
        for corner in ((0, 0, 0), (1e-3, 0, 0), (0, 1e-3, 0), (0, 0, 1e-3)):
            points.InsertNextPoint(centre + corner)
        small.SetPoints(points)
        small.InsertNextCell(VTK_TETRA, 4, [0, 1, 2, 3])
        array = numpy_to_vtk(np.array([1e12]), deep=True)
        array.SetName("c")
        small.GetCellData().AddArray(array)
        blocks = producer(simple, blocks_of(wide, small))
        self.check_mass(blocks, ("CELLS", "c"), 5e-3, DensityResolution=64)

    def test_blocks_are_one_domain(self):
        """Blocks of different kinds; each has its share of the particles."""
        left, right = uneven_grid(), as_unstructured(uneven_grid((9, 8, 7)))
        moved = simple.Transform(producer(simple, right))
        moved.Transform.Translate = [60, 0, 0]
        blocks = producer(simple, blocks_of(left, vtkPolyData(), output_of(moved)))
        result = self.check_mass(blocks, ("CELLS", "c"), 1e-3)
        share = self.mass(producer(simple, left), ("CELLS", "c")) / self.mass(blocks, ("CELLS", "c"))
        self.assertAlmostEqual(np.mean(positions(result)[:, 0] < 45), share, 2)
        self.assertEqual(result.GetPointData().HasArray("c"), 1)

    def test_values_far_from_all_cells(self):
        left = uneven_grid((5, 4, 3))
        right = vtkRectilinearGrid()
        right.DeepCopy(left)
        coordinates = vtk_to_numpy(right.GetXCoordinates())
        coordinates += 40
        blocks = producer(simple, blocks_of(left, right))
        seeds = self.sample(blocks, ("CELLS", "c"), FlowTime=0.0, NumberOfParticles=400)
        x = positions(seeds)[:, 0]
        between = (x > left.GetBounds()[1] + 5) & (x < right.GetBounds()[0] - 5)
        values = vtk_to_numpy(seeds.GetPointData().GetArray("c"))
        self.assertGreater(between.sum(), 50)
        self.assertTrue(np.isnan(values[between]).all())
        self.assertFalse(np.isnan(values[x < left.GetBounds()[1]]).any())

    def test_values_changed_in_place(self):
        mesh = as_unstructured(uneven_grid((5, 4, 3)))
        sampler = simple.SampleDensity(producer(simple, mesh), DensityArray=["CELLS", "c"])
        mass = output_of(sampler).GetFieldData().GetArray("TotalMass").GetValue(0)
        values = mesh.GetCellData().GetArray("c")
        vtk_to_numpy(values)[:] *= 2
        values.Modified()
        filter_ = sampler.GetClientSideObject()
        filter_.Update()
        changed = filter_.GetOutput().GetFieldData().GetArray("TotalMass").GetValue(0)
        self.assertAlmostEqual(changed / mass, 2, 12)

    def test_resolution_and_threads(self):
        mesh = simple.Tetrahedralize(wavelet())
        digests = {digest(self.sample(mesh, ("POINTS", "RTData"), DensityResolution=50,
                                      Threading=threading))
                   for threading in ("Auto", "OpenMP", "VTK", "Serial")}
        self.assertEqual(len(digests), 1)

    def test_kept_until_something_changes(self):
        mesh = simple.Tetrahedralize(wavelet())
        sampler = simple.SampleDensity(mesh, DensityArray=["POINTS", "RTData"], DensityResolution=40)
        output_of(sampler)
        built = sampler.GetClientSideObject().GetTableBuildTime()
        sampler.RandomSeed = 7
        output_of(sampler)
        self.assertEqual(sampler.GetClientSideObject().GetTableBuildTime(), built)
        sampler.DensityResolution = 41
        output_of(sampler)
        self.assertGreater(sampler.GetClientSideObject().GetTableBuildTime(), built)

    def check_error(self, data, *parts, array=("CELLS", "c"), **properties):
        source = data if hasattr(data, "SMProxy") else producer(simple, data)
        sampler = simple.SampleDensity(source, **properties)
        sampler.DensityArray = list(array)
        reported = Listener(sampler.GetClientSideObject())
        self.assertEqual(output_of(sampler).GetNumberOfPoints(), 0)
        self.assertLessEqual(len(reported.errors), 1)
        for part in parts:
            self.assertIn(part, reported.errors[0])

    def changed(self, grid, value, index=5):
        grid.GetCellData().GetArray("c").SetValue(index, value)
        return grid

    def test_values_that_are_no_density(self):
        for make in (uneven_grid, lambda: as_unstructured(uneven_grid())):
            self.check_error(self.changed(make(), np.nan),
                             "'c' of the input has 1 value that is NaN", "first at index 5")
            self.check_error(self.changed(make(), -1), "1 negative value", "Clamp")
            nothing = make()
            nothing.GetCellData().GetArray("c").Fill(0)
            self.check_error(nothing, "'c' has a total mass of zero")
        self.check_error(blocks_of(uneven_grid(), self.changed(as_unstructured(uneven_grid()), np.inf)),
                         "'c' of the block 2 of the input has 1 value")

    def test_clamped_before_the_mean(self):
        grid = self.changed(uneven_grid(), -100)
        sampler = simple.SampleDensity(producer(simple, grid), DensityArray=["CELLS", "c"],
                                       NegativeValues="Clamp", DensityResolution=10)
        total = output_of(sampler).GetFieldData().GetArray("TotalMass").GetValue(0)
        expected = self.mass(producer(simple, self.changed(uneven_grid(), 0)), ("CELLS", "c"))
        self.assertAlmostEqual(total / expected, 1, 9)

    def test_cells_without_a_density(self):
        bowl = simple.Elevation(simple.Sphere(EndPhi=90))
        self.check_error(bowl, "open edges", "Sample Surface", array=("POINTS", "Elevation"))
        points = simple.Elevation(simple.PointSource())
        self.check_error(points, "no cells of a length, area or volume", "Splat Mass",
                         array=("POINTS", "Elevation"))

    def test_resolution_out_of_range(self):
        self.check_error(uneven_grid(), "DensityResolution is 0; it must be from 1 to 1073741824",
                         DensityResolution=0)
        self.check_error(uneven_grid(), "see DensityResolution", DensityResolution=100000)

    def test_nothing_yet(self):
        for data in (vtkMultiBlockDataSet(), blocks_of(vtkPolyData()), vtkRectilinearGrid()):
            sampler = simple.SampleDensity(producer(simple, data))
            reported = Listener(sampler.GetClientSideObject())
            self.assertEqual(output_of(sampler).GetNumberOfPoints(), 0)
            self.assertEqual(reported.errors, [])

    def test_second_inputs(self):
        """Where the density is the second input it may be of any kind, too."""
        mesh = simple.Tetrahedralize(wavelet(5))
        particles = simple.SampleDensity(mesh, DensityArray=["POINTS", "RTData"],
                                         DensityResolution=40, NumberOfParticles=2000)
        quality = output_of(simple.TransportQuality(particles, Density=mesh, DensityResolution=40,
                                                    DensityArray=["POINTS", "RTData"]))
        self.assertLess(quality.GetColumnByName("DensityError").GetValue(0), 0.1)
        self.assertEqual(quality.GetColumnByName("InEmptyCells").GetValue(0), 0)
        cut = simple.Slice(wavelet(5))
        dots = simple.SampleDensity(cut, DensityArray=["POINTS", "RTData"], NumberOfParticles=300)
        relaxed = output_of(simple.RelaxBlueNoise(dots, Density=cut, MaximumIterations=3,
                                                  DensityArray=["POINTS", "RTData"]))
        self.assertEqual(relaxed.GetNumberOfPoints(), 300)
        moved = output_of(simple.DensityEqualizingWarp(mesh, Density=mesh, DensityResolution=20,
                                                       DensityArray=["POINTS", "RTData"]))
        self.assertEqual(moved.GetClassName(), "vtkUnstructuredGrid")


if __name__ == "__main__":
    main()

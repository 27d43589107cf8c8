# SPDX-License-Identifier: BSD-3-Clause
"""The five steps of the page on a raster with gaps, with files as programs write them."""
import os
import struct
import sys
import unittest

import numpy as np
from rt_testing import Listener, OUTPUT, SOURCE, load_plugin, main, output_of, positions
from vtkmodules.util.numpy_support import vtk_to_numpy

simple = load_plugin()
sys.path.insert(0, os.path.join(SOURCE, "Examples"))
import rectified_example
from rectified_raster import CELL, NODATA, island, write_geotiff

example = rectified_example.script("RasterWithGaps")


def geotiff(name, values, nodata=NODATA):
    path = os.path.join(OUTPUT, name)
    write_geotiff(path, values, nodata)
    return simple.GDALRasterReader(FileName=path)


def netcdf(name, values, fill):
    """A variable of y and x in a classic netCDF file, with its fill value."""
    def text(string):
        return struct.pack(">i", len(string)) + string.encode() + b"\0" * (-len(string) % 4)

    def header(begin):
        rows, columns = values.shape
        return (b"CDF\1" + struct.pack(">iii", 0, 10, 2) + text("y") + struct.pack(">i", rows) +
                text("x") + struct.pack(">iiiii", columns, 0, 0, 11, 1) + text("people") +
                struct.pack(">iiiii", 2, 0, 1, 12, 1) + text("_FillValue") +
                struct.pack(">iif", 5, 1, fill) + struct.pack(">iii", 5, values.size * 4, begin))
    path = os.path.join(OUTPUT, name)
    with open(path, "wb") as file:
        file.write(header(len(header(0))) + values.astype(">f4").tobytes())
    return simple.NetCDFReader(FileName=[path])


def land_of(raster, array=("CELLS", "Elevation")):
    return simple.Threshold(Input=raster, Scalars=list(array), LowerThreshold=0, UpperThreshold=1e9)


def box(data):
    """The part of the island's raster, along x and y."""
    low, high = np.array(data.GetBounds()).reshape(3, 2)[:2].T
    return (high - low) / CELL / island().shape[::-1]


class Gaps(unittest.TestCase):
    def setUp(self):
        self.people = geotiff("people.tif", island())
        self.land = land_of(self.people)

    def warp(self, density, **properties):
        """The moved land; the filter must say nothing but which cells turned over."""
        filter_ = simple.DensityEqualizingWarp(self.land, Density=density, **properties)
        reported = Listener(filter_.GetClientSideObject())
        moved = output_of(filter_)
        self.assertEqual(reported.errors, [])
        self.assertEqual([line for line in reported.warnings if "turned over" not in line], [])
        return moved

    def test_five_steps(self):
        land, moved = output_of(self.land), self.warp(self.people)
        self.assertEqual(land.GetNumberOfCells(), (island() != NODATA).sum())
        self.assertEqual(moved.GetFieldData().GetArray("FoldedCells").GetValue(0), 0)
        # The areas are right, and the land as a whole keeps its own.
        self.assertLess(example.largest_error(land, moved), 0.01)
        x, y = np.moveaxis(example.corners(moved), 2, 0)
        area = 0.5 * (x * np.roll(y, -1, 1) - y * np.roll(x, -1, 1)).sum()
        self.assertAlmostEqual(area / (land.GetNumberOfCells() * CELL ** 2), 1, 2)
        self.assertTrue((box(moved) < 0.9).all(), box(moved))

    def test_without_the_remedy(self):
        """Empty cells that count as nothing let the land fill the raster."""
        self.assertTrue((box(self.warp(self.people, EmptyCells="Zero")) > 0.97).all())

    def test_a_file_that_names_no_value(self):
        """What the error says helps, and gives the bits of the file that does."""
        raster = geotiff("unnamed.tif", island(), None)
        filter_ = simple.DensityEqualizingWarp(self.land, Density=raster)
        reported = Listener(filter_.GetClientSideObject())
        filter_.UpdatePipeline()
        self.assertIn("%d negative values; NegativeValues = Clamp takes them as 0, ValidRange as missing"
                      % (island() == NODATA).sum(), reported.errors[0])
        moved = self.warp(raster, ValidRange=[0, 1e299])
        np.testing.assert_array_equal(positions(moved), positions(self.warp(self.people)))

    def test_netcdf(self):
        """The reader's NaN, and values out of range, are the same; without either there is advice."""
        values = np.where(island() == NODATA, 1e20, island())[::-1]
        raw = netcdf("people.nc", values, 1e20)
        nan = netcdf("people-nan.nc", values, 1e20)
        nan.ReplaceFillValueWithNan = 1
        if not np.isnan(vtk_to_numpy(output_of(nan).GetPointData().GetArray("people"))).any():
            nan = netcdf("people-nan.nc", np.where(values == 1e20, np.nan, values), np.nan)  # 5.13 does nothing
        results = {}
        for name, source, properties in (("range", raw, dict(ValidRange=[0, 1e10])),
                                         ("nan", nan, dict(NaNValues="Empty"))):
            mapped = output_of(simple.TransportMap(source, EmptyCells="Mean", **properties))
            results[name] = np.array(mapped.GetPointData().GetArray("Displacement").GetRange(-1))
            self.assertEqual(mapped.GetNumberOfPoints(), island().size)
        np.testing.assert_array_equal(results["range"], results["nan"])
        for source, kind, text in ((raw, "warnings", "carries 100 % of the mass; if it marks missing data, "
                                    "ValidRange = -1e+299 "),
                                   (nan, "errors", "NaN or infinite; NaNValues = Empty takes NaN as empty")):
            filter_ = simple.TransportMap(source)
            reported = Listener(filter_.GetClientSideObject())
            filter_.UpdatePipeline()
            self.assertIn(text, getattr(reported, kind)[0])

    def test_districts(self):
        """The five steps of the page on parts of equal population: exact by Power, within a cell of the
        raster by Flow, whose polygons end at the coast."""
        parts = 12
        sites = simple.SampleDensity(self.people, NumberOfParticles=parts)
        middles = simple.RelaxBlueNoise(sites, Density=self.people, Method="OptimalTransport",
                                        MaximumIterations=50)
        land = island()[island() != NODATA]
        share = land.sum() * CELL ** 2 / parts
        for shape, off in ("Power", 1e-6 * share), ("Flow", land.max() * CELL ** 2):
            with self.subTest(shape):
                cells = simple.EqualMassCells(middles, Domain=self.people, Measure="Density", Shape=shape)
                output_of(cells)
                outputs = [cells.GetClientSideObject().GetOutputDataObject(port) for port in (1, 3)]
                masses = vtk_to_numpy(outputs[0].GetPointData().GetArray("CellMass"))
                self.assertEqual(len(masses), parts)
                self.assertLess(abs(masses - share).max(), off)
                found = vtk_to_numpy(outputs[1].GetCellData().GetArray("SiteId"))
                self.assertEqual(set(found), set(range(parts)))
        triangles = simple.Triangulate(simple.OutputPort(cells, 3))
        sizes = output_of(simple.CellSize(triangles)).GetCellData().GetArray("Area")
        beyond = vtk_to_numpy(sizes).sum() / (land.size * CELL ** 2) - 1  # pixels that are land in part
        self.assertTrue(0 <= beyond < 0.02, beyond)

    def test_margin(self):
        """Land that touches the border of the raster moves beyond it."""
        cut = island()[:, 60:-60]
        raster = geotiff("cut.tif", cut)
        self.land = land_of(raster)
        low, high = output_of(raster).GetBounds()[:2]
        tight, loose = (self.warp(raster, Margin=margin).GetBounds()[:2] for margin in (0, 0.2))
        self.assertLess(abs(tight[0] - low) + abs(tight[1] - high), 1e-6 * (high - low))
        self.assertTrue(loose[0] < low - CELL or loose[1] > high + CELL, (loose, low, high))


if __name__ == "__main__":
    main()

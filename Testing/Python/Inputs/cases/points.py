# SPDX-License-Identifier: BSD-3-Clause
"""Particles of simulations, and points of scanners."""
import numpy as np

from .case import (Result, case, cloud, expect_error, image, simple, source)


def splat(data, reference=None, **properties):
    filter_ = simple.SplatMass(source(data), **properties)
    if reference is not None:
        filter_.Reference = source(reference)
    return Result(filter_)


def box(count=8, size=1.0):
    """An image of a cube of cells that lends its geometry."""
    return image(np.ones((count,) * 3), spacing=(size / count,) * 3)


def total(result, cells=False):
    """The sum of the output by the measure of a cell."""
    return result.values("Density", cells).sum() * np.prod(result.data.GetSpacing())


@case(91)
def particles_on_the_far_face(check):
    """Positions in single precision, rounded up onto the far face of a periodic box.

    Source: yt-project/yt pull request 2034, BLAST-WarpX/warpx issue 3347 (particles were lost).
    Right: none is lost, with any kernel.
    """
    size = 0.1  # more than its nearest number in single precision by 1.5e-9, or less
    edge = np.float32(size)
    places = np.random.default_rng(20).random((500, 3)).astype(np.float32) * edge
    places[:60, 0] = edge
    places[60:80] = edge
    places[80:90, 1] = 0
    for kernel in ("CloudInCell", "NearestCell", "TriangularShapedCloud", "Gaussian"):
        result = splat(cloud(places), box(16, size), Kernel=kernel, Association="Cells")
        check.assertEqual((result.errors, result.warnings), ([], []))
        check.assertAlmostEqual(result.field("TotalMass"), 500, 9)
        check.assertAlmostEqual(total(result, True), 500, 9)


@case(92)
def masses_of_ten_billion(check):
    """Masses of 1e10 suns in single precision, 300,000 of them.

    Source: kateharborne/SimSpin issue 8 (units of 1e10), pynbody/pynbody issue 321.
    Right: their sum in double precision; in single precision it is 1e-4 off.
    """
    random = np.random.default_rng(21)
    masses = (random.lognormal(0, 1, 300000) * 1e10).astype(np.float32)
    data = cloud(random.random((300000, 3)).astype(np.float32), Mass=masses)
    result = splat(data, MassArray="Mass", Dimensions=[32, 32, 32])
    check.assertEqual(result.errors, [])
    check.assertAlmostEqual(result.field("TotalMass") / masses.sum(dtype=float), 1, 12)
    check.assertAlmostEqual(total(result) / masses.sum(dtype=float), 1, 11)


@case(93)
def particles_without_mass(check):
    """Half of the particles are tracers, whose mass is zero.

    Source: pynbody/pynbody issue 321 (masses that the file does not have), yt-project/yt issue 896.
    Right: the sum of the others, and a density that is finite everywhere.
    """
    random = np.random.default_rng(22)
    masses = np.where(np.arange(400) % 2, 0.0, 2.5)
    result = splat(cloud(random.random((400, 3)), Mass=masses), MassArray="Mass",
                   Dimensions=[9, 8, 7])
    check.assertEqual(result.errors, [])
    check.assertAlmostEqual(total(result), 500, 9)
    nothing = splat(cloud(random.random((5, 3)), Mass=np.zeros(5)), MassArray="Mass",
                    Dimensions=[4, 4, 4])
    check.assertLessEqual(len(nothing.errors), 1)
    if not nothing.errors:
        check.assertTrue((nothing.values("Density") == 0).all())


@case(94)
def wide_kernels(check):
    """Smoothed particles, whose kernels are wider than the box is far from them.

    Source: yt-project/yt issues 4053 and 4818 (the smoothed mass was not the particles').
    Right: the masses' sum, however wide the kernel is.
    """
    random = np.random.default_rng(23)
    masses = random.random(200) + 0.1
    data = cloud(random.random((200, 3)), Mass=masses)
    for radius in (0.5, 3, 20):
        result = splat(data, box(), MassArray="Mass", Kernel="Gaussian", Radius=radius,
                       Association="Cells")
        check.assertAlmostEqual(total(result, True) / masses.sum(), 1, 11)


@case(95)
def laser_scan_in_metres_of_a_zone(check):
    """Points a millimetre apart, at a northing of five million metres.

    Source: CloudCompare/CloudCompare issue 638, koide3/hdl_graph_slam issue 182 (metres lost).
    Right: the mass, and the centroid to a hundredth of a cell of 5 mm (kernels are cut at the border).
    """
    origin = np.array([481234.5, 5572094.155411, 101.25])
    offsets = np.random.default_rng(24).random((1000, 3)) * 0.1
    result = splat(cloud(origin + offsets), Dimensions=[20, 20, 20], Association="Cells")
    check.assertEqual(result.errors, [])
    check.assertAlmostEqual(result.field("TotalMass"), 1000, 9)
    masses = result.values("Density", True)
    centres = np.array([
        [low + (i + 0.5) * step for i in range(20)]
        for low, step in zip(result.data.GetBounds()[::2], result.data.GetSpacing())])
    shape = masses.reshape(20, 20, 20)
    for axis in range(3):
        shares = shape.sum(axis=tuple(2 - other for other in range(3) if other != axis))
        centroid = (shares * (centres[axis] - origin[axis])).sum() / shares.sum()
        check.assertAlmostEqual(centroid, offsets[:, axis].mean(), delta=5e-5)


@case(96)
def points_without_a_return(check):
    """A scanner writes NaN for a beam that did not come back.

    Source: isl-org/Open3D issues 1188 and 1016, hku-mars/FAST_LIO pull request 363 (other points
    spoilt).
    Right: one error that counts them and names the first, of every filter that takes points.
    """
    places = np.random.default_rng(25).random((50, 3))
    places[[7, 9]] = np.nan
    density = image(np.ones((4, 4, 4)), spacing=(0.25,) * 3)
    for result in (splat(cloud(places)), splat(cloud(places), density),
                   Result(simple.RelaxBlueNoise(source(cloud(places)), Density=source(density))),
                   Result(simple.EqualMassCells(source(cloud(places)), Resolution=16)),
                   Result(simple.DensityEqualizingWarp(source(cloud(places)),
                                                       Density=source(density)))):
        expect_error(check, result, "2 ", "index 7")


@case(97)
def stations_at_one_place(check):
    """Two stations of an underground line have the same coordinates.

    Source: d3/d3 issue 235, glotzerlab/freud issue 841 (the program ended), pysal/libpysal issue 164.
    Right: every station has a cell, and the cells add up to the box.
    """
    places = np.random.default_rng(26).random((12, 2)) * 40
    places[5] = places[2]
    result = Result(simple.EqualMassCells(source(cloud(places)), Resolution=60))
    check.assertEqual(result.errors, [])
    sites = result.algorithm.GetOutputDataObject(1).GetPointData().GetArray("CellMass")
    masses = np.array([sites.GetTuple1(i) for i in range(12)])
    bounds = np.array(result.data.GetBounds()).reshape(3, 2)
    area = np.prod(np.ptp(bounds[:2], axis=1))
    check.assertAlmostEqual(masses.sum() / area, 1, 9)
    check.assertLess(np.abs(masses / masses.mean() - 1).max(), 0.05)


@case(98)
def duplicates_are_spread(check):
    """Points of whole numbers, many of them twice.

    Source: RudyTheDev/SharpVoronoiLib issue 7 (NaN after relaxation), JCash/voronoi issue 4.
    Right: after relaxation all are finite, inside, and no two in one place.
    """
    places = np.random.default_rng(27).integers(0, 12, (200, 2)).astype(float) / 12
    check.assertLess(len(np.unique(places, axis=0)), 150)
    density = image(np.ones((16, 16)), spacing=(1 / 16, 1 / 16, 1))
    for method in ("GaussianBlueNoise", "OptimalTransport"):
        result = Result(simple.RelaxBlueNoise(source(cloud(places)), Density=source(density),
                                              Method=method))
        check.assertEqual(result.errors, [])
        found = result.places()
        check.assertTrue(np.isfinite(found).all())
        check.assertTrue((found[:, :2] >= 0).all() and (found[:, :2] <= 1).all())
        check.assertEqual(len(np.unique(found, axis=0)), 200)


@case(99)
def particles_beyond_the_border(check):
    """A flow that carries particles a whole box to the right, written before they are put back.

    Source: fbpic/fbpic pull request 9 (out of bounds), AutoPas/AutoPas issue 495.
    Right: their number is a warning; their mass is at the border, or lost with Drop.
    """
    places = np.random.default_rng(28).random((300, 3))
    places[:40, 0] += 1.25
    kept = splat(cloud(places), box(), Association="Cells")
    check.assertEqual(kept.errors, [])
    check.assertEqual(len(kept.warnings), 1)
    check.assertIn("40 of 300", kept.warnings[0])
    check.assertAlmostEqual(total(kept, True), 300, 9)
    dropped = splat(cloud(places), box(), Association="Cells", Boundary="Drop",
                    Kernel="NearestCell")
    check.assertAlmostEqual(total(dropped, True), 260, 9)


@case(100)
def one_particle(check):
    """A halo of one particle.

    Source: yt-project/yt pull request 2034 (haloes of few particles).
    Right: without a box an error that says what to connect; with one its mass.
    """
    expect_error(check, splat(cloud([[0.5, 0.5, 0.5]])), "Reference")
    result = splat(cloud([[0.5, 0.5, 0.5]], Mass=np.array([3e10])), box(), MassArray="Mass",
                   Association="Cells")
    check.assertAlmostEqual(total(result, True) / 3e10, 1, 12)

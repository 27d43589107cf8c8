# SPDX-License-Identifier: BSD-3-Clause
"""Outlines of maps: polygons and closed lines."""
import time

import numpy as np

from .case import Result, blocks, case, expect_mass, polygons, rings, simple, source

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def moved(outline, x, y, scale=1.0):
    return [(x + scale * a, y + scale * b) for a, b in outline]


@case(9)
def lake_in_a_country(check):
    """A country whose lake is drawn by going to it and back, beside another country.

    Source: three-geojson issue 31, Cesium issue 3044.
    Right: 36 - 4, and 6.
    """
    outline = moved(SQUARE, 0, 0, 6) + [(0, 0)] + [(2, 2), (2, 4), (4, 4), (4, 2), (2, 2)]
    expect_mass(check, rings(outline, [(7, 0), (8, 0), (8, 6), (7, 6)]), 32 + 6, 1e-6)


@case(11)
def spike(check):
    """An outline that runs out and back on itself, outside or inside.

    Source: gkjohnson/three-geojson issue 31.
    Right: a spike has no area.
    """
    out = [(0, 0), (3, 0), (3, 1), (5, 1), (3, 1), (3, 3), (0, 3)]
    into = [(0, 0), (3, 0), (3, 1), (1, 1), (3, 1), (3, 3), (0, 3)]
    for outline in (out, into):
        expect_mass(check, rings(outline, values=[2]), 18, 1e-6)


@case(18)
def outlines_of_a_map_reader(check):
    """Shells and holes as closed lines, as ParaView's GDAL Vector Reader gives a map: a block a
    feature.

    Source: mgastner/cartogram-cpp, its sample data.
    Right by the even-odd rule: 3 x (36 - 4) + 5 x 6.
    """
    places = moved(SQUARE, 0, 0, 6) + [(2, 2), (2, 4), (4, 4), (4, 2)] + [
        (7, 0), (8, 0), (8, 6), (7, 6)]
    closed = [[0, 1, 2, 3, 0], [4, 5, 6, 7, 4], [8, 9, 10, 11, 8]]
    expect_mass(check, polygons(places, closed, [3, 3, 5], lines=True), 126, 1e-6)
    features = blocks(polygons(places[:8], closed[:2], [3, 3], lines=True),
                      polygons(places[8:], [[0, 1, 2, 3, 0]], [5], lines=True))
    expect_mass(check, features, 126, 1e-6)


@case(20)
def coast_of_many_points(check):
    """One outline of 20,000 points.

    Source: Cesium pull request 947, mapbox/earcut issue 3, csiro-coasts/emsarray pull request
    151.
    Right: the area by the shoelace formula, in seconds.
    """
    count = 20000
    angles = np.arange(count) / count * 2 * np.pi
    radii = 1 + 0.3 * np.random.default_rng(32).random(count)
    coast = np.c_[radii * np.cos(angles), radii * np.sin(angles)]
    x, y = coast.T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    start = time.perf_counter()
    expect_mass(check, rings(coast), area, 1e-6, count=100, DensityResolution=1024)
    check.assertLess(time.perf_counter() - start, 10)  # on a loaded machine, too


@case(61)
def bow_tie(check):
    """An outline that crosses itself, beside a square.

    Source: locationtech/jts issue 652 (what an invalid polygon stands for).
    Right by the even-odd rule: two triangles of area 1, and the square's 4.
    """
    tie = [(0, 0), (2, 2), (2, 0), (0, 2)]
    expect_mass(check, rings(tie, moved(SQUARE, 5, 0, 2)), 2 + 4, 1e-6)


@case(62)
def ring_that_meets_itself(check):
    """A hole that touches the border is drawn in one stroke: the outline meets itself in a point.

    Source: GIScience/oshdb issue 471, osmose-qa/osmose-backend issue 776.
    Right: 8 - 1.
    """
    outline = [(0, 0), (0, 2), (2, 2), (1, 1), (3, 1), (2, 2), (4, 2), (4, 0)]
    expect_mass(check, rings(outline), 7, 1e-6)
    shared = [(0, 0), (0, 2), (2, 2), (1, 1), (3, 1), (4, 2), (4, 0)]
    expect_mass(check, polygons(shared, [[0, 1, 2, 3, 4, 2, 5, 6]], [1]), 7, 1e-6)


@case(63)
def closing_point_given_twice(check):
    """The last point of the ring is the first again, and corners are there twice.

    Source: ianmackenzie/elm-geometry issue 49, benbovy/spherely issue 42, sgsellan/gpytoolbox issue 34.
    Right: the square's area, for equal ids and for equal places.
    """
    expect_mass(check, rings(SQUARE + SQUARE[:1]), 1)
    expect_mass(check, polygons(SQUARE, [[0, 1, 2, 3, 0]], [1]), 1)
    expect_mass(check, rings([SQUARE[0], SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[2], SQUARE[3]]), 1)


@case(64)
def region_smaller_than_a_pixel(check):
    """A city-state beside a country of ten thousand times its size.

    Source: perrygeo/python-rasterstats issues 262 and 243 (polygons smaller than a pixel were lost).
    Right: both masses, whatever the resolution.
    """
    data = rings(moved(SQUARE, 0, 0, 100), moved(SQUARE, 130, 40.3, 0.01), values=[1, 1e8])
    for resolution in (64, 256):
        found = expect_mass(check, data, 1e4 + 1e4, DensityResolution=resolution).places()
        check.assertAlmostEqual((found[:, 0] > 110).mean(), 0.5, 2)


@case(65)
def holes_that_touch(check):
    """Closed lines of one feature: a shell and two holes that have an edge in common.

    Source: osmcode/libosmium issue 225, mapbox/earcut pull request 177.
    Right by the even-odd rule: 36 - 4 - 4.
    """
    shell = moved(SQUARE, 0, 0, 6)
    places = shell + moved(SQUARE, 1, 1, 2) + moved(SQUARE, 3, 1, 2)
    data = polygons(places, [[0, 1, 2, 3, 0], [4, 5, 6, 7, 4], [8, 9, 10, 11, 8]], [1, 1, 1],
                    lines=True)
    expect_mass(check, data, 28, 1e-6)


@case(66)
def sliver(check):
    """A strip between two countries that do not quite meet, a billionth as wide as long.

    Source: locationtech/jts issue 652 (polygons that are nearly lines).
    Right: the areas add up, the sliver's among them.
    """
    width = 1e-9
    strip = [(1, 0), (1 + width, 0), (1 + width, 1), (1, 1)]
    data = rings(SQUARE, strip, moved(SQUARE, 1 + width, 0), values=[1, 1e9, 2])
    expect_mass(check, data, 1 + 1e9 * ((1 + width) - 1) + 2, 1e-6)


@case(67)
def outlines_in_metres_of_a_zone(check):
    """Houses of ten metres, in coordinates of half a million and five million metres.

    Source: CloudCompare/CloudCompare issue 638, potree/PotreeConverter issue 105 (digits lost).
    Right: 100 square metres each.
    """
    data = rings(moved(SQUARE, 500000.5, 5572094.155411, 10), moved(SQUARE, 500012.5, 5572094.2, 10),
                 values=[1, 2])
    found = expect_mass(check, data, 300, 1e-6).places()
    check.assertTrue((found[:, 0] >= 500000.5 - 1e-6).all())
    check.assertTrue((found[:, 0] <= 500022.5 + 1e-6).all())


@case(68)
def concave_face_of_a_model(check):
    """A wall with a niche: a polygon of eleven corners that is not convex.

    Source: mikedh/trimesh issue 2519 and pull request 2560 (a fan of triangles made it larger),
    javagl/Obj issue 8.
    Right: its area by the shoelace formula, as a density and as a surface.
    """
    wall = np.array([(0, 0), (3, 0), (3, 2), (4, 2), (4, 0), (9, 0), (9, 5), (6, 5), (6, 3), (5, 3),
                     (0, 5)], float)
    x, y = wall.T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    for turn in (0, 3, 7):
        data = rings(np.roll(wall, turn, axis=0))
        expect_mass(check, data, area, 1e-9)
        surface = Result(simple.SampleSurface(source(data), NumberOfParticles=500))
        check.assertEqual(surface.errors, [])
        check.assertAlmostEqual(surface.field("TotalMass") / area, 1, 9)

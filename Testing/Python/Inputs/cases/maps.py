# SPDX-License-Identifier: BSD-3-Clause
"""Maps as other filters and files leave them."""
import os
from xml.dom import minidom

import numpy as np
from vtkmodules.util.vtkConstants import VTK_POLYGON, VTK_TRIANGLE_STRIP
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import (VTK_BIQUADRATIC_QUAD, VTK_BIQUADRATIC_TRIANGLE, VTK_QUADRATIC_POLYGON,
                                           VTK_QUADRATIC_QUAD, VTK_QUADRATIC_TRIANGLE)

from .case import Result, blocks, case, mesh, named, polygons, rings, simple, source


def squares(places, side=1.0):
    return [[(x, y), (x + side, y), (x + side, y + side), (x, y + side)] for x, y in places]


NINE = squares([(x, y) for y in range(3) for x in range(3)])


def cartogram(data, **properties):
    return Result(simple.Cartogram(Input=source(data), MassArray=["CELLS", "v"], Resolution=128, **properties))


def shares(result, cells=None):
    """Of the areas of the cells, by the shoelace formula."""
    areas = []
    for cell in range(result.data.GetNumberOfCells()) if cells is None else cells:
        points = result.data.GetCell(cell).GetPoints()
        x, y = np.array([points.GetPoint(i)[:2] for i in range(points.GetNumberOfPoints())]).T
        areas.append(abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2)
    return np.array(areas) / np.sum(areas)


@case(134)
def areas_of_degrees(check):
    """A map in longitudes and latitudes, whose areas are not those of the ground.

    Source: go_cart issue 26, and threads on geopandas and sf.
    Right: R^2 dlon (sin lat2 - sin lat1), and a warning where nothing projects it.
    """
    south, north = np.array([-56.0, -40.0]), np.array([-44.0, -36.0])
    outlines = [[(10, a), (12, a), (12, b), (10, b)] for a, b in zip(south, north)]
    data = rings(*outlines, values=[1, 2])
    check.assertIn("look like degrees", cartogram(data).warnings[0])
    result = cartogram(data, Projection="EqualArea")
    check.assertEqual(result.errors + result.warnings, [])
    ground = 6371.0 ** 2 * np.radians(2) * (np.sin(np.radians(north)) - np.sin(np.radians(south)))
    check.assertLess(abs(result.values("MassPerArea", True) * ground / [1, 2] - 1).max(), 1e-9)


@case(136)
def regions_of_a_grid(check):
    """Regions that Threshold and Append left: an unstructured grid of polygons.

    Source: sjewo/cartogram pull request 22, terra issue 1912 (features without a number left out first).
    Right: areas in proportion to the masses.
    """
    values = np.arange(9.0)
    ids = np.arange(36).reshape(9, 4)
    grid = mesh(np.concatenate(NINE), [(VTK_POLYGON, i) for i in ids], values)
    some = simple.Threshold(Input=source(grid), Scalars=["CELLS", "v"], LowerThreshold=1, UpperThreshold=9)
    result = cartogram(some)
    check.assertEqual(result.errors + result.warnings, [])
    check.assertLess(abs(shares(result) - values[1:] / values.sum()).max(), 0.01 / 9)


@case(161)
def river_in_a_map(check):
    """A file with a river, which has no number, among the regions.

    Source: files of OpenStreetMap.
    Right: the regions have their shares, the river is there, and a warning names it.
    """
    places = np.array(sum(NINE, []) + [(0.5, 0.5), (1.5, 2.5), (2.9, 2.9)])
    closed = [[*range(4 * i, 4 * i + 4), 4 * i] for i in range(9)]
    lines = closed[:4] + [[36, 37, 38]] + closed[4:]
    values = [1, 2, 3, 1, np.nan, 2, 3, 1, 2, 3]
    result = cartogram(polygons(places, lines, values, lines=True))
    check.assertEqual(result.errors, [])
    check.assertIn("1 of 10 lines of the input do not close (the first is cell 4)", result.warnings[0])
    check.assertGreater(result.data.GetCell(4).GetNumberOfPoints(), 3)
    regions = [0, 1, 2, 3, 5, 6, 7, 8, 9]
    check.assertLess(abs(shares(result, regions) - np.array(values)[regions] / 18).max(), 0.01 / 9)


@case(162)
def outline_that_crosses_itself(check):
    """Two corners of an outline are in the wrong order, as hand-drawn maps and simplified ones have it.

    Source: locationtech/jts issue 652.
    Right: both loops count, 2 of 6, with a mass of 3 of 5.
    """
    data = rings([(0, 0), (2, 2), (2, 0), (0, 2)], [(3, 0), (5, 0), (5, 2), (3, 2)], values=[3, 2])
    result = cartogram(data)
    check.assertEqual(result.errors + result.warnings, [])
    check.assertLess(abs(result.values("MassPerArea", True) / [3 / 2, 2 / 4] - 1).max(), 1e-12)
    check.assertLess(abs(result.values("TargetArea", True) / [3.6, 2.4] - 1).max(), 1e-12)


@case(163)
def region_that_is_there_twice(check):
    """A feature that a file has twice, and one with another number in the same place.

    Source: geopandas and QGIS (duplicate geometries).
    Right: with one number all areas; with two the advice to leave one of them, which helps.
    """
    data = rings(*NINE, NINE[4], values=[1, 2, 3, 1, 2, 3, 1, 2, 3, 2])
    result = cartogram(data)
    check.assertEqual(len(result.warnings), 1, result.warnings)
    check.assertLess(abs(shares(result) - np.array([1, 2, 3, 1, 2, 3, 1, 2, 3, 2]) / 20).max(), 0.001)
    result = cartogram(rings(*NINE, NINE[4], values=[1, 2, 3, 1, 2, 3, 1, 2, 3, 9]))
    check.assertIn("leave one of them in each place, with Threshold", result.warnings[-1])
    check.assertEqual(cartogram(rings(*NINE, values=[1, 2, 3] * 3)).warnings, [])


@case(164)
def islands_on_both_sides_of_180(check):
    """Islands of one state at both ends of a map: Fiji, or Russia's east.

    Source: threads on GeoJSON's rule to cut at the antimeridian (RFC 7946, section 3.1.9).
    Right: the state's share of the area, on both sides together.
    """
    outlines = [[(lon, -19), (lon + 2, -19), (lon + 2, -16), (lon, -16)] for lon in (178, -180, 172, 175)]
    data = rings(*outlines, values=[5, 5, 1, 2])
    data.GetCellData().AddArray(named(np.array([0, 0, 1, 2]), "state"))
    result = cartogram(data, Projection="EqualArea", RegionArray=["CELLS", "state"])
    check.assertEqual(result.errors + result.warnings, [])
    parts = shares(result)
    check.assertLess(abs(np.array([parts[0] + parts[1], parts[2], parts[3]]) * 8 / [5, 1, 2] - 1).max(), 0.01)


@case(165)
def world_to_the_poles(check):
    """The world with Antarctica, whose outline runs along 90 degrees south; longitudes from 0 to 360.

    Source: threads on Mercator maps of Natural Earth, where this line is at infinity.
    Right: the whole sphere, 4 pi R^2.
    """
    for west in (-180, 0):
        data = rings(*[[(west, a), (west + 360, a), (west + 360, b), (west, b)]
                       for a, b in ((-90, -60), (-60, 90))], values=[1, 9])
        result = cartogram(data, Projection="EqualArea")
        check.assertEqual(result.errors + result.warnings, [])
        ground = [1, 9] / result.values("MassPerArea", True)
        check.assertLess(abs(ground.sum() / (4 * np.pi * 6371.0 ** 2) - 1), 1e-9)


@case(166)
def drawing_far_from_the_origin(check):
    """Houses in metres of UTM, half a million and five million, on a page.

    Source: CloudCompare issue 638 (digits lost), threads on SVG files of maps in Inkscape.
    Right: places on the page to a thousandth of a millimetre.
    """
    data = rings(*squares([(500000.25 + 10 * i, 5200000.125) for i in range(3)], 10), values=[1, 2, 3])
    path = os.path.join(os.environ["RT_OUTPUT"], "houses.svg")
    simple.SaveData(path, proxy=source(data), Width=90)
    drawn = [node.getAttribute("points") for node in minidom.parse(path).getElementsByTagName("polygon")]
    corners = np.array([[xy.split(",") for xy in points.split()] for points in drawn], float)
    right = (np.array(squares([(10 * i, 0) for i in range(3)], 10)) / 30 * 89.75 + 0.125)[..., 0]
    check.assertLess(abs(corners[..., 0] - right).max(), 1e-3)


def texts(values):
    array = vtkStringArray()
    for value in values:
        array.InsertNextValue(value)
    return array


@case(168)
def maps_of_several_files(check):
    """Two files of one map, whose reader gives the people and the numbers of the states in other types.

    Source: the driver of GDAL for GeoJSON, which takes the type of a column from its values; GDAL for
    shapefiles, where it is the width of the column.
    Right: areas in proportion to the people of the states, in all.
    """
    for people, states in (
            (([1, 2], [2.0, 4.0]), ([7, 8], [8.0, 9.0])),
            (([1, 2], ["2", "4.0"]), (np.array([7, 8], "i4"), np.array([8, 9], "i8"))),
            ((np.array([1, 2], "f4"), np.array([2, 4], "u1")), (["7", "8"], np.array([8, 9], "u1"))),
            (([1, 2], [2, 4]), (np.array([5, 2**53 + 1], "i8"), np.array([2**53 + 1, 2**53], "u8")))):
        parts = []
        for i in range(2):
            data = rings(*NINE[2 * i:2 * i + 2])
            data.GetCellData().Initialize()
            for name, values in (("v", people[i]), ("state", states[i])):
                array = texts(values) if isinstance(values[0], str) else named(np.asarray(values))
                array.SetName(name)
                data.GetCellData().AddArray(array)
            parts.append(data)
        result = cartogram(blocks(*parts), RegionArray=["CELLS", "state"])
        check.assertEqual(result.errors + result.warnings, [])
        found = shares(result)
        right = np.array([1, 2, 4]) / 7
        check.assertLess(abs(np.array([found[0], found[1] + found[2], found[3]]) - right).max(), 0.003)


@case(169)
def regions_of_curved_cells(check):
    """A map whose regions are triangle strips, as Stripper leaves them, or quadratic cells of a solver.

    Source: threads on VTK's Stripper and on meshes of second order.
    Right: a cell is a region, with its share; the points on its edges are corners, too.
    """
    places = [(0, 0), (2, 0), (2, 2), (0, 2), (4, 0), (4, 2), (1, 0), (2, 1), (1, 2), (0, 1), (3, 0), (4, 1),
              (3, 2), (1, 1), (3, 1), (3, 1)]
    kinds = ((VTK_TRIANGLE_STRIP, [0, 1, 3, 2], [1, 4, 2, 5]),
             (VTK_QUADRATIC_QUAD, [0, 1, 2, 3, 6, 7, 8, 9], [1, 4, 5, 2, 10, 11, 12, 7]),
             (VTK_BIQUADRATIC_QUAD, [0, 1, 2, 3, 6, 7, 8, 9, 13], [1, 4, 5, 2, 10, 11, 12, 7, 14]),
             (VTK_QUADRATIC_POLYGON, [0, 1, 2, 3, 6, 7, 8, 9], [1, 4, 5, 2, 10, 11, 12, 7]),
             (VTK_QUADRATIC_TRIANGLE, [0, 1, 2, 6, 7, 13], [1, 4, 5, 10, 11, 14]),
             (VTK_BIQUADRATIC_TRIANGLE, [0, 1, 2, 6, 7, 13, 13], [1, 4, 5, 10, 11, 14, 14]))
    for kind, first, second in kinds:
        result = cartogram(mesh(places, [(kind, first), (kind, second)], [1, 3]))
        check.assertEqual(result.errors + result.warnings, [], kind)
        area = 4 if kind in (VTK_QUADRATIC_TRIANGLE, VTK_BIQUADRATIC_TRIANGLE) else 8
        check.assertLess(abs(result.values("TargetArea", True) / [area / 4, 3 * area / 4] - 1).max(), 1e-9, kind)
        check.assertLess(abs(shares(result) - [0.25, 0.75]).max(), 0.003, kind)

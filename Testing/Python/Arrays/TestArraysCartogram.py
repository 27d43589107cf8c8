# SPDX-License-Identifier: BSD-3-Clause
"""arrays.cartogram: regions of any package with __geo_interface__, and the same back."""
import copy
import importlib
import json
import os
import sys
import types
import unittest
import warnings

import numpy as np
from rt_testing import SOURCE, main

from rectifiedtransport import arrays

# Two squares side by side, one of which has a hole that a third region fills, and an island.
RING = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]
HOLE = [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]
EAST = [[4, 0], [8, 0], [8, 4], [4, 4], [4, 0]]
ISLAND = [[1, 6], [3, 6], [3, 8], [1, 8], [1, 6]]
REGIONS = [{"type": "MultiPolygon", "coordinates": [[RING, HOLE], [ISLAND]]},
           {"type": "Polygon", "coordinates": [EAST]},
           {"type": "Polygon", "coordinates": [HOLE[::-1]]}]
AREAS = np.array([19.0, 16.0, 1.0])
MASSES = [10, 30, 2]
QUICK = {"Resolution": 256, "Margin": 0.3}


def area_of(geometry):
    polygons = geometry["coordinates"]
    polygons = polygons if geometry["type"] == "MultiPolygon" else [polygons]

    def ring_area(ring):
        x, y = np.array(ring).T
        return 0.5 * abs(np.dot(x[:-1], y[1:]) - np.dot(x[1:], y[:-1]))
    return sum(ring_area(polygon[0]) - sum(map(ring_area, polygon[1:])) for polygon in polygons)


def shares(values):
    return np.array(values) / np.sum(values)


def module(name):
    """A package that may not be there."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


class Cartogram(unittest.TestCase):
    def check(self, made):
        """Areas in proportion to masses; rings as before, closed."""
        np.testing.assert_allclose(shares([area_of(region) for region in made]), shares(MASSES), rtol=0.02)
        self.assertEqual([region["type"] for region in made], [region["type"] for region in REGIONS])
        self.assertEqual([len(polygon) for polygon in made[0]["coordinates"]], [2, 1])
        for region in made:
            polygons = region["coordinates"]
            for polygon in polygons if region["type"] == "MultiPolygon" else [polygons]:
                for ring in polygon:
                    self.assertEqual(ring[0], ring[-1])

    def test_geometries(self):
        given = copy.deepcopy(REGIONS)
        made = arrays.cartogram(given, MASSES, **QUICK)
        self.assertIsInstance(made, list)
        self.check(made)
        self.assertEqual(given, REGIONS, "the input changed")
        self.assertIsInstance(arrays.cartogram(tuple(REGIONS), MASSES, **QUICK), tuple)
        # The hole's border is that of the region in it.
        self.assertEqual(set(made[0]["coordinates"][0][1]), set(made[2]["coordinates"][0]))

    def test_features(self):
        """Properties and ids stay, bounds of before do not; heights are no part of a map."""
        features = [{"type": "Feature", "id": i, "properties": {"name": "abc"[i]}, "bbox": [0, 0, 8, 8],
                     "geometry": region} for i, region in enumerate(REGIONS)]
        features[1] = json.loads(json.dumps(features[1]).replace("[8, 0]", "[8, 0, 99]"))
        whole = {"type": "FeatureCollection", "name": "map", "bbox": [0, 0, 8, 8], "features": features}
        made = arrays.cartogram(whole, MASSES, **QUICK)
        self.assertEqual(set(made), {"type", "name", "features"})
        self.check([feature["geometry"] for feature in made["features"]])
        self.assertEqual([feature["properties"] for feature in made["features"]],
                         [feature["properties"] for feature in features])
        self.assertEqual([feature["id"] for feature in made["features"]], [0, 1, 2])
        self.assertNotIn("bbox", made["features"][0])
        self.assertEqual(arrays.cartogram(features, MASSES, **QUICK), made["features"])

    def test_objects(self):
        """Of any package with the function shape, as shapely has it."""
        package = types.ModuleType("rt_geometries")

        class Shape:
            __module__ = "rt_geometries"

            def __init__(self, mapping):
                self.__geo_interface__ = mapping
        package.shape = Shape
        sys.modules["rt_geometries"] = package
        self.addCleanup(sys.modules.pop, "rt_geometries")
        made = arrays.cartogram(list(map(Shape, REGIONS)), MASSES, **QUICK)
        self.assertEqual({type(region) for region in made}, {Shape})
        self.check([region.__geo_interface__ for region in made])
        del package.shape
        with self.assertRaisesRegex(TypeError, "no function shape"):
            arrays.cartogram(list(map(Shape, REGIONS)), MASSES, **QUICK)

    @unittest.skipUnless(module("shapely.geometry"), "needs shapely")
    def test_shapely(self):
        shape = module("shapely.geometry").shape
        made = arrays.cartogram(list(map(shape, REGIONS)), MASSES, **QUICK)
        self.assertEqual([region.geom_type for region in made], ["MultiPolygon", "Polygon", "Polygon"])
        self.assertTrue(all(region.is_valid for region in made))
        np.testing.assert_allclose(shares([region.area for region in made]), shares(MASSES), rtol=0.02)

    @unittest.skipUnless(module("geopandas"), "needs GeoPandas")
    def test_geopandas(self):
        geopandas, shape = module("geopandas"), module("shapely.geometry").shape
        series = geopandas.GeoSeries(list(map(shape, REGIONS)), index=["a", "b", "c"], crs="EPSG:3035",
                                     name="borders")
        made = arrays.cartogram(series, MASSES, **QUICK)
        self.assertIsInstance(made, geopandas.GeoSeries)
        self.assertEqual((list(made.index), made.crs, made.name), (["a", "b", "c"], series.crs, "borders"))
        np.testing.assert_allclose(shares(made.area), shares(MASSES), rtol=0.02)
        frame = geopandas.GeoDataFrame({"people": MASSES}, index=series.index, geometry=series)
        made = arrays.cartogram(frame, frame["people"], **QUICK)
        self.assertIsInstance(made, geopandas.GeoDataFrame)
        self.assertEqual((list(made["people"]), made.geometry.name, made.crs),
                         (MASSES, frame.geometry.name, frame.crs))
        np.testing.assert_allclose(shares(made.area), shares(MASSES), rtol=0.02)
        np.testing.assert_allclose(frame.area, AREAS, err_msg="the input changed")
        projected = arrays.cartogram(series.set_crs("EPSG:4326", allow_override=True), MASSES,
                                     Projection="EqualArea", **QUICK)
        self.assertIsNone(projected.crs)
        self.assertGreater(projected.area.sum(), 1e5)  # square kilometres

    def test_a_real_map(self):
        """Of many regions with islands and long borders, which keep their area together."""
        with open(os.path.join(SOURCE, "Testing", "Data", "us-states.geojson"), encoding="utf-8") as file:
            states = json.load(file)
        masses = np.arange(1, len(states["features"]) + 1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # small regions may miss their areas
            made = arrays.cartogram(states, masses, Resolution=512)
        areas = [area_of(feature["geometry"]) for feature in made["features"]]
        self.assertLess(np.median(abs(shares(areas) / shares(masses) - 1)), 0.01)
        before = [area_of(feature["geometry"]) for feature in states["features"]]
        self.assertAlmostEqual(sum(areas) / sum(before), 1, 2)

    def test_refused(self):
        point = {"type": "Point", "coordinates": [0, 0]}
        for error, text, regions, masses in (
                (ValueError, "masses has the shape (2,) and geometries 3 regions", REGIONS, [1, 2]),
                (ValueError, "masses has the shape (0,) and geometries 0 regions", [], []),
                (ValueError, "geometries[1] is a Point", [REGIONS[0], point], [1, 2]),
                (ValueError, "geometries[0] is missing", [{"type": "Feature", "geometry": None}], [1]),
                (ValueError, "geometries[0] is empty", [{"type": "Polygon", "coordinates": []}], [1]),
                (ValueError, "geometries is one Polygon", REGIONS[1], [1]),
                (ValueError, "geometries[1] has a ring whose coordinates", [REGIONS[0], {
                    "type": "Polygon", "coordinates": [[[0, 0], [1, np.nan], [0, 1], [0, 0]]]}], [1, 2]),
                (ValueError, "geometries[0] has a ring whose coordinates", [{
                    "type": "Polygon", "coordinates": [[[0, 0], [1], [0, 1]]]}], [1]),
                (TypeError, "geometries[0] is a str without __geo_interface__", ["Utah"], [1]),
                (ValueError, "masses", REGIONS, [1, -2, 3]), (ValueError, "masses", REGIONS, [1, np.nan, 3]),
                (ValueError, "masses has missing values", REGIONS, [1, None, 3]),
                (TypeError, "masses has values of type", REGIONS, ["a", "b", "c"])):
            with self.subTest(text), self.assertRaises(error) as raised:
                arrays.cartogram(regions, masses, **QUICK)
            self.assertIn(text, str(raised.exception))


if __name__ == "__main__":
    main()

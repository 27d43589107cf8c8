#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a map of the world for cartograms from the npm package world-atlas (Natural Earth, public
domain): countries without Antarctica in Behrmann's equal-area projection, in km, with populations of
about 2020 (populations.csv, after the United Nations' World Population Prospects 2022, rounded).

usage: world_map.py countries-110m.json populations.csv out.geojson
"""
import csv
import json
import math
import sys

RADIUS = 6371.0  # km
STANDARD = math.radians(30.0)


def arcs_of(topology):
    scale, shift = topology["transform"]["scale"], topology["transform"]["translate"]
    arcs = []
    for arc in topology["arcs"]:
        x = y = 0
        points = []
        for dx, dy in arc:
            x, y = x + dx, y + dy
            points.append((x * scale[0] + shift[0], y * scale[1] + shift[1]))
        arcs.append(points)
    return arcs


def ring_of(numbers, arcs):
    ring = []
    for number in numbers:
        arc = arcs[number] if number >= 0 else arcs[~number][::-1]
        ring += arc if not ring else arc[1:]
    return unwrapped(ring)


def unwrapped(ring):
    """A ring across the antimeridian in one piece, beyond 180 degrees."""
    turns, points = 0, [ring[0]]
    for (before, _), (x, y) in zip(ring, ring[1:]):
        turns += (before - x > 180) - (x - before > 180)
        points.append((x + 360 * turns, y))
    east = min(x for x, _ in points) < -180
    return [(x + 360 * east, y) for x, y in points]


def project(point):
    longitude, latitude = map(math.radians, point)
    return [round(RADIUS * longitude * math.cos(STANDARD), 3),
            round(RADIUS * math.sin(latitude) / math.cos(STANDARD), 3)]


def main():
    topology = json.load(open(sys.argv[1], encoding="utf-8"))
    with open(sys.argv[2], encoding="utf-8") as table:
        people = {row["name"]: float(row["millions"]) for row in csv.DictReader(table)}
    arcs = arcs_of(topology)
    features = []
    for country in topology["objects"]["countries"]["geometries"]:
        name = country["properties"]["name"]
        if name == "Antarctica":
            continue
        polygons = country["arcs"] if country["type"] == "MultiPolygon" else [country["arcs"]]
        rings = [[[project(p) for p in ring_of(ring, arcs)] for ring in polygon]
                 for polygon in polygons]
        rings = [polygon for polygon in rings if len(polygon[0]) > 3]
        features.append({"type": "Feature",
                         "properties": {"name": name, "mass": round(1e6 * people[name])},
                         "geometry": {"type": "MultiPolygon", "coordinates": rings}})
    with open(sys.argv[3], "w", encoding="utf-8") as out:
        json.dump({"type": "FeatureCollection", "features": features}, out)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a map of the world for cartograms from the npm package world-atlas (Natural Earth, public
domain): countries without Antarctica in Behrmann's equal-area projection, in km, with populations of
about 2020 (populations.csv, after the United Nations' World Population Prospects 2022, rounded).
With --least-masses small ones are raised as the program go_cart of Gastner, Seguy and More does: to
2.5 % of the country's share of all perimeters, and to 0.025 % of all people; `people` are those
before.

usage: world_map.py [--least-masses] countries-110m.json out.geojson
"""
import csv
import math
import os
import sys

from features import feature, geometries, write

PEOPLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "populations.csv")
RADIUS = 6371.0  # km
STANDARD = math.radians(30.0)


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


def raise_masses(countries):
    perimeters = [sum(math.dist(a, b) for polygon in country["geometry"]["coordinates"]
                      for ring in polygon for a, b in zip(ring, ring[1:]))
                  for country in countries]
    masses = [country["properties"]["mass"] for country in countries]
    least = [max(0.025 * perimeter / sum(perimeters), 0.00025) for perimeter in perimeters]
    small = [mass < share * sum(masses) for mass, share in zip(masses, least)]
    others = sum(mass for mass, is_small in zip(masses, small) if not is_small)
    raised = sum(share for share, is_small in zip(least, small) if is_small)
    for country, share, is_small in zip(countries, least, small):
        country["properties"]["people"] = country["properties"]["mass"]
        if is_small:
            country["properties"]["mass"] = share * others / (1 - raised)
    print(f"{sum(small)} of {len(countries)} masses are raised")


def main():
    *options, source, target = sys.argv[1:]
    with open(PEOPLE, encoding="utf-8") as table:
        people = {row["name"]: float(row["millions"]) for row in csv.DictReader(table)}
    countries = []
    for country, polygons in geometries(source, "countries"):
        name = country["properties"]["name"]
        if name == "Antarctica":
            continue
        rings = [[[project(p) for p in unwrapped(ring)] for ring in polygon]
                 for polygon in polygons]
        countries.append(feature(name, round(1e6 * people[name]), rings))
    if "--least-masses" in options:
        raise_masses(countries)
    write(target, countries)


if __name__ == "__main__":
    main()

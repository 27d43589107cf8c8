#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a map for cartograms from the npm package us-atlas (Census Bureau, public domain): the
counties of 48 states and the District of Columbia in Albers' equal-area projection, in the package's
units, with log-normal masses (sigma 1.2). Three towns have no area at its resolution and are left
out.

usage: county_map.py counties-albers-10m.json out.geojson
"""
import sys

import numpy as np

from features import feature, geometries, write

APART = ("02", "15")  # Alaska and Hawaii, which the package draws smaller and elsewhere
LAST_STATE = "56"  # territories follow


def main():
    counties = []
    for county, polygons in geometries(sys.argv[1], "counties"):
        state = county["id"][:2]
        if polygons and state not in APART and state <= LAST_STATE:
            counties.append((f"{county['properties']['name']} {county['id']}", polygons))
    masses = np.random.default_rng(7).lognormal(0, 1.2, len(counties))
    write(sys.argv[2], [feature(name, float(mass), polygons)
                        for (name, polygons), mass in zip(counties, masses)])
    print(f"{len(counties)} counties")


if __name__ == "__main__":
    main()

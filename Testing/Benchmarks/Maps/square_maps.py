#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes maps of squares for cartograms, edges in 16 parts: 144 with small gaps and log-normal
masses (sigma 1.2), one of them a thousandfold; and 16, one of them a hundredfold.

usage: square_maps.py FOLDER
"""
import os
import sys

import numpy as np

from features import feature, write

PARTS = 16


def square(x, y, side):
    corners = [(x, y), (x, y + side), (x + side, y + side), (x + side, y), (x, y)]
    ring = [corners[0]]
    for (ax, ay), (bx, by) in zip(corners, corners[1:]):
        # From the lower end, so that both neighbours have the same points.
        up = (ax, ay) < (bx, by)
        (lx, ly), (hx, hy) = ((ax, ay), (bx, by)) if up else ((bx, by), (ax, ay))
        points = [(lx + i / PARTS * (hx - lx), ly + i / PARTS * (hy - ly))
                  for i in range(PARTS + 1)]
        ring += (points if up else points[::-1])[1:]
    return [[ring]]


def squares(side, masses, gap):
    return [feature(f"{i // side},{i % side}", float(mass),
                    square(i // side, i % side, 1 - gap)) for i, mass in enumerate(masses)]


def main():
    random = np.random.default_rng(7).lognormal(0, 1.2, 144)
    random[77] = 1000
    write(os.path.join(sys.argv[1], "144-squares.geojson"), squares(12, random, 0.001))
    even = np.ones(16)
    even[5] = 100
    write(os.path.join(sys.argv[1], "16-squares.geojson"), squares(4, even, 0))


if __name__ == "__main__":
    main()

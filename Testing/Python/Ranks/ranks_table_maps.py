# SPDX-License-Identifier: BSD-3-Clause
"""Rows of TestRanksTable.py: a map of which each rank has some regions."""
from paraview import simple
from ranks_rows import RANK, RANKS, give, given_here
from rt_maps import sixteen


def give_rows(inputs):
    regions = given_here(sixteen(numbers=range(16 * RANK // RANKS, 16 * (RANK + 1) // RANKS)))
    cartogram = simple.Cartogram(Input=regions, Resolution=64, Overlay=simple.UniformSeeds(
        NumberOfPoints=60, Bounds=[0, 4, 0, 4, 0, 0]))
    for port, name in enumerate(("regions", "graticule", "overlay")):
        give("cartogram " + name, cartogram, port)

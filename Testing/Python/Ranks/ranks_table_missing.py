# SPDX-License-Identifier: BSD-3-Clause
"""Rows of TestRanksTable.py: densities with missing data, and what empty cells count as."""
from paraview import simple
from ranks_rows import give, give_row, tiles, with_ghosts


def give_rows(inputs):
    """Values out of range and NaN, in points, cells and meshes; the box with a margin."""
    image, cells, hidden = (inputs[name] for name in ("points", "cells", "hidden"))
    holes = simple.Calculator(Input=image, ResultArrayName="Holes",
                              Function="if(coordsX^2 + coordsY^2 < 9, sqrt(-1), RTData)")
    mesh = simple.ImageDatatoPointSet(Input=cells)
    range_ = dict(ValidRange=[120, 240], NumberOfSteps=32, DensityResolution=12)
    densities = {
        "points": (image, range_),
        "cells": (cells, range_),
        "ghosts": (with_ghosts(image, 2), range_),
        "nan": (holes, dict(range_, NaNValues="Empty", DensityArray=["POINTS", "Holes"])),
        "hidden": (hidden, dict(range_, DensityArray=["CELLS", "RTData"])),
        "mesh": (mesh, range_),
        "mesh points": (simple.ImageDatatoPointSet(Input=image), range_),
        "blocks": (tiles(), dict(range_, ValidRange=[2, 6])),
    }
    shell = simple.Contour(Input=image, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0],
                           ComputeNormals=0)
    for name, (density, properties) in densities.items():
        give("missing sample " + name, simple.SampleDensity(
            density, NumberOfParticles=300, SampleArrays=0, **properties))
        for tables in ("Whole", "Tiled"):
            for rule in ("Mean", "Minimum", "Value"):
                give("missing map %s %s %s" % (name, rule, tables), simple.TransportMap(
                    density, EmptyCells=rule, EmptyValue=170, Tables=tables, **properties))
            warp = dict(Tables=tables, Margin=0.15, **properties)
            give("missing warp %s %s" % (name, tables), simple.DensityEqualizingWarp(
                Input=shell, Density=density, **warp))
    give_row("quality of missing", simple.TransportQuality(
        Input=simple.UniformSeeds(NumberOfPoints=300, Dimension=3, Bounds=[-4, 8, 0, 7, 0, 10]),
        Density=image, ValidRange=[120, 240], Tables="Tiled"))

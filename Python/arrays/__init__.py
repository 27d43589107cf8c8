# SPDX-License-Identifier: BSD-3-Clause
"""Transport between densities: numpy in, numpy out.

Densities are arrays [y, x] or [z, y, x] of values of 0 and more. Value [i, j] is that of the cell of
width `spacing` around the point x = origin + j * spacing, y = origin + i * spacing. An axis of one
value is no axis. Points are rows of x, y or of x, y, z. So are spacing, origin and displacements:
one number for all axes, or one for each, in the order x, y, z. Lengths are in the unit of spacing,
masses are values times the areas (volumes) of cells.

Values are real numbers: integers, bool, and floats of any size and byte order. What VTK reads in
place is not copied: arrays in C order of 1, 2, 4 or 8 bytes a value, of the machine's byte order.
Others are copied, float16 to float32, long double to double; so are points of two coordinates, or of
integers. Results are on VTK's own memory.

Values under a mask of numpy.ma, None and pandas' NA are missing: there is no mass. NaN is an error
unless NaNValues="Empty" makes it missing, too. Texts of numbers are numbers.

Surfaces are points, rows of x, y and z, and triangles, rows of three numbers of points from 0.
Regions are what has __geo_interface__.

Each function runs a filter of the package once and gives that filter's bits. Keywords are the
filter's properties by name: Method="Optimal", NaNValues="Empty", NumberOfSteps=64. help() of the
class lists them. Errors of a filter are ValueError, or MemoryError, with the filter's text; its
warnings are RuntimeWarning. Arrays of another type, and unknown keywords, are TypeError.

    from rectifiedtransport import arrays
    dots = arrays.stipple(photograph, 20000)
    between = arrays.morph(first, second, 0.5, Method="Optimal")
"""
from ._blends import Distance, barycenter, distance, morph
from ._maps import TransportMap, transport_map
from ._points import Cells, cells, relax, sample, stipple
from ._regions import cartogram
from ._surfaces import SolidDensity, SurfacePoints, inside, solid_density, surface_points

__all__ = ["Cells", "Distance", "SolidDensity", "SurfacePoints", "TransportMap", "barycenter",
           "cartogram", "cells", "distance", "inside", "morph", "relax", "sample", "solid_density",
           "stipple", "surface_points", "transport_map"]

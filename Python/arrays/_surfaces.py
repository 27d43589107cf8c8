# SPDX-License-Identifier: BSD-3-Clause
"""Points on surfaces of triangles and inside of them, and what they enclose."""
from operator import index
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from .. import vtkRectifiedTransport as filters
from ._data import point_values_of, positions_of, surface_of
from ._points import sampler_of
from ._run import set_properties, update


class SurfacePoints(NamedTuple):
    """What surface_points gives.

    points     float64 (n, 3)
    triangles  int64 (n): the triangle that each is on
    normals    float64 (n, 3): of that triangle, of length 1
    """
    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    normals: NDArray[np.float64]


class SolidDensity(NamedTuple):
    """What solid_density gives: a density, and how it is placed, as sample and others take it.

    values   float64 [z, y, x]: the fraction of each cell that is inside, from 0 to 1
    spacing  the side of a cell
    origin   x, y, z of the centre of the first cell
    """
    values: NDArray[np.float64]
    spacing: float
    origin: NDArray[np.float64]


def whole_surface_of(points, triangles):
    surface = surface_of(points, triangles)
    if surface.GetNumberOfPolys() == 0:
        raise ValueError("triangles has none")
    return surface


def inside(points: ArrayLike, triangles: ArrayLike, n: int,
           **properties: Any) -> NDArray[np.float64]:
    """Points inside a closed surface, spaced evenly, by Sample Density (vtkTransportSampler).

    points      (number, 3): the surface's points. Those of equal coordinates count as one.
    triangles   (number, 3), integers: the three points of each triangle, from 0, in any order.
                Together they must be closed. Components that overlap are united; one inside another
                one with the opposite orientation is a cavity.
    n           the number of points inside, at least 1
    properties  of the filter, such as DensityResolution=64 for less memory and time (the default is
                256 cells along the longest side), SeedPattern, RandomSeed, Method="Optimal"

    Returns the points, float64 (n, 3). The same input gives the same points, on any machine.

    Raises ValueError for an open surface, for coordinates that are NaN or infinite, for triangles of
    points that do not exist, for triangles in one plane, and for a property that the filter refuses;
    TypeError for what is no number. For a surface with holes make a density of it by
    solid_density(points, triangles, resolution, OpenSurfaces="WindingNumber"), and sample that.
    """
    surface = whole_surface_of(points, triangles)
    algorithm = sampler_of(surface, n, properties)
    # A flat surface would be a density on its plane. Its corners have two directions at most.
    corners = positions_of(surface, 3)[np.unique(triangles)]
    if np.isfinite(corners).all():
        extents = np.linalg.svd(corners - corners.mean(axis=0), compute_uv=False)
        if extents[-1] <= 1e-5 * extents[0]:
            raise ValueError("the triangles lie in one plane, so that nothing is inside")
    update(algorithm, {})
    return positions_of(algorithm.GetOutput(), 3)


def surface_points(points: ArrayLike, triangles: ArrayLike, n: int,
                   **properties: Any) -> SurfacePoints:
    """Points on a surface of any form, spaced evenly, by Sample Surface (vtkSurfaceSampler).

    points      (number, 3): the surface's points
    triangles   (number, 3), integers: the three points of each triangle, from 0
    n           the number of points on it, at least 1
    properties  of the filter, such as RelaxationIterations, RandomSeed

    Returns SurfacePoints. The same input gives the same points, on any machine.

    Raises ValueError for coordinates that are NaN or infinite, for triangles of points that do not
    exist, for a surface without area, and for a property that the filter refuses; TypeError for what
    is no number.
    """
    surface = whole_surface_of(points, triangles)
    algorithm = filters.vtkSurfaceSampler()
    set_properties(algorithm, {"NumberOfParticles": index(n)}, properties)
    algorithm.SetInputData(surface)
    update(algorithm, {})
    made = algorithm.GetOutput()
    arrays = made.GetPointData()
    return SurfacePoints(positions_of(made, 3),
                         *(vtk_to_numpy(arrays.GetArray(name)) for name in ("CellId", "Normal")))


def solid_density(points: ArrayLike, triangles: ArrayLike, resolution: int = 64,
                  **properties: Any) -> SolidDensity:
    """What a closed surface encloses, as a density on cubic cells around it, by Solid Density
    (vtkSolidDensity).

    points      (number, 3): the surface's points. Those of equal coordinates count as one.
    triangles   (number, 3), integers: the three points of each triangle, from 0, in any order
    resolution  the number of cells along the longest side, with the margin
    properties  of the filter, such as Padding for the margin, OpenSurfaces="WindingNumber" for a
                surface with holes

    Returns a SolidDensity. Its sum times the volume of a cell is the volume of the solid.

        made = solid_density(points, triangles, 100)
        samples = sample(made.values, 1000, spacing=made.spacing, origin=made.origin)

    Raises ValueError for an open surface, for coordinates that are NaN or infinite, for triangles of
    points that do not exist, and for a property that the filter refuses; TypeError for what is no
    number.
    """
    surface = whole_surface_of(points, triangles)
    algorithm = filters.vtkSolidDensity()
    set_properties(algorithm, {"Resolution": index(resolution), "Association": "Points"}, properties)
    algorithm.SetInputData(surface)
    update(algorithm, {})
    image = algorithm.GetOutput()
    return SolidDensity(point_values_of(image, "Density", 3), image.GetSpacing()[0],
                        np.array(image.GetOrigin()))

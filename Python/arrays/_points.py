# SPDX-License-Identifier: BSD-3-Clause
"""Points that are distributed like a density, and cells of equal mass around points."""
from operator import index
from typing import Any, Dict, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from .. import vtkRectifiedTransport as filters
from ._data import Numbers, cell_values_of, fields_of, image_of, point_set, positions_of
from ._run import set_properties, update


class Cells(NamedTuple):
    """What cells gives.

    labels     int64 [y, x] or [z, y, x]: the number of each pixel's site, from 0; -1 where the
               density has no mass. As many pixels as the density has values if the spacing is the
               same along all axes.
    masses     float64 (sites): the mass of each site's cell
    centroids  float64 (sites, 2 or 3): the centroid of its mass
    costs      float64 (sites): its share of the cost
    fields     the filter's numbers: TransportCost (the mean squared distance of the mass to the
               sites), OutsideSites, SitesWithoutMass
    """
    labels: NDArray[np.int64]
    masses: NDArray[np.float64]
    centroids: NDArray[np.float64]
    costs: NDArray[np.float64]
    fields: Dict[str, Any]


def sampler_of(density, n, properties, kind=None):
    """Sample Density of a data object, for particles without arrays."""
    algorithm = filters.vtkTransportSampler()
    own = {"NumberOfParticles": index(n), "OutputPaths": 0, "SampleArrays": 0}
    set_properties(algorithm, own, properties, kind)
    algorithm.SetInputData(density)
    return algorithm


def _relaxation(points, image, iterations, properties, kind=None):
    algorithm = filters.vtkBlueNoiseRelaxation()
    set_properties(algorithm, {"MaximumIterations": index(iterations)}, properties, kind)
    algorithm.SetInputData(points)
    algorithm.SetDensityData(image)
    return algorithm


def sample(density: ArrayLike, n: int, *, spacing: Numbers = 1.0, origin: Numbers = 0.0,
           **properties: Any) -> NDArray[np.float64]:
    """Points that are distributed like a density, by Sample Density (vtkTransportSampler).

    density     [y, x] or [z, y, x], real numbers of 0 and more with a sum above 0
    n           the number of points, at least 1
    spacing     the distance of values, a number or one for x, y(, z)
    origin      where the first value is
    properties  of the filter, such as InvertDensity=True for dark ink, SeedPattern="Random" with
                RandomSeed, NaNValues="Empty", Method="Optimal"

    Returns the points, float64 (n, 2) or (n, 3), in the unit of spacing. With SeedPattern="Lattice"
    their number is near n. Each point has the same share of the mass. The same input gives the same
    points, on any machine.

    Raises ValueError for values that are NaN, infinite or negative, for no mass, and for an array or
    a property that the filter refuses; TypeError for values that are not real numbers.
    """
    image, shape = image_of(density, "density", spacing, origin)
    algorithm = sampler_of(image, n, properties)
    update(algorithm, {"density": shape})
    return positions_of(algorithm.GetOutput(), len(shape))


def relax(points: ArrayLike, density: ArrayLike, iterations: int = 50, *, spacing: Numbers = 1.0,
          origin: Numbers = 0.0, **properties: Any) -> NDArray[np.float64]:
    """Points spaced evenly while they follow a density: blue noise, by Relax Blue Noise
    (vtkBlueNoiseRelaxation).

    points      (number, 2) or (number, 3), as many coordinates as the density has axes, in the unit
                of spacing; best those of sample. Those outside move to the border first.
    density     [y, x] or [z, y, x], real numbers of 0 and more with a sum above 0
    iterations  the largest number of them
    spacing     the distance of values, a number or one for x, y(, z)
    origin      where the first value is
    properties  of the filter, such as Method="OptimalTransport" (two axes), Tolerance,
                InvertDensity=True

    Returns the moved points in their order, float64 of the shape of points.

    Raises ValueError for coordinates or values that are NaN or infinite, for negative values, for no
    mass, for points of another shape, and for an array or a property that the filter refuses;
    TypeError for what is not real numbers.
    """
    image, shape = image_of(density, "density", spacing, origin)
    moved = point_set(points, "points", len(shape))
    if moved.GetNumberOfPoints() == 0:
        return np.empty((0, len(shape)))
    algorithm = _relaxation(moved, image, iterations, properties)
    update(algorithm, {"density": shape})
    return positions_of(algorithm.GetOutput(), len(shape))


def stipple(image: ArrayLike, n: int, iterations: int = 50, *, invert: bool = True,
            **properties: Any) -> NDArray[np.float64]:
    """A picture as dots of ink: sample, then relax.

    image       [row, column] of greys, or [row, column, channel] of 1 to 4: grey, grey and alpha, RGB,
                RGBA. White is 255 for uint8, else the largest value.
    n           the number of dots, at least 1
    iterations  the largest number of iterations of relax; 0: none
    invert      whether dark is ink
    properties  of how a density is read, such as Component=0 for red, NaNValues="Empty"

    Returns the dots, float64 (n, 2): column and row, as matplotlib's scatter on imshow takes them.
    The pixel [0, 0] is from -0.5 to 0.5.

    Raises ValueError for values that are NaN, infinite or negative, for a picture without ink, and
    for an array or a property that the filters refuse; TypeError for values that are not real
    numbers.
    """
    picture, shape = image_of(image, "image", colours=True)
    kind = filters.vtkDensityAlgorithm
    # Component -2 is the luminance of every type; Auto takes it of small integers alone.
    properties = {"InvertDensity": bool(invert), "Component": -2, **properties}
    sampler = sampler_of(picture, n, properties, kind)
    update(sampler, {"image": shape})
    if index(iterations) == 0:
        return positions_of(sampler.GetOutput(), 2)
    relaxation = _relaxation(sampler.GetOutput(), picture, iterations, properties, kind)
    update(relaxation, {"image": shape})
    return positions_of(relaxation.GetOutput(), 2)


def cells(sites: ArrayLike, density: ArrayLike, *, spacing: Numbers = 1.0, origin: Numbers = 0.0,
          **properties: Any) -> Cells:
    """A domain divided among sites into parts of equal mass, by Equal Mass Cells
    (vtkEqualMassCells).

    sites       (number, 2) or (number, 3), as many coordinates as the density has axes, in the unit
                of spacing; at least one
    density     [y, x] or [z, y, x], real numbers of 0 and more with a sum above 0, on the domain
    spacing     the distance of values, a number or one for x, y(, z)
    origin      where the first value is
    properties  of the filter, such as Shape="Power" for the polygons of least cost (two axes),
                Measure="Uniform" for equal areas, Resolution: the pixels along the longest side

    Returns Cells. Masses are equal up to a pixel's, with Shape="Power" up to 5e-7 of their mean.

    Raises ValueError for coordinates or values that are NaN or infinite, for negative values, for no
    mass, for no sites, more sites than pixels or sites of another shape, and for an array or a
    property that the filter refuses; TypeError for what is not real numbers.
    """
    image, shape = image_of(density, "density", spacing, origin)
    places = point_set(sites, "sites", len(shape))
    if places.GetNumberOfPoints() == 0:
        raise ValueError("sites has no points")
    lengths = np.multiply(shape[::-1], image.GetSpacing()[:len(shape)])
    defaults = {"Measure": "Density", "Resolution": shape[::-1][int(lengths.argmax())]}
    algorithm = filters.vtkEqualMassCells()
    set_properties(algorithm, {}, {**defaults, **properties})
    algorithm.SetInputData(places)
    algorithm.SetDomainData(image)
    update(algorithm, {"density": shape})
    labels = cell_values_of(algorithm.GetLabels(), "SiteId", len(shape))
    figures = algorithm.GetSites().GetPointData()
    masses, centroids, costs = (vtk_to_numpy(figures.GetArray(name))
                                for name in ("CellMass", "CellCentroid", "CellCost"))
    return Cells(labels, masses, centroids[:, :len(shape)], costs, fields_of(algorithm.GetLabels()))

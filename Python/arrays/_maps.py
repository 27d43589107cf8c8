# SPDX-License-Identifier: BSD-3-Clause
"""The map between the uniform measure and a density."""
from typing import Any, Dict, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import vtkRectifiedTransport as filters
from ._data import Numbers, fields_of, image_of, point_values_of
from ._run import set_properties, update


class TransportMap(NamedTuple):
    """What transport_map gives.

    displacement  float64 [y, x, 2] or [z, y, x, 3]: where the point of each value goes, less the
                  point; the last axis is x, y(, z)
    divergence    float64 [y, x] or [z, y, x]: of the displacement
    determinant   float64 [y, x] or [z, y, x]: of the map's derivative; how many times as large the
                  map makes a small cell
    fields        the filter's numbers: TransportCost (the mean squared length of displacement),
                  TotalMass, FoldedCells, LargestBlockError and others
    """
    displacement: NDArray[np.float64]
    divergence: NDArray[np.float64]
    determinant: NDArray[np.float64]
    fields: Dict[str, Any]


def transport_map(density: ArrayLike, *, spacing: Numbers = 1.0, origin: Numbers = 0.0,
                  **properties: Any) -> TransportMap:
    """The map that takes the uniform measure to a density, by Transport Map (vtkTransportMap).

    density     [y, x] or [z, y, x], real numbers of 0 and more with a sum above 0
    spacing     the distance of values, a number or one for x, y(, z)
    origin      where the first value is
    properties  of the filter, such as Direction="DensityToUniform" for the map back,
                Method="Optimal", SampleDimensions=(x, y, z) for another number of samples

    Returns a TransportMap, in the unit of spacing.

    Raises ValueError for values that are NaN, infinite or negative, for no mass, and for an array or
    a property that the filter refuses; TypeError for values that are not real numbers.
    """
    image, shape = image_of(density, "density", spacing, origin)
    algorithm = filters.vtkTransportMap()
    set_properties(algorithm, {}, properties)
    algorithm.SetInputData(image)
    update(algorithm, {"density": shape})
    result = algorithm.GetOutput()
    arrays = [point_values_of(result, name, len(shape))
              for name in ("Displacement", "Divergence", "JacobianDeterminant")]
    return TransportMap(*arrays, fields_of(result))

# SPDX-License-Identifier: BSD-3-Clause
"""What is between densities, and how far apart they are."""
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import vtkRectifiedTransport as filters
from ._data import Numbers, image_of, point_values_of
from ._numbers import all_numbers
from ._run import set_properties, update


class Distance(NamedTuple):
    """What distance gives, in the unit of spacing. Take the numbers by name: later versions may add
    others.

    lower     W2 is at least this. Certified, up to rounding, by a pair of potentials that are
              admissible everywhere. Mostly within 1 % of W2.
    upper     W2 is at most this. Certified, up to rounding, by a coupling of exactly a and b.
    """
    lower: float
    upper: float


def _density_of(blend, axes):
    """The density that a filter gives, by any name; not a copy."""
    image = blend.GetDensity()
    return point_values_of(image, image.GetPointData().GetScalars().GetName(), axes)


class _Pair:
    """Morph Densities from one array to another."""

    def __init__(self, a, b, spacing, origin, own, properties):
        source, shape = image_of(a, "a", spacing, origin)
        target, other = image_of(b, "b", spacing, origin)
        if len(shape) != len(other):
            raise ValueError("a has the shape %s and b %s; they must have as many axes"
                             % (shape, other))
        self.axes, self.shapes = len(shape), {"a": shape, "b": other}
        self.algorithm = filters.vtkTransportInterpolator()
        set_properties(self.algorithm, {"Parameter": 0.0, "PublishTime": 0, **own}, properties)
        self.algorithm.SetInputData(source)
        self.algorithm.SetTargetData(target)

    def density(self, t):
        """The density at a time; not a copy."""
        self.algorithm.SetParameter(t)
        update(self.algorithm, self.shapes)
        return _density_of(self.algorithm, self.axes)


def morph(a: ArrayLike, b: ArrayLike, t: Union[float, Sequence[float]] = 0.5, *,
          spacing: Numbers = 1.0, origin: Numbers = 0.0, **properties: Any) -> NDArray[np.float64]:
    """The mass of one density on its way to another, by Morph Densities (vtkTransportInterpolator).

    a, b        [y, x] or [z, y, x], real numbers of 0 and more with sums above 0. Their shapes may
                differ; both begin at origin.
    t           0 is a, 1 is b; or a sequence of such numbers. The maps are made once for all.
    spacing     the distance of values, a number or one for x, y(, z)
    origin      where the first values are
    properties  of the filter, such as Method="Optimal" for the straight ways of least cost,
                ParticlesPerCell, Kernel, MassMode="Normalize"

    Returns the density, float64 [y, x] or [z, y, x] of the larger shape along each axis; for a
    sequence of times, one along a further first axis. At 0 and 1 it is a and b, resampled
    where their shapes differ. Its mass goes from that of a to that of b linearly.

    Raises ValueError for values that are NaN, infinite or negative, for no mass, for a time outside
    0 to 1, and for an array or a property that the filter refuses; TypeError for values that are not
    real numbers.
    """
    pair = _Pair(a, b, spacing, origin, {}, properties)
    times = all_numbers(t, "t").astype(float)
    if times.ndim > 1:
        raise ValueError("t has the shape %s; it must be a number or a sequence" % (times.shape,))
    if times.ndim == 0:
        return pair.density(float(times))
    if times.size == 0:
        raise ValueError("t has no times")
    made = None
    for i, time in enumerate(times):
        density = pair.density(float(time))
        if made is None:
            made = np.empty((len(times), *density.shape))
        made[i] = density
    return made


def barycenter(densities: Sequence[ArrayLike], weights: Optional[Sequence[float]] = None, *,
               spacing: Numbers = 1.0, origin: Numbers = 0.0,
               **properties: Any) -> NDArray[np.float64]:
    """The weighted mean of densities by transport, by Density Barycenter (vtkTransportBarycenter).

    densities   one or more arrays [y, x] or [z, y, x], or one array with a further first axis; real
                numbers of 0 and more with sums above 0. Their shapes may differ; all begin at
                origin.
    weights     one for each density, 0 and more, with a sum above 0, by which they are divided;
                None: all weigh the same
    spacing     the distance of values, a number or one for x, y(, z)
    origin      where the first values are
    properties  of the filter, such as Method="Optimal", ParticlesPerCell, Kernel, MassMode

    Returns the density, float64 [y, x] or [z, y, x] of the largest shape along each axis.

    Raises ValueError for values that are NaN, infinite or negative, for no mass, for weights of
    another number, and for an array or a property that the filter refuses; TypeError for values that
    are not real numbers. The filter's text counts densities from 1.
    """
    algorithm = filters.vtkTransportBarycenter()
    set_properties(algorithm, {"NumberOfWeights": 0}, properties)
    if len(densities) == 0:
        raise ValueError("densities has none")
    shapes = []
    for i, values in enumerate(densities):
        image, shape = image_of(values, "densities[%d]" % i, spacing, origin)
        image.GetPointData().GetScalars().SetName("density")
        algorithm.AddInputDataObject(image)
        shapes.append(shape)
    if len({len(shape) for shape in shapes}) > 1:
        raise ValueError("the densities have the shapes %s; they must have as many axes"
                         % ", ".join(map(str, shapes)))
    for i, weight in enumerate(all_numbers([] if weights is None else weights, "weights")):
        algorithm.SetWeight(i, float(weight))
    update(algorithm, {"density": shapes[0]} if len(set(shapes)) == 1 else {})
    return _density_of(algorithm, len(shapes[0]))


def distance(a: ArrayLike, b: ArrayLike, *, spacing: Numbers = 1.0, origin: Numbers = 0.0,
             **properties: Any) -> Distance:
    """How far apart two densities are: the 2-Wasserstein distance W2 between them, each divided by
    its mass, in the unit of spacing, by Transport Distance (vtkTransportDistance), Method Certified.

    Densities are constant on the cell of each value. W2 is then the root of the least mean squared
    distance by which the mass of one can be moved to the other.

    a, b        [y, x] or [z, y, x], real numbers of 0 and more with sums above 0. Their shapes may
                differ; both begin at origin, and there is nothing beyond the smaller one.
    spacing     the distance of values, a number or one for x, y(, z)
    origin      where the first values are
    properties  of the filter, such as InvertDensity, NaNValues, MassDifference="Error", Threading

    Returns a Distance: `lower` and `upper`, between which W2 certainly is. The lower bound loses
    about the square of a cell's width (of W2 squared): where mass moves by less than two cells, it
    says little.

    Raises ValueError for values that are NaN, infinite or negative, for no mass, and for an array or
    a property that the filter refuses; TypeError for values that are not real numbers.
    """
    shapes = {name: image_of(values, name, spacing, origin)[1] for name, values in (("a", a), ("b", b))}
    if len(shapes["a"]) != len(shapes["b"]):
        raise ValueError("a has the shape %(a)s and b %(b)s; they must have as many axes" % shapes)
    largest = tuple(map(max, shapes["a"], shapes["b"]))
    algorithm = filters.vtkTransportDistance()
    set_properties(
        algorithm, {"Method": "Certified", "OverTime": 0, "NumberOfCoordinates": 1}, properties)
    for name, values in (("a", a), ("b", b)):
        image, _ = image_of(values, name, spacing, origin, grown_to=largest)
        algorithm.AddInputDataObject(image)
    # Densities of other masses are what this function is for.
    update(algorithm, {name: largest for name in shapes}, "The masses of the densities differ")
    bounds = algorithm.GetBounds()
    return Distance(*(bounds.GetValueByName(0, name).ToDouble() for name in ("LowerBound", "UpperBound")))

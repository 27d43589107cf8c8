// SPDX-License-Identifier: BSD-3-Clause
// Steps of the multistep method (FlowMultistep.txx) of one particle, along one axis.
#ifndef RectifiedTransport_Multistep_h
#define RectifiedTransport_Multistep_h

// x + span length (a0 first + a1 second + a2 third), kept in the domain.
RT_FUNCTION double advance(double x, double span, double length, double a0, double a1, double a2,
  double first, double second, double third, double size)
{
  const double sum = a0 * first + a1 * second + a2 * third;
  return clampToDomain(x + span * length * sum, size);
}

// While a particle's box is the whole domain, the mean of Eq. (11) is the centroid M, and the path
// is the straight line x0 + t (M - x0). That ends when a face of the box reaches one of the domain:
// b = x/t comes down to S, or a = S - (S - x)/t up to 0, at
//   t* = min over the axes of min(x0 / (S - M + x0), (S - x0) / (S - x0 + M)).
RT_FUNCTION double endOfStraightStart(double x, double size, double centroid)
{
  const double low = x / (size - centroid + x);
  const double high = (size - x) / (size - x + centroid);
  return smaller(low, high);
}

// The last step, to time 1. As v(x, 1) = x - S/2, the corrector is a linear equation for x(1), and
// is solved in closed form rather than by a prediction:
//   x(1) = (x + lambda (C1 v_k + C2 v_k-1 - C0 S/2)) / (1 - lambda C0),   lambda = span length.
RT_FUNCTION double closedEnd(double x, double span, double length, double c0, double c1, double c2,
  double newest, double before, double middle)
{
  const double lambda = span * length;
  const double known = c1 * newest + c2 * before - c0 * middle;
  return (x + lambda * known) / (1.0 - lambda * c0);
}

// Where the density has its maximum in all of a particle's box, and the box is not clipped, the
// mean of Eq. (11) is the box's centre, about which the box then shrinks: it is x(1). The largest
// mass that a box could hold, maximum times volume, is multiplied side by side; a box is full if
// that is its mass, up to rounding.
RT_FUNCTION double withSide(double mass, double from, double to, double size)
{
  return from > 0.0 && to < size ? mass * (to - from) : 1e300;
}

RT_FUNCTION int isFull(double largestMass, double inverseMass)
{
  return largestMass * inverseMass - 1.0 <= 1e-9;
}

// c = (x - (1 - t) S/2) / t, after the corrector has moved x.
RT_FUNCTION double centreOfBox(double x, double middle, double inverseTime)
{
  return middle + (x - middle) * inverseTime;
}

// A box so small that it may count as empty though it is not is no sign of a void; where it is in
// one, the particle ends in an empty cell. Such a box has less than this part of its volume times
// the density's largest value.
#define RT_LEAST_PART 1e-3

// Backwards: whether a box has become the whole domain along an axis, a <= 0 and b >= S before
// clipping. If it has along all axes, x lies on a straight path from its seed, x0 of
// x = x0 + t (M - x0).
RT_FUNCTION int isWhole(double x, double t, double size)
{
  return !(size - x < t * size || x < t * size);
}

RT_FUNCTION double seedOfStraight(double x, double t, double size, double centroid)
{
  const double seed = (x - t * centroid) / (1.0 - t);
  return smaller(larger(seed, 0.0), size);
}

#endif

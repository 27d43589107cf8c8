// SPDX-License-Identifier: BSD-3-Clause
// Points whose distances are as near as possible to given ones.
#ifndef RectifiedTransport_ClassicalScaling_h
#define RectifiedTransport_ClassicalScaling_h

#include "../Parallel/Context.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct ScaledPoints
{
  // The coordinate of point i along axis k is at i * dimensions + k.
  std::vector<double> Coordinates;
  // The part of the distances that is lost: the root of sum (d - e)^2 / sum d^2 over all pairs,
  // where d are the given distances and e those of the points. 0 if all d are 0.
  double Stress = 0.0;
};

// Classical scaling: W. S. Torgerson, "Multidimensional scaling: I. Theory and method",
// Psychometrika 17, 1952, doi:10.1007/BF02288916. `distances`: count * count values, symmetric, not
// negative, with 0 on the diagonal. The centre of the points is the origin; along each axis, of
// which the first has the largest spread, the coordinate that is farthest from it is positive. Axes
// that the distances do not need are 0. O(count^3). Throws std::bad_alloc and Cancelled.
ScaledPoints scaleClassically(const std::vector<double>& distances, std::int64_t count,
  int dimensions, const Context& context = Context());

} // namespace RectifiedTransport

#endif

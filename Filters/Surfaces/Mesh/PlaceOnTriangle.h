// SPDX-License-Identifier: BSD-3-Clause
// A point of a triangle.
#ifndef RectifiedTransport_PlaceOnTriangle_h
#define RectifiedTransport_PlaceOnTriangle_h

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

// A point by its barycentric coordinates, which are not negative and sum to 1.
struct PlaceOnTriangle
{
  std::int64_t Triangle;
  std::array<double, 3> Weights;
};

} // namespace RectifiedTransport

#endif

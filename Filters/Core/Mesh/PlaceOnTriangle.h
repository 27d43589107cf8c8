// SPDX-License-Identifier: BSD-3-Clause
// A point of a triangle.
#ifndef RectifiedTransport_PlaceOnTriangle_h
#define RectifiedTransport_PlaceOnTriangle_h

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

// By its barycentric coordinates: not negative, with the sum 1.
struct PlaceOnTriangle
{
  std::int64_t Triangle;
  std::array<double, 3> Weights;
};

} // namespace RectifiedTransport

#endif

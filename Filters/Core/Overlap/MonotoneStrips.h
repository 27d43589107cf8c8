// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_MonotoneStrips_h
#define RectifiedTransport_MonotoneStrips_h

#include "Core/Geometry/ExactOrientation.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

enum class StripSide
{
  Left,
  Right
};

// Polygons whose left and right sides rise, cut into counter-clockwise triangles while they grow by
// points in the order of their heights (Garey, Johnson, Preparata and Tarjan 1978). Each keeps a
// chain: the points of one side that triangles do not cover yet, after the last one of the other
// side. The time is linear in the number of points.
class MonotoneStrips
{
public:
  // Both must outlive this object.
  MonotoneStrips(
    const std::vector<Point<2>>& places, std::vector<std::array<std::int32_t, 3>>& triangles)
    : Places(places)
    , Triangles(triangles)
  {
  }

  // Returns the number of a new strip.
  std::int32_t Begin(std::int32_t point);
  // Adds a point to a side of a strip; it must be above all points of the strip.
  void Add(std::int32_t strip, std::int32_t point, StripSide side);
  // Ends a strip at a point where both sides meet. Its number may be used again.
  void End(std::int32_t strip, std::int32_t point);
  // Divides a strip at a point between its sides; returns the strips to its left and to its right.
  std::array<std::int32_t, 2> Divide(std::int32_t strip, std::int32_t point);

private:
  struct Strip
  {
    std::vector<std::int32_t> Chain; // points that triangles do not cover yet, from low to high
    StripSide Side;                  // side of all chain points except the first
  };

  Strip& At(std::int32_t strip) { return this->All[static_cast<std::size_t>(strip)]; }
  NumberedPoint Numbered(std::int32_t point) const
  {
    return { this->Places[static_cast<std::size_t>(point)], point };
  }
  // The triangle of two points of a chain, the lower one first, and another point.
  static std::array<std::int32_t, 3> TriangleOf(
    StripSide side, std::int32_t low, std::int32_t high, std::int32_t point);
  void EmitFan(const Strip& strip, std::int32_t point);
  // Writes the triangle if it has an area.
  void Emit(const std::array<std::int32_t, 3>& corners);

  const std::vector<Point<2>>& Places; // by points, from low to high
  std::vector<std::array<std::int32_t, 3>>& Triangles;
  std::vector<Strip> All;
  std::vector<std::int32_t> Ended; // numbers that may be used again
};

} // namespace RectifiedTransport

#endif

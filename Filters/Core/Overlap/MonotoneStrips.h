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
// points in the order of their heights (Garey, Johnson, Preparata and Tarjan 1978). Each keeps the
// points of one side that triangles do not cover yet, after the last one of the other side. In the
// time of the number of points.
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
  void Add(std::int32_t strip, std::int32_t point, StripSide side);
  // At a point where both sides meet. The number may be used again.
  void End(std::int32_t strip, std::int32_t point);
  // At a point between the sides; returns the strips to its left and to its right.
  std::array<std::int32_t, 2> Divide(std::int32_t strip, std::int32_t point);

private:
  struct Strip
  {
    std::vector<std::int32_t> Chain;
    StripSide Side; // of all but the first
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

  const std::vector<Point<2>>& Places;
  std::vector<std::array<std::int32_t, 3>>& Triangles;
  std::vector<Strip> All;
  std::vector<std::int32_t> Ended;
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Polygons and strips that are read one by one, as triangles.
#ifndef RectifiedTransport_CutPolygons_h
#define RectifiedTransport_CutPolygons_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/PolygonCutter.h"

#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

class Progress;

struct PolygonSource
{
  // Called with the number of a polygon or strip and its points.
  using Visit = std::function<void(std::int64_t, const PolygonCutter::Corners&)>;
  // Calls it for all, in order. Throws Cancelled.
  using Visits = std::function<void(Progress&, const Visit&)>;

  Visits Polygons;
  Visits Strips;
  std::int64_t NumberOfPolygons;
  std::int64_t NumberOfStrips;
  std::int64_t NumberOfTriangles; // one for each corner beyond the second
  RingCutter CutRing;
};

struct PolygonTriangles
{
  LargeBuffer<std::int64_t> Corners; // three points a triangle
  // Number of the polygon that each is part of; strips are numbered on.
  LargeBuffer<std::int64_t> Cells;
};

// As PolygonCutter::Cut cuts. Throws Failure for polygons that cannot be cut,
// std::bad_alloc and Cancelled.
PolygonTriangles cutPolygons(
  const PolygonSource& source, ConstPointSpan<3> points, double rounding, Progress& progress);

} // namespace RectifiedTransport

#endif

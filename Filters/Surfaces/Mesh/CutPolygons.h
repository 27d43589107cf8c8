// SPDX-License-Identifier: BSD-3-Clause
// Polygons and strips that are read one by one, as triangles.
#ifndef RectifiedTransport_CutPolygons_h
#define RectifiedTransport_CutPolygons_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

// Cuts a simple polygon into triangles: appends the places of three corners in the ring for each,
// and returns whether it could.
using RingCutter =
  std::function<bool(const std::vector<Point<3>>& ring, std::vector<std::size_t>& triangles)>;

// Usual algorithms, as that of vtkPolygon, drop polygons with coincident corners, which Clip and
// Slice make where they pass through a point. Here these corners are removed first and come back as
// triangles without area, so that every edge of the polygon is an edge of a triangle.
class PolygonCutter
{
public:
  using Corners = std::vector<std::int64_t>; // points

  // Coordinates of coincident corners differ by at most `rounding` along each axis.
  PolygonCutter(ConstPointSpan<3> points, double rounding, RingCutter cutRing);

  // Makes a triangle for each corner beyond the second. Returns whether that was possible; it is
  // not if edges cross.
  bool Cut(const Corners& corners);
  // The same for three corners or more, where thin polygons and those that cannot be cut are never
  // refused. Four corners are cut along their shorter diagonal, if that is within them,
  // independently of which is the first. What cannot be cut becomes a fan: that of a planar polygon
  // has the same winding number, whatever the polygon's shape.
  void CutThin(const Corners& corners);
  // The triangles of a strip, all with its orientation.
  void CutStrip(const Corners& corners);

  // The triangles of the last polygon or strip have three points each.
  const std::vector<std::int64_t>& Triangles() const { return this->Made; }

private:
  using Ring = std::vector<std::size_t>; // corners by their places in the polygon

  void ReadPlaces(const Corners& corners);
  void CutFan(const Corners& corners, std::size_t from);
  bool CutRing(const Ring& ring);
  Ring WithoutEqual(const Ring& ring) const;
  Ring WithoutStraight(const Ring& ring) const;
  bool IsSamePlace(std::size_t a, std::size_t b) const;
  bool IsStraight(std::size_t a, std::size_t b, std::size_t c) const;
  bool IsCutFromOne() const;
  void Append(const Ring& ring, const Corners& corners);

  const ConstPointSpan<3> Points;
  const double Rounding;
  const RingCutter CutSimple;
  double Size = 0.0;                 // longest side of the polygon's bounds
  std::vector<Point<3>> Places;      // positions of the polygon's corners
  std::vector<Point<3>> RingPlaces;  // positions of the corners that are left
  std::vector<std::size_t> RingCuts; // triangles of these, three places in the ring each
  std::vector<std::int64_t> Made;    // points of the triangles
};

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

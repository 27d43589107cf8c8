// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/CutPolygons.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Vectors.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// A normal whose length is twice the triangle's area.
Point<3> normalOf(const Point<3>& a, const Point<3>& b, const Point<3>& c)
{
  return cross(b - a, c - a);
}

} // namespace

PolygonTriangles cutPolygons(
  const PolygonSource& source, ConstPointSpan<3> points, double rounding, Progress& progress)
{
  PolygonTriangles cut{ LargeBuffer<std::int64_t>(3 * source.NumberOfTriangles),
    LargeBuffer<std::int64_t>(source.NumberOfTriangles) };
  PolygonCutter cutter(points, rounding, source.CutRing);
  std::int64_t* corners = cut.Corners.data();
  std::int64_t* cells = cut.Cells.data();
  const auto append = [&](std::int64_t cell) {
    const std::vector<std::int64_t>& made = cutter.Triangles();
    corners = std::copy(made.begin(), made.end(), corners);
    cells = std::fill_n(cells, made.size() / 3, cell);
  };
  std::int64_t missing = 0;
  std::int64_t firstMissing = 0;
  Stages stages(progress,
    { { "polygons", static_cast<double>(source.NumberOfPolygons) },
      { "strips", static_cast<double>(source.NumberOfStrips) } });
  source.Polygons(
    stages["polygons"], [&](std::int64_t cell, const PolygonCutter::Corners& polygon) {
      if (cutter.Cut(polygon))
      {
        append(cell);
        return;
      }
      // A polygon that cannot be cut lacks all its triangles.
      firstMissing = missing == 0 ? cell : firstMissing;
      missing += static_cast<std::int64_t>(polygon.size()) - 2;
    });
  source.Strips(stages["strips"], [&](std::int64_t number, const PolygonCutter::Corners& strip) {
    cutter.CutStrip(strip);
    append(source.NumberOfPolygons + number);
  });
  if (missing != 0)
  {
    fail("The input surface has polygons that cannot be cut into triangles: ", missing,
      " triangles are missing (the first of polygon ", firstMissing,
      ", counted from 0); polygons must be simple: edges must not cross, and no corner be there "
      "twice");
  }
  return cut;
}

PolygonCutter::PolygonCutter(ConstPointSpan<3> points, double rounding, RingCutter cutRing)
  : Points(points)
  , Rounding(rounding)
  , CutSimple(std::move(cutRing))
{
}

// Positions of the corners, and the polygon's size for tolerances.
void PolygonCutter::ReadPlaces(const Corners& corners)
{
  PointBounds bounds;
  this->Places.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    std::copy_n(this->Points[corners[i]], 3, this->Places[i].data());
    bounds.Add(this->Places[i].data());
  }
  // Tolerances are relative to this.
  this->Size = bounds.Length(bounds.Longest());
}

// Fewer than three corners give no triangle and are no error; three are the triangle itself.
bool PolygonCutter::Cut(const Corners& corners)
{
  this->Made.clear();
  if (corners.size() < 4)
  {
    this->Made = corners.size() == 3 ? corners : Corners();
    return true;
  }
  this->ReadPlaces(corners);
  Ring ring(corners.size());
  std::iota(ring.begin(), ring.end(), std::size_t{ 0 });
  // The attempts change the polygon as little as possible: as it is, without coincident corners,
  // without collinear ones as often as that takes some away.
  bool isCut = this->CutRing(ring);
  if (!isCut)
  {
    ring = this->WithoutEqual(ring);
    isCut = this->CutRing(ring);
  }
  for (std::size_t before = ring.size() + 1; !isCut && ring.size() < before;)
  {
    before = ring.size();
    ring = this->WithoutEqual(this->WithoutStraight(ring));
    isCut = this->CutRing(ring);
  }
  if (isCut)
  {
    this->Append(ring, corners);
  }
  return isCut;
}

// Every other triangle of a strip is reversed, to have the strip's orientation.
void PolygonCutter::CutStrip(const Corners& corners)
{
  this->Made.clear();
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    const bool isOdd = i % 2 == 1;
    this->Made.insert(this->Made.end(),
      { corners[isOdd ? i - 1 : i - 2], corners[isOdd ? i - 2 : i - 1], corners[i] });
  }
}

// Triangles from one corner to all sides that do not have it.
void PolygonCutter::CutFan(const Corners& corners, std::size_t from)
{
  this->Made.clear();
  const std::size_t count = corners.size();
  for (std::size_t i = 1; i + 1 < count; ++i)
  {
    this->Made.insert(this->Made.end(),
      { corners[from], corners[(from + i) % count], corners[(from + i + 1) % count] });
  }
}

// A quadrilateral is cut along a diagonal that does not depend on which corner is first: both
// neighbours of a face of a solid then agree.
void PolygonCutter::CutThin(const Corners& corners)
{
  if (corners.size() == 4)
  {
    this->ReadPlaces(corners);
    this->CutFan(corners, this->IsCutFromOne() ? 1 : 0);
  }
  else if (!this->Cut(corners))
  {
    this->CutFan(corners, 0);
  }
}

// Whether a quadrilateral is cut from corner 1 to 3, not from 0 to 2. A diagonal is within it if
// the triangles on both sides have normals of one direction.
bool PolygonCutter::IsCutFromOne() const
{
  const std::vector<Point<3>>& at = this->Places;
  const auto isWithin = [&at](std::size_t i) {
    const Point<3> one = normalOf(at[i], at[i + 1], at[i + 2]);
    const Point<3> other = normalOf(at[i], at[i + 2], at[(i + 3) % 4]);
    return dot(one, other) > 0.0;
  };
  if (isWithin(0) != isWithin(1))
  {
    return isWithin(1);
  }
  // Both diagonals are within it, or none: the shorter one gives the better shapes.
  const double zero = squaredDistance(at[0], at[2]);
  const double one = squaredDistance(at[1], at[3]);
  if (zero != one)
  {
    return one < zero;
  }
  // Equal diagonals, as in a rectangle: the one with the corner of the least coordinates.
  const auto lowest = std::min_element(at.begin(), at.end());
  return (lowest - at.begin()) % 2 == 1;
}

// Cuts a ring of corners. One of fewer than three corners has no triangles.
bool PolygonCutter::CutRing(const Ring& ring)
{
  this->RingCuts.clear();
  if (ring.size() < 3)
  {
    return true;
  }
  this->RingPlaces.resize(ring.size());
  std::transform(ring.begin(), ring.end(), this->RingPlaces.begin(),
    [this](std::size_t corner) { return this->Places[corner]; });
  return this->CutSimple(this->RingPlaces, this->RingCuts) &&
    this->RingCuts.size() == 3 * (ring.size() - 2);
}

// The corners without those at the place of the corner before, also around the end.
PolygonCutter::Ring PolygonCutter::WithoutEqual(const Ring& ring) const
{
  Ring kept;
  for (const std::size_t corner : ring)
  {
    if (kept.empty() || !this->IsSamePlace(kept.back(), corner))
    {
      kept.push_back(corner);
    }
  }
  while (kept.size() > 1 && this->IsSamePlace(kept.front(), kept.back()))
  {
    kept.pop_back();
  }
  return kept;
}

// Takes out corners that are on the line through their neighbours, but never two neighbours at
// once: the line of the second one would be another one.
PolygonCutter::Ring PolygonCutter::WithoutStraight(const Ring& ring) const
{
  if (ring.size() < 3)
  {
    return ring;
  }
  Ring kept;
  bool isLastLeftOut = false;
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    const std::size_t last = ring[(i + ring.size() - 1) % ring.size()];
    const std::size_t next = ring[(i + 1) % ring.size()];
    const bool isEnd = i + 1 == ring.size() && kept.front() != ring.front();
    isLastLeftOut = !isLastLeftOut && !isEnd && this->IsStraight(last, ring[i], next);
    if (!isLastLeftOut)
    {
      kept.push_back(ring[i]);
    }
  }
  return kept;
}

// Compares along each axis, as the points of a surface are merged.
bool PolygonCutter::IsSamePlace(std::size_t a, std::size_t b) const
{
  const Point<3> way = this->Places[a] - this->Places[b];
  return std::all_of(
    way.begin(), way.end(), [this](double along) { return std::abs(along) <= this->Rounding; });
}

// Tests b by its distance to the line from a to c, or to the point at which both are.
bool PolygonCutter::IsStraight(std::size_t a, std::size_t b, std::size_t c) const
{
  constexpr double part = 1e-7; // vtkPolygon has tolerances of its own, in parts of the size
  const Point<3> u = this->Places[c] - this->Places[a];
  const Point<3> v = this->Places[b] - this->Places[a];
  const double square = dot(u, u);
  const double along = square > 0.0 ? dot(u, v) / square : 0.0;
  // The component of b - a perpendicular to c - a.
  const Point<3> across = v - along * u;
  const double tolerance = std::max(this->Rounding, part * this->Size);
  return std::sqrt(dot(across, across)) <= tolerance || this->IsSamePlace(a, c);
}

// The triangles of the ring by the polygon's points, and triangles without area for what was left
// out.
void PolygonCutter::Append(const Ring& ring, const Corners& corners)
{
  const auto insert = [&](std::size_t a, std::size_t b, std::size_t c) {
    this->Made.insert(this->Made.end(), { corners[a], corners[b], corners[c] });
  };
  for (std::size_t i = 0; i < this->RingCuts.size(); i += 3)
  {
    insert(ring[this->RingCuts[i]], ring[this->RingCuts[i + 1]], ring[this->RingCuts[i + 2]]);
  }
  const std::size_t count = corners.size();
  if (ring.size() < 3) // all corners are on one line
  {
    this->CutFan(corners, 0);
    return;
  }
  // The corners that were left out between two that were kept, as a fan from the first of these.
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    const std::size_t next = ring[(i + 1) % ring.size()];
    for (std::size_t out = (ring[i] + 1) % count; out != next; out = (out + 1) % count)
    {
      insert(ring[i], out, (out + 1) % count);
    }
  }
}

} // namespace RectifiedTransport

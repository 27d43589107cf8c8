// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a surface, cut at T-junctions.
#ifndef RectifiedTransport_SplitSurface_h
#define RectifiedTransport_SplitSurface_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/PlaceOnTriangle.h"
#include "Surfaces/Mesh/Repair/TJunctions.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <array>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Cuts a triangle at points on its sides. `sides` has the points on the side from corner i to the
// next one, in this order; points are numbers of a caller's. No part has all three points on one
// side. The parts turn as the triangle does. Where there is a choice, new edges are short.
// O(points).
class SplitTriangle
{
public:
  using Side = std::vector<std::int64_t>;

  SplitTriangle(ConstPointSpan<3> points, const std::array<std::int64_t, 3>& corners,
    const std::array<Side, 3>& sides);

  // Three numbers of points each.
  const std::vector<std::array<std::int64_t, 3>>& Parts() const { return this->AllParts; }

private:
  void CutOff(const Side& left, const Side& right);
  void Fill(std::int64_t left, std::int64_t right, const Side& base);
  double Squared(std::int64_t a, std::int64_t b) const;
  void Add(std::int64_t a, std::int64_t b, std::int64_t c)
  {
    this->AllParts.push_back({ a, b, c });
  }

  ConstPointSpan<3> Points;
  std::vector<std::array<std::int64_t, 3>> AllParts;
};

class Progress;

// "Given" are the triangles that are cut. The parts of one follow each other in its place; all
// others are as before.
class SplitSurface
{
public:
  // The T-junctions are in the order of findTJunctions; their points are points of the surface.
  // Triangles with `isLeftOut`, if that is not null, have no parts. Memory: 32 bytes a
  // triangle. On one thread. Throws std::bad_alloc and Cancelled.
  SplitSurface(const TriangleSurface& given, const std::vector<TJunction>& junctions,
    Progress& progress, const unsigned char* isLeftOut = nullptr);

  // Three points each.
  const std::int64_t* Triangles() const { return this->Corners.data(); }
  std::int64_t NumberOfTriangles() const { return this->Origins.size(); }
  std::int64_t NumberOfTJunctions() const { return this->Junctions; }

  // The given triangle that a triangle is, or is part of.
  std::int64_t GivenTriangle(std::int64_t triangle) const { return this->Origins.data()[triangle]; }
  bool IsPart(std::int64_t triangle) const
  {
    const std::int64_t* origin = this->Origins.data() + triangle;
    return (triangle > 0 && origin[-1] == *origin) ||
      (triangle + 1 < this->NumberOfTriangles() && origin[1] == *origin);
  }
  // The points of the given triangle.
  std::array<std::int64_t, 3> GivenCorners(std::int64_t triangle) const;
  // The same place on the given triangle.
  PlaceOnTriangle GivenPlace(const PlaceOnTriangle& place) const;

private:
  struct Part
  {
    std::int64_t Triangle;
    std::array<std::int64_t, 3> GivenCorners;
    // By corners: where each is on the given triangle, as barycentric coordinates.
    std::array<std::array<double, 3>, 3> Weights;
  };

  const Part& PartOf(std::int64_t triangle) const;

  LargeBuffer<std::int64_t> Corners; // three points each
  LargeBuffer<std::int64_t> Origins; // given triangles, by triangles
  std::vector<Part> Parts;           // by ascending triangles
  std::int64_t Junctions;
};

} // namespace RectifiedTransport

#endif

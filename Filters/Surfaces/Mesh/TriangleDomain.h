// SPDX-License-Identifier: BSD-3-Clause
// Triangles that points are placed on, and where they are on the given triangles that they come
// from.
#ifndef RectifiedTransport_TriangleDomain_h
#define RectifiedTransport_TriangleDomain_h

#include "Surfaces/Mesh/PlaceOnTriangle.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

struct SurfaceAreas
{
  const double* Shares; // parts of the area, by triangles; they sum to 1
  double Total;         // in units of Unit^2
  double Unit;          // in units of the given points
};

// Interpolates linearly between three given points: the value is the weighted sum of theirs.
struct PointWeights
{
  std::array<std::int64_t, 3> Points;
  std::array<double, 3> Weights;
};

class TriangleDomain
{
public:
  virtual ~TriangleDomain() = default;

  virtual std::int64_t NumberOfTriangles() const = 0;
  // The given triangle that a triangle is, or is part of.
  virtual std::int64_t GivenTriangle(std::int64_t triangle) const = 0;
  // The given points at the corners of a triangle.
  virtual std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const = 0;
  // Whether a triangle is part of one that was cut at T-junctions.
  virtual bool IsPart(std::int64_t) const { return false; }
  // The points and weights of a place on its given triangle.
  virtual PointWeights InGiven(const PlaceOnTriangle& place) const
  {
    return { this->CornersOf(place.Triangle), place.Weights };
  }
  // The triangles in units of Areas().Unit, from the centre of their bounds.
  virtual TriangleSurface Surface() const = 0;
  virtual SurfaceAreas Areas() const = 0;
};

} // namespace RectifiedTransport

#endif

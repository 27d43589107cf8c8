// SPDX-License-Identifier: BSD-3-Clause
// Cuts of triangles by planes across axis 2, and of these cuts by lines along axis 0. Both
// triangles of an edge compute a cut of it from the same numbers in the same order: they agree to
// the last bit.
#ifndef RectifiedTransport_SurfaceCuts_h
#define RectifiedTransport_SurfaceCuts_h

#include "Core/Geometry/CutPolygon.h"
#include "Core/Geometry/Vectors.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace RectifiedTransport
{

// The three corners of a triangle, in index space.
inline std::array<Corner, 3> cornersOf(const TriangleSurface& surface, std::int64_t triangle)
{
  const auto corner = [&](int i) {
    return pointAt(surface.Points, surface.Triangles[3 * triangle + i]);
  };
  return { corner(0), corner(1), corner(2) };
}

// A corner of the polygon in which a plane across axis 2 intersects the surface.
struct PlanePoint
{
  double X;
  double Y;
};

// The intersection of a plane across axis 2 with an edge that crosses it upwards.
inline PlanePoint cutEdge(const Corner& below, const Corner& above, double z)
{
  // Always from the lower to the higher end: both triangles of the edge get the same bits.
  const double t = (z - below[2]) / (above[2] - below[2]);
  return { below[0] + t * (above[0] - below[0]), below[1] + t * (above[1] - below[1]) };
}

// Calls visit(in, out) if the plane intersects the triangle: from the edge that crosses the plane
// upwards to the one that crosses it downwards. A corner on the plane counts as below it.
template <class Visit>
void cutTriangle(const std::array<Corner, 3>& corners, double z, const Visit& visit)
{
  const bool below[3] = { corners[0][2] <= z, corners[1][2] <= z, corners[2][2] <= z };
  if (below[0] == below[1] && below[1] == below[2])
  {
    return;
  }
  PlanePoint in{};
  PlanePoint out{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t next = i == 2 ? 0 : i + 1;
    if (below[i] && !below[next])
    {
      in = cutEdge(corners[i], corners[next], z);
    }
    else if (!below[i] && below[next])
    {
      out = cutEdge(corners[next], corners[i], z);
    }
  }
  visit(in, out);
}

// A segment in such a plane: where its intersections with lines of constant y are along axis 0.
class PlaneSegment
{
public:
  PlaneSegment(const PlanePoint& in, const PlanePoint& out)
    : Up(in.Y < out.Y)
    , Low(this->Up ? in : out) // from the lower end, so that coincident triangles agree
    , High(this->Up ? out : in)
    , Slope((this->High.X - this->Low.X) / (this->High.Y - this->Low.Y))
  {
  }
  // The change of the winding number along axis 0.
  int Side() const { return this->Up ? 1 : -1; }
  // The place on the line of y, from Low.Y to below High.Y.
  double At(double y) const
  {
    // Clamped: rounding must not move the place beyond the segment's ends.
    const double x = this->Low.X + this->Slope * (y - this->Low.Y);
    return std::max(
      std::min(this->Low.X, this->High.X), std::min(x, std::max(this->Low.X, this->High.X)));
  }

private:
  bool Up;
  PlanePoint Low;
  PlanePoint High;
  double Slope;
};

} // namespace RectifiedTransport

#endif

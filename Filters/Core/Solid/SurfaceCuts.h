// SPDX-License-Identifier: BSD-3-Clause
// Cuts of triangles by planes and lines along the axes. Both triangles of an edge compute a cut of
// it from the same numbers in the same order: they agree to the last bit.
#ifndef RectifiedTransport_SurfaceCuts_h
#define RectifiedTransport_SurfaceCuts_h

#include "Core/Mesh/TriangleSurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

using Corner = std::array<double, 3>;

inline std::array<Corner, 3> cornersOf(const TriangleSurface& surface, std::int64_t triangle)
{
  std::array<Corner, 3> corners;
  for (int i = 0; i < 3; ++i)
  {
    const double* point = surface.Points[surface.Triangles[3 * triangle + i]];
    corners[static_cast<std::size_t>(i)] = { point[0], point[1], point[2] };
  }
  return corners;
}

// A convex polygon: a triangle, or what planes along the axes leave of it.
struct CutPolygon
{
  static constexpr int Most = 9; // of a triangle, one more for each side of a box
  std::array<Corner, Most> Corners;
  int Size = 0;

  CutPolygon() = default;
  explicit CutPolygon(const std::array<Corner, 3>& triangle)
    : Size(3)
  {
    this->Corners[0] = triangle[0];
    this->Corners[1] = triangle[1];
    this->Corners[2] = triangle[2];
  }
  void Add(const Corner& corner) { this->Corners[static_cast<std::size_t>(this->Size++)] = corner; }
  const Corner& operator[](int i) const { return this->Corners[static_cast<std::size_t>(i)]; }

  // The lowest and highest coordinate.
  std::array<double, 2> Range(int axis) const
  {
    const auto a = static_cast<std::size_t>(axis);
    std::array<double, 2> range{ HUGE_VAL, -HUGE_VAL };
    for (int i = 0; i < this->Size; ++i)
    {
      range[0] = std::min(range[0], (*this)[i][a]);
      range[1] = std::max(range[1], (*this)[i][a]);
    }
    return range;
  }
};

// Cuts a polygon by the plane at a value of an axis into what is below and what is above; corners
// on the plane belong to both.
template <int Axis>
void cutPolygon(const CutPolygon& polygon, double value, CutPolygon& below, CutPolygon& above)
{
  below.Size = 0;
  above.Size = 0;
  const Corner* last = &polygon.Corners[static_cast<std::size_t>(polygon.Size - 1)];
  for (int i = 0; i < polygon.Size; ++i)
  {
    const Corner* next = &polygon.Corners[static_cast<std::size_t>(i)];
    const double a = (*last)[Axis];
    const double b = (*next)[Axis];
    if ((a < value && b > value) || (a > value && b < value))
    {
      const Corner& low = a < b ? *last : *next;
      const Corner& high = a < b ? *next : *last;
      const double t = (value - low[Axis]) / (high[Axis] - low[Axis]);
      Corner cut;
      for (std::size_t k = 0; k < 3; ++k)
      {
        cut[k] = low[k] + t * (high[k] - low[k]);
      }
      cut[Axis] = value;
      below.Add(cut);
      above.Add(cut);
    }
    if (b <= value)
    {
      below.Add(*next);
    }
    if (b >= value)
    {
      above.Add(*next);
    }
    last = next;
  }
}

// Calls visit(i, part) for the parts of a polygon in the slabs i <= coordinate <= i + 1 of an axis,
// i from 0 to below `slabs`, in ascending order, and visit(-1, part) for one below 0. The cuts do
// not depend on `slabs`.
template <int Axis, class Visit>
void forSlabs(const CutPolygon& polygon, std::int64_t slabs, const Visit& visit)
{
  const std::array<double, 2> range = polygon.Range(Axis);
  if (range[0] >= static_cast<double>(slabs))
  {
    return;
  }
  auto i = range[0] < 0.0 ? std::int64_t{ -1 } : static_cast<std::int64_t>(range[0]);
  if (range[1] <= static_cast<double>(i + 1)) // as of most small triangles
  {
    visit(i, polygon);
    return;
  }
  CutPolygon rests[2];
  const CutPolygon* rest = &polygon;
  for (int turn = 0; i < slabs; ++i, turn = 1 - turn)
  {
    const auto end = static_cast<double>(i + 1);
    if (range[1] <= end)
    {
      visit(i, *rest);
      return;
    }
    CutPolygon below;
    cutPolygon<Axis>(*rest, end, below, rests[turn]);
    visit(i, below);
    rest = &rests[turn];
  }
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

// A segment in such a plane: places along axis 0 of its intersections with lines of constant y.
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

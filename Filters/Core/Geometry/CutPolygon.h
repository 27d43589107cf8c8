// SPDX-License-Identifier: BSD-3-Clause
// Convex polygons and their cuts by planes across the axes. The two polygons at an edge compute a
// cut of it from the same numbers in the same order: they agree to the last bit.
#ifndef RectifiedTransport_CutPolygon_h
#define RectifiedTransport_CutPolygon_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

using Corner = std::array<double, 3>;

// A convex polygon: a triangle, or what planes across the axes leave of it. One of two corners is a
// segment.
struct CutPolygon
{
  static constexpr int Most = 9; // 3 of a triangle, and one more for each side of a box
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

// Cuts a polygon by the plane at a value of an axis into what is below and what is above
// (Sutherland and Hodgman). Corners on the plane belong to both.
template <int Axis>
void cutPolygon(const CutPolygon& polygon, double value, CutPolygon& below, CutPolygon& above)
{
  below.Size = 0;
  above.Size = 0;
  const Corner* last =
    &polygon.Corners[polygon.Size > 2 ? static_cast<std::size_t>(polygon.Size - 1) : 0];
  for (int i = 0; i < polygon.Size; ++i)
  {
    const Corner* next = &polygon.Corners[static_cast<std::size_t>(i)];
    const double a = (*last)[Axis];
    const double b = (*next)[Axis];
    if ((a < value && b > value) || (a > value && b < value))
    {
      // From the lower to the higher corner, whichever way the polygon runs.
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

// The parts of a polygon between parallel planes, in ascending order. Each cut works on what is
// left above the last plane, so that n slabs take n cuts.
template <int Axis>
class PolygonSlabs
{
public:
  PolygonSlabs() = default;
  PolygonSlabs(const PolygonSlabs&) = delete;
  PolygonSlabs& operator=(const PolygonSlabs&) = delete;

  // Slabs begin at `begin`: what lies below it is left out.
  void Begin(const CutPolygon& polygon, double begin)
  {
    this->Remainder = &polygon;
    this->Range = polygon.Range(Axis);
    this->Next = 0;
    if (this->Range[0] < begin)
    {
      this->UpTo(begin);
    }
  }
  // The part from the last end to this one.
  const CutPolygon& UpTo(double end)
  {
    if (this->Range[1] <= end)
    {
      this->Range = { HUGE_VAL, HUGE_VAL };
      return *this->Remainder;
    }
    this->Below.Size = 0;
    if (this->Range[0] <= end)
    {
      cutPolygon<Axis>(*this->Remainder, end, this->Below, this->Remainders[this->Next]);
      this->Remainder = &this->Remainders[this->Next];
      this->Next = 1 - this->Next;
    }
    return this->Below;
  }
  bool IsAtEnd() const { return this->Range[0] == HUGE_VAL; }

private:
  const CutPolygon* Remainder;
  std::array<double, 2> Range; // range of the polygon along the axis
  CutPolygon Below;
  std::array<CutPolygon, 2> Remainders; // what is left, and memory for the next cut
  std::size_t Next;
};

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
  PolygonSlabs<Axis> parts;
  parts.Begin(polygon, -HUGE_VAL);
  for (; i < slabs && !parts.IsAtEnd(); ++i)
  {
    visit(i, parts.UpTo(static_cast<double>(i + 1)));
  }
}

// The part of a polygon in begin <= coordinate <= begin + 1 of an axis. It is the polygon itself or
// one of `parts`, which serve as memory.
template <int Axis>
const CutPolygon& slabOf(const CutPolygon& polygon, double begin, std::array<CutPolygon, 2>& parts)
{
  const std::array<double, 2> range = polygon.Range(Axis);
  const CutPolygon* part = &polygon;
  if (range[0] > begin + 1.0 || range[1] < begin)
  {
    parts[0].Size = 0;
    return parts[0];
  }
  CutPolygon outside;
  if (range[0] < begin)
  {
    cutPolygon<Axis>(*part, begin, outside, parts[0]);
    part = &parts[0];
  }
  if (range[1] > begin + 1.0)
  {
    cutPolygon<Axis>(*part, begin + 1.0, parts[1], outside);
    part = &parts[1];
  }
  return *part;
}

} // namespace RectifiedTransport

#endif

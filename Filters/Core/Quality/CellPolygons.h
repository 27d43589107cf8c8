// SPDX-License-Identifier: BSD-3-Clause
// Triangles in space, cut at the faces of grid cells.
#ifndef RectifiedTransport_CellPolygons_h
#define RectifiedTransport_CellPolygons_h

#include "Core/Geometry/GridSize.h"

#include <algorithm>
#include <cstdint>

namespace RectifiedTransport
{

// A convex polygon in space: a triangle has at most two more corners after cuts along each axis.
struct SpacePolygon
{
  static constexpr int MostCorners = 9;

  int Count = 0;
  double Corners[MostCorners][3];

  void Add(const double* x) { std::copy_n(x, 3, this->Corners[this->Count++]); }
};

// Divides a polygon at the plane x[axis] = place. Corners on the plane are in both parts.
inline void cut(
  const SpacePolygon& all, int axis, double place, SpacePolygon& below, SpacePolygon& above)
{
  below.Count = 0;
  above.Count = 0;
  const double* last = all.Corners[all.Count - 1];
  for (int i = 0; i < all.Count; ++i)
  {
    const double* next = all.Corners[i];
    const double from = last[axis] - place;
    const double to = next[axis] - place;
    if ((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0))
    {
      const double part = from / (from - to);
      double x[3];
      for (int a = 0; a < 3; ++a)
      {
        x[a] = last[a] + part * (next[a] - last[a]);
      }
      // The cut is on the plane exactly, so that pieces of neighbouring cells match.
      x[axis] = place;
      below.Add(x);
      above.Add(x);
    }
    if (to <= 0.0)
    {
      below.Add(next);
    }
    if (to >= 0.0)
    {
      above.Add(next);
    }
    last = next;
  }
}

// Calls visit(polygon, cell) for the parts of a polygon in the cells of a grid, axis by axis from
// `Axis` down to 0.
template <int Axis, class Visit>
void visitCells(
  const SpacePolygon& polygon, const GridSize<3>& size, GridSize<3>& cell, const Visit& visit)
{
  double low = polygon.Corners[0][Axis];
  double high = low;
  for (int i = 1; i < polygon.Count; ++i)
  {
    low = std::min(low, polygon.Corners[i][Axis]);
    high = std::max(high, polygon.Corners[i][Axis]);
  }
  const auto enter = [&](const SpacePolygon& part, std::int64_t place) {
    cell[Axis] = place;
    if constexpr (Axis == 0)
    {
      visit(part, cell);
    }
    else
    {
      visitCells<Axis - 1>(part, size, cell, visit);
    }
  };
  std::int64_t place = std::min(static_cast<std::int64_t>(low), size[Axis] - 1);
  const SpacePolygon* rest = &polygon;
  SpacePolygon parts[2];
  SpacePolygon below;
  for (int next = 0; static_cast<double>(place + 1) < high; ++place, next = 1 - next)
  {
    cut(*rest, Axis, static_cast<double>(place + 1), below, parts[next]);
    // Fewer than three corners have no area.
    if (below.Count > 2)
    {
      enter(below, place);
    }
    rest = &parts[next];
  }
  if (rest->Count > 2)
  {
    enter(*rest, place);
  }
}

} // namespace RectifiedTransport

#endif

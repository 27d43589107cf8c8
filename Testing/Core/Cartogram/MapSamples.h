// SPDX-License-Identifier: BSD-3-Clause
// Small maps for tests of cartograms.
#ifndef RectifiedTransport_MapSamples_h
#define RectifiedTransport_MapSamples_h

#include "Core/Cartogram/Cartogram.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

using Ring = std::vector<Point<2>>;

inline Ring rectangle(double x0, double y0, double x1, double y1)
{
  return { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } };
}

inline void addRing(RegionMap& map, std::int32_t region, const Ring& ring)
{
  std::vector<std::int64_t> points;
  for (const Point<2>& place : ring)
  {
    points.push_back(map.AddPoint(place));
  }
  map.AddRing(region, points);
}

// side^2 unit squares, whose points are their own or shared; the holes are found.
inline RegionMap squares(int side, bool areShared = false)
{
  RegionMap map;
  const auto number = [side](
                        int x, int y) { return static_cast<std::int64_t>(y * (side + 1) + x); };
  for (int y = 0; areShared && y <= side; ++y)
  {
    for (int x = 0; x <= side; ++x)
    {
      map.AddPoint({ static_cast<double>(x), static_cast<double>(y) });
    }
  }
  for (int i = 0; i < side * side; ++i)
  {
    const int x = i % side;
    const int y = i / side;
    if (areShared)
    {
      map.AddRing(i, { number(x, y), number(x + 1, y), number(x + 1, y + 1), number(x, y + 1) });
    }
    else
    {
      addRing(map, i, rectangle(x, y, x + 1, y + 1));
    }
  }
  map.FindHoles();
  return map;
}

} // namespace RectifiedTransport

#endif

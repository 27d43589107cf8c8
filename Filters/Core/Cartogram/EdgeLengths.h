// SPDX-License-Identifier: BSD-3-Clause
// How long the edges of a map may be in a raster of densities, so that they bend where it moves.
#ifndef RectifiedTransport_EdgeLengths_h
#define RectifiedTransport_EdgeLengths_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// The cells of a square raster of `Side` cells a side.
struct EdgeLengths
{
  const std::vector<double>& Cells;
  std::int64_t Side;

  // Edges are short where regions grow: the cells have the ratio of density to mean, at least 1,
  // and lengths grow with its square root.
  double ExpansionAt(const Point<2>& middle) const
  {
    return this->Longest() / std::sqrt(std::max(1.0, this->CellsAbout(middle).second));
  }
  // Edges are short where densities differ between neighbouring cells, because neighbouring points
  // then move differently.
  double ByContrast(const Point<2>& middle) const
  {
    constexpr double mostParts = 8.0; // parts of a longest edge
    const auto [least, largest] = this->CellsAbout(middle);
    return this->Longest() / std::clamp(std::sqrt(largest / least), 1.0, mostParts);
  }
  double Longest() const
  {
    constexpr double edgesOfSide = 512.0; // a longest edge is this part of the box's side
    return static_cast<double>(this->Side) / edgesOfSide;
  }
  // The least and the largest of the 3 x 3 cells around a place.
  std::pair<double, double> CellsAbout(const Point<2>& place) const
  {
    std::int64_t begin[2];
    std::int64_t end[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      const auto at = std::clamp<std::int64_t>(
        static_cast<std::int64_t>(std::floor(place[axis])), 0, this->Side - 1);
      begin[axis] = std::max<std::int64_t>(0, at - 1);
      end[axis] = std::min(this->Side, at + 2);
    }
    std::pair<double, double> range{ HUGE_VAL, 0.0 };
    for (std::int64_t y = begin[1]; y < end[1]; ++y)
    {
      for (std::int64_t x = begin[0]; x < end[0]; ++x)
      {
        const double cell = this->Cells[static_cast<std::size_t>(y * this->Side + x)];
        range = { std::min(range.first, cell), std::max(range.second, cell) };
      }
    }
    return range;
  }
};

} // namespace RectifiedTransport

#endif

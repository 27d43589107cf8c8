// SPDX-License-Identifier: BSD-3-Clause
// How long the edges of a map may be in a raster of densities, so that they bend where it moves.
#ifndef RectifiedTransport_EdgeLengths_h
#define RectifiedTransport_EdgeLengths_h

#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class EdgeLengths
{
public:
  EdgeLengths(const std::vector<double>& cells, std::int64_t side)
    : Cells(cells)
    , Side(side)
  {
  }

  // Edges are short where regions grow: cells have how many times as dense as all regions they are.
  double WhereItGrows(const Point<2>& middle) const
  {
    return this->Longest() / std::sqrt(std::max(1.0, this->CellsAbout(middle).Largest));
  }
  // Edges are short where densities differ from cell to cell, as points beside each other then move
  // differently.
  double ByContrast(const Point<2>& middle) const
  {
    constexpr double mostParts = 8.0; // of a longest edge
    const Range densities = this->CellsAbout(middle);
    return this->Longest() /
      std::clamp(std::sqrt(densities.Largest / densities.Least), 1.0, mostParts);
  }

private:
  struct Range
  {
    double Least;
    double Largest;
  };

  double Longest() const
  {
    constexpr double edgesOfSide = 512.0; // the longest edges are this part of the box
    return static_cast<double>(this->Side) / edgesOfSide;
  }

  // The range of the 3 x 3 cells around a place.
  Range CellsAbout(const Point<2>& place) const
  {
    std::int64_t at[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      at[axis] = std::clamp<std::int64_t>(
        static_cast<std::int64_t>(std::floor(place[axis])), 0, this->Side - 1);
    }
    Range range{ HUGE_VAL, 0.0 };
    for (std::int64_t y = std::max<std::int64_t>(0, at[1] - 1); y < std::min(this->Side, at[1] + 2);
         ++y)
    {
      for (std::int64_t x = std::max<std::int64_t>(0, at[0] - 1);
           x < std::min(this->Side, at[0] + 2); ++x)
      {
        const double cell = this->Cells[static_cast<std::size_t>(y * this->Side + x)];
        range = { std::min(range.Least, cell), std::max(range.Largest, cell) };
      }
    }
    return range;
  }

  const std::vector<double>& Cells;
  std::int64_t Side;
};

} // namespace RectifiedTransport

#endif

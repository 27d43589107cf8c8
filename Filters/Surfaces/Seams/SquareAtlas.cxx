// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/SquareAtlas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

// Puts squares of descending sides in rows, from left to right. A row is as high as its first
// square. Returns the height of all rows.
double fillRows(
  const std::vector<double>& sides, double scale, double margin, std::vector<AtlasSquare>& squares)
{
  double x = 0.0;
  double y = 0.0;
  double height = 0.0; // height of the row
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const double side = scale * sides[i];
    if (i > 0 && x + side > 1.0)
    {
      x = 0.0;
      y += height + margin;
    }
    // Sides descend, so that the first one of a row is the highest.
    height = x == 0.0 ? side : height;
    squares[i] = { { x, y }, side };
    x += side + margin;
  }
  return y + height;
}

} // namespace

double atlasMargin(std::size_t squares)
{
  return squares > 1 ? 1.0 / (64.0 * std::ceil(std::sqrt(static_cast<double>(squares)))) : 0.0;
}

std::vector<AtlasSquare> arrangeSquares(const std::vector<double>& areas)
{
  // One square alone needs no margin.
  if (areas.size() == 1)
  {
    return { { { 0.0, 0.0 }, 1.0 } };
  }
  std::vector<std::size_t> order(areas.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<double> sides;
  for (const std::size_t i : order)
  {
    // At the scale 1, the squares' areas sum to 1.
    sides.push_back(std::sqrt(areas[i] / total));
  }

  const double margin = atlasMargin(areas.size());
  std::vector<AtlasSquare> rows(areas.size());
  double low = 0.0; // a scale for which there is room: the invariant of the bisection
  double high = 1.0;
  // 40 halvings of [0,1] reach 1e-12 of the unit square. At the scale 1 the squares' areas alone
  // would fill it.
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i)
  {
    const double scale = 0.5 * (low + high);
    // The height grows with the scale: there is room below some scale.
    (fillRows(sides, scale, margin, rows) <= 1.0 ? low : high) = scale;
  }
  fillRows(sides, low, margin, rows);
  std::vector<AtlasSquare> squares(areas.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    squares[order[i]] = rows[i];
  }
  return squares;
}

} // namespace RectifiedTransport

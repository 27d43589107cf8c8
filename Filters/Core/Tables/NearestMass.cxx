// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/NearestMass.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// Rows of cells are along axis 0, 64 cells a word.
template <int Dimension>
using Cell = std::array<std::int64_t, Dimension>;

// Returns the words of the row that contains a cell, one bit a cell.
template <int Dimension>
const std::uint64_t* occupiedRow(const TableView<Dimension>& tables, const Cell<Dimension>& cell)
{
  std::int64_t row = 0;
  for (int axis = Dimension - 1; axis > 0; --axis)
  {
    row = row * tables.Cells[axis] + cell[axis];
  }
  return tables.Occupied + row * tables.WordsPerRow;
}

// Whether a cell of a row has mass.
bool isSet(const std::uint64_t* row, std::int64_t column)
{
  return (row[column >> 6] >> (column & 63)) & 1;
}

// The distance of a coordinate from grid cell `cell`.
double gap(double x, std::int64_t cell)
{
  const double low = static_cast<double>(cell);
  return std::max({ low - x, x - (low + 1.0), 0.0 });
}

// The nearest set bit from `start` down to `last`, -1 if there is none.
std::int64_t nearestBelow(const std::uint64_t* row, std::int64_t start, std::int64_t last)
{
  // The bits above `start` are masked out; then whole words are searched.
  std::int64_t word = start >> 6;
  std::uint64_t bits = row[word] & (~std::uint64_t{ 0 } >> (63 - (start & 63)));
  while (bits == 0 && word > last >> 6)
  {
    bits = row[--word];
  }
  const std::int64_t found = bits == 0 ? -1 : word * 64 + 63 - __builtin_clzll(bits);
  return found >= last ? found : -1;
}

// The nearest set bit from `start` up to `last`, -1 if there is none.
std::int64_t nearestAbove(const std::uint64_t* row, std::int64_t start, std::int64_t last)
{
  std::int64_t word = start >> 6;
  std::uint64_t bits = row[word] & (~std::uint64_t{ 0 } << (start & 63));
  while (bits == 0 && word < last >> 6)
  {
    bits = row[++word];
  }
  const std::int64_t found = bits == 0 ? -1 : word * 64 + __builtin_ctzll(bits);
  return found <= last ? found : -1;
}

// The column of the nearest cell with mass in a row, -1 if there is none within `limit` of x.
std::int64_t nearestInRow(const std::uint64_t* row, std::int64_t columns, double x, double limit)
{
  const double last = static_cast<double>(columns - 1);
  const auto column = [last](double at) {
    return static_cast<std::int64_t>(std::max(0.0, std::min(at, last)));
  };
  // The search goes from the column of x in both directions.
  const std::int64_t start = column(x);
  const std::int64_t below = nearestBelow(row, start, column(x - limit));
  const std::int64_t above = nearestAbove(row, start, column(x + limit));
  if (below < 0 || above < 0)
  {
    return std::max(below, above);
  }
  return gap(x, below) <= gap(x, above) ? below : above;
}

} // namespace

template <int Dimension>
bool hasMass(const TableView<Dimension>& tables, const Point<Dimension>& point)
{
  if (!tables.Occupied)
  {
    return true;
  }
  // A point on a face belongs to the cells on both sides: a bit of `corner` selects the lower cell
  // along an axis, which counts only if the coordinate is a whole number.
  for (int corner = 0; corner < (1 << Dimension); ++corner)
  {
    Cell<Dimension> cell;
    bool inside = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double floor = std::floor(point[axis]);
      const bool lower = (corner >> axis) & 1;
      cell[axis] = static_cast<std::int64_t>(floor) - (lower ? 1 : 0);
      inside = inside && cell[axis] >= 0 && cell[axis] < tables.Cells[axis] &&
        (!lower || point[axis] == floor);
    }
    if (inside && isSet(occupiedRow<Dimension>(tables, cell), cell[0]))
    {
      return true;
    }
  }
  return false;
}

// Tables without bits have mass in all cells: the point stays.
template <int Dimension>
Point<Dimension> nearestMass(
  const TableView<Dimension>& tables, const Point<Dimension>& point, const Point<Dimension>& sides)
{
  if (!tables.Occupied)
  {
    return point;
  }
  // Points are placed this far from the faces of the cell, so that rounding of later mappings does
  // not move them back into an empty cell.
  constexpr double inset = 1.0 / (1 << 20);
  Cell<Dimension> centre;
  std::int64_t farthest = 1;
  double thinnest = std::numeric_limits<double>::max(); // side across the rows
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // The cell of the point, or the nearest one in the domain.
    centre[axis] =
      std::min(static_cast<std::int64_t>(std::max(point[axis], 0.0)), tables.Cells[axis] - 1);
    farthest = axis > 0 ? std::max(farthest, tables.Cells[axis]) : farthest;
    thinnest = axis > 0 ? std::min(thinnest, sides[axis]) : thinnest;
  }
  Cell<Dimension> nearest = centre;
  double best = std::numeric_limits<double>::max();
  // Squared distances: `across` is that of the row, `along` that of a cell in it. The search in a
  // row is limited to cells nearer than the best one so far.
  const auto tryRow = [&](const Cell<Dimension>& at) {
    double across = 0.0;
    for (int axis = 1; axis < Dimension; ++axis)
    {
      if (at[axis] < 0 || at[axis] >= tables.Cells[axis])
      {
        return;
      }
      const double distance = gap(point[axis], at[axis]) * sides[axis];
      across += distance * distance;
    }
    if (across > best)
    {
      return;
    }
    // Only cells within this number of columns can be nearer than the best one.
    const double limit = std::sqrt(best - across) / sides[0];
    const std::int64_t column =
      nearestInRow(occupiedRow<Dimension>(tables, at), tables.Cells[0], point[0], limit);
    const double along = column < 0 ? 0.0 : gap(point[0], column) * sides[0];
    if (column >= 0 && across + along * along < best)
    {
      best = across + along * along;
      nearest = at;
      nearest[0] = column;
    }
  };
  // Rows are tried in square shells around the row of the point. The rows of a shell are at least
  // shell - 1 cells away along an axis, so the search ends once that distance exceeds the best.
  for (std::int64_t shell = 0; shell < farthest; ++shell)
  {
    const double least = static_cast<double>(std::max<std::int64_t>(shell - 1, 0)) * thinnest;
    if (least * least > best)
    {
      break;
    }
    const std::int64_t planes = Dimension > 2 ? shell : 0; // on both sides
    const std::int64_t rows = Dimension > 1 ? shell : 0;
    for (std::int64_t k = -planes; k <= planes; ++k)
    {
      // A cap (|k| = shell) has all its rows; between the caps only the two outer rows belong to
      // the shell.
      const bool isCap = Dimension > 2 && std::abs(k) == shell;
      for (std::int64_t j = -rows; j <= rows; j += isCap ? 1 : std::max<std::int64_t>(2 * shell, 1))
      {
        const std::int64_t away[3] = { 0, j, k };
        Cell<Dimension> at;
        std::transform(centre.begin(), centre.end(), away, at.begin(), std::plus<>());
        tryRow(at);
      }
    }
  }
  Point<Dimension> moved;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double low = static_cast<double>(nearest[axis]);
    moved[axis] = std::max(low + inset, std::min(point[axis], low + 1.0 - inset));
  }
  return moved;
}

template bool hasMass<1>(const TableView<1>&, const Point<1>&);
template bool hasMass<2>(const TableView<2>&, const Point<2>&);
template bool hasMass<3>(const TableView<3>&, const Point<3>&);
template Point<1> nearestMass<1>(const TableView<1>&, const Point<1>&, const Point<1>&);
template Point<2> nearestMass<2>(const TableView<2>&, const Point<2>&, const Point<2>&);
template Point<3> nearestMass<3>(const TableView<3>&, const Point<3>&, const Point<3>&);

} // namespace RectifiedTransport

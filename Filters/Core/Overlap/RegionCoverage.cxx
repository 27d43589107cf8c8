// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Overlap/RegionCoverage.h"

#include <algorithm>

namespace RectifiedTransport
{

RegionCoverage::RegionCoverage(const GridSlab<2>& slab)
  : Slab(slab)
  , Shares(static_cast<std::size_t>((slab.Last - slab.First) * slab.Size[0]), Share{ 0.0, 0.0 })
  , IsCrossed(this->Shares.size(), 0)
  , Rows(static_cast<std::size_t>(slab.Last - slab.First), Row{ slab.Size[0], -1, 0.0 })
  , FirstRow(slab.Last)
  , LastRow(slab.First - 1)
{
}

// By Green's theorem, an edge covers in each row of cells the trapezoid between it and the grid's
// end, with the sign of its direction along axis 1. The sum over a closed outline is the area
// inside.
void RegionCoverage::Add(const Point<2>& from, const Point<2>& to)
{
  if (from[1] == to[1])
  {
    return;
  }
  // From the lower end, so that an edge there and back adds nothing.
  const bool isUp = from[1] < to[1];
  const Point<2>& low = isUp ? from : to;
  const Point<2>& high = isUp ? to : from;
  const double begin = std::max(low[1], static_cast<double>(this->Slab.First));
  const double end = std::min(high[1], static_cast<double>(this->Slab.Last));
  if (!(begin < end))
  {
    return;
  }
  // dx / dy along the edge.
  const double slope = (high[0] - low[0]) / (high[1] - low[1]);
  const double left = std::min(low[0], high[0]);
  const double right = std::max(low[0], high[0]);
  // The highest point is met exactly: the next edge begins there.
  const auto at = [&](double y) {
    return y == high[1] ? high[0] : std::clamp(low[0] + (y - low[1]) * slope, left, right);
  };
  const auto first = static_cast<std::int64_t>(std::floor(begin));
  double y = begin;
  double x = at(begin);
  for (std::int64_t row = first; y < end; ++row)
  {
    const double nextY = std::min(static_cast<double>(row + 1), end);
    const double nextX = at(nextY);
    this->AddInRow(row, x, nextX, isUp ? y - nextY : nextY - y);
    x = nextX;
    y = nextY;
  }
}

// Adds an edge's part in a row of cells: from `from` to `to` along axis 0, with the height of the
// part. The region is to the right of the part where the height is positive.
void RegionCoverage::AddInRow(std::int64_t row, double from, double to, double height)
{
  const auto width = static_cast<double>(this->Slab.Size[0]);
  Row& rowSpan = this->Rows[static_cast<std::size_t>(row - this->Slab.First)];
  const std::int64_t rowBegin = (row - this->Slab.First) * this->Slab.Size[0];
  Share* shares = this->Shares.data() + rowBegin;
  unsigned char* isCrossed = this->IsCrossed.data() + rowBegin;
  const double low = std::min(from, to);
  const double high = std::max(from, to);
  this->FirstRow = std::min(this->FirstRow, row);
  this->LastRow = std::max(this->LastRow, row);
  rowSpan.Heights += std::abs(height);
  if (low >= width)
  {
    rowSpan.Last = this->Slab.Size[0] - 1;
    return;
  }
  const auto add = [&](std::int64_t cell, double part, double toRight) {
    // A trapezoid: height times the mean distance to the right face.
    shares[cell].Area += part * toRight;
    shares[cell].Height += part;
    isCrossed[cell] = 1;
  };
  // The height that falls on a length of 1 along axis 0.
  const double perLength = high > low ? height / (high - low) : 0.0;
  // What is to the left of the grid covers all cells: it counts at the first cell's left face.
  if (low < 0.0)
  {
    add(0, high <= 0.0 ? height : -low * perLength, 1.0);
  }
  const double begin = std::max(low, 0.0);
  const double end = std::min(high, width);
  const std::int64_t first = static_cast<std::int64_t>(begin);
  const std::int64_t last =
    std::min(static_cast<std::int64_t>(std::max(end, 0.0)), this->Slab.Size[0] - 1);
  // The cells that Finish has to visit.
  rowSpan.First = std::min(rowSpan.First, first);
  rowSpan.Last = std::max(rowSpan.Last, last);
  if (high < 0.0 || (high <= 0.0 && low < 0.0))
  {
    return;
  }
  if (first == last)
  {
    const double part = low == begin && high == end ? height : (end - begin) * perLength;
    // A trapezoid within one cell: its height times the mean distance to the cell's right face.
    add(first, part, static_cast<double>(first + 1) - 0.5 * (begin + end));
    return;
  }
  const double inFirst = static_cast<double>(first + 1) - begin;
  // Its part in the first cell, whose mean distance to the right face is half of its length; in a
  // cell that it crosses whole, 1/2; in the last cell, 1 minus half of the length in it.
  add(first, inFirst * perLength, 0.5 * inFirst);
  for (std::int64_t cell = first + 1; cell < last; ++cell)
  {
    add(cell, perLength, 0.5);
  }
  const double inLast = end - static_cast<double>(last);
  add(last, inLast * perLength, 1.0 - 0.5 * inLast);
}

// Coverages above 1 or below 0 are rounding errors: the region covers each place once at most.
void RegionCoverage::Finish(double value)
{
  double* const sums = this->Slab.Sums;
  this->FinishRows(
    [sums, value](std::int64_t first, std::int64_t last, double covered, double tolerance) {
      if (covered > tolerance)
      {
        const double sum = value * (covered < 1.0 - tolerance ? covered : 1.0);
        std::for_each(sums + first, sums + last, [sum](double& cell) { cell += sum; });
      }
    });
}

} // namespace RectifiedTransport

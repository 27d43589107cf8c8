// SPDX-License-Identifier: BSD-3-Clause
// What regions between straight edges cover of each cell of a plane grid, exact to rounding.
#ifndef RectifiedTransport_RegionCoverage_h
#define RectifiedTransport_RegionCoverage_h

#include "Core/Overlap/Overlap.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

// For one thread. Each edge adds the signed area to its right in the cells that it crosses, and its
// height to all cells farther right, as a difference that is summed along the row: O(cells that
// edges cross), and a search of bytes between them.
class RegionCoverage
{
public:
  explicit RegionCoverage(const GridSlab<2>& slab);

  // Adds an edge, in index space, with the region on the left. Edges may be beyond the grid.
  void Add(const Point<2>& from, const Point<2>& to);
  // Adds to the slab's sums the value times the area that the edges since the last call enclose.
  void Finish(double value);
  // The same for edges that may run the other way round: calls visit(first, last, area) for the
  // cells [first, last) of the grid that have this area each. The area is negative inside of an
  // outline that runs clockwise, and a multiple where edges run around several times. Cells between
  // edges come together, row after row.
  template <class Visit>
  void FinishSigned(const Visit& visit)
  {
    this->FinishRows(
      [&visit](std::int64_t first, std::int64_t last, double covered, double tolerance) {
        const double whole = std::round(covered);
        const double area = std::abs(covered - whole) > tolerance ? covered : whole;
        if (area != 0.0)
        {
          visit(first, last, area);
        }
      });
  }

private:
  struct Share
  {
    double Area;   // signed area to the right of edges within this cell
    double Height; // signed height of edges: the part of each cell to the right
  };
  struct Row
  {
    std::int64_t First;
    std::int64_t Last;
    double Heights; // sum of the heights of all edges, which bounds rounding errors
  };

  // Calls visit(first, last, covered, rounding) for the cells that edges have come by: those that
  // edges cross one by one, and the others [first, last) between them.
  template <class Visit>
  void FinishRows(const Visit& visit)
  {
    // The relative error of a sum of heights.
    constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    for (std::int64_t row = this->FirstRow; row <= this->LastRow; ++row)
    {
      Row& span = this->Rows[static_cast<std::size_t>(row - this->Slab.First)];
      const std::int64_t begin = (row - this->Slab.First) * this->Slab.Size[0];
      Share* shares = this->Shares.data() + begin;
      unsigned char* isCrossed = this->IsCrossed.data() + begin;
      // Cells outside must have nothing at all, else particles might be put there.
      const double tolerance = rounding * span.Heights;
      const std::int64_t rowBegin = row * this->Slab.Size[0];
      double height = 0.0;
      for (std::int64_t cell = span.First; cell <= span.Last; ++cell)
      {
        const void* found =
          std::memchr(isCrossed + cell, 1, static_cast<std::size_t>(span.Last + 1 - cell));
        const std::int64_t crossed =
          found ? static_cast<const unsigned char*>(found) - isCrossed : span.Last + 1;
        if (cell < crossed)
        {
          visit(rowBegin + cell, rowBegin + crossed, height, tolerance);
        }
        cell = crossed;
        if (found)
        {
          const double covered = height + shares[cell].Area;
          height += shares[cell].Height;
          shares[cell] = { 0.0, 0.0 };
          isCrossed[cell] = 0;
          visit(rowBegin + cell, rowBegin + cell + 1, covered, tolerance);
        }
      }
      span = { this->Slab.Size[0], -1, 0.0 };
    }
    this->FirstRow = this->Slab.Last;
    this->LastRow = this->Slab.First - 1;
  }
  void AddInRow(std::int64_t row, double from, double to, double height);

  const GridSlab<2> Slab;               // in the grid, [First, Last) along axis 1
  std::vector<Share> Shares;            // by cells of the slab
  std::vector<unsigned char> IsCrossed; // the cells that edges have added to
  std::vector<Row> Rows;                // by rows of the slab
  std::int64_t FirstRow;                // rows that edges have come by
  std::int64_t LastRow;
};

} // namespace RectifiedTransport

#endif

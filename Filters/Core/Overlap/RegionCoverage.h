// SPDX-License-Identifier: BSD-3-Clause
// What regions between straight edges cover of each cell of a plane grid, exact to rounding.
#ifndef RectifiedTransport_RegionCoverage_h
#define RectifiedTransport_RegionCoverage_h

#include "Core/Overlap/Overlap.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

// For one thread. Each edge adds the signed area to its right in the cells that it crosses, and its
// height to all cells farther right: O(cells that edges cross + cells between them).
class RegionCoverage
{
public:
  explicit RegionCoverage(const GridSlab<2>& slab);

  // In index space, with the region on the left. Edges may be beyond the grid.
  void Add(const Point<2>& from, const Point<2>& to);
  // Adds to the slab's sums the value times the area that the edges since the last call enclose.
  void Finish(double value);
  // The same where edges may run the other way round: visit(cell, area) of the cells of the grid
  // with an area, which is negative there, and a multiple where edges run around several times.
  template <class Visit>
  void FinishSigned(const Visit& visit)
  {
    this->FinishRows([&visit](std::int64_t cell, double covered, double tolerance) {
      const double whole = std::round(covered);
      const double area = std::abs(covered - whole) > tolerance ? covered : whole;
      if (area != 0.0)
      {
        visit(cell, area);
      }
    });
  }

private:
  struct Share
  {
    double Area;   // of this cell
    double Height; // the part of each cell to the right
  };
  struct Row
  {
    std::int64_t First;
    std::int64_t Last;
    double Heights; // of all edges
  };

  // visit(cell, covered, rounding) of the cells that edges have come by.
  template <class Visit>
  void FinishRows(const Visit& visit)
  {
    constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    for (std::int64_t row = this->FirstRow; row <= this->LastRow; ++row)
    {
      Row& span = this->Rows[static_cast<std::size_t>(row - this->Slab.First)];
      Share* shares = this->Shares.data() + (row - this->Slab.First) * this->Slab.Size[0];
      // Cells outside must have nothing at all, else particles might be put there.
      const double tolerance = rounding * span.Heights;
      double height = 0.0;
      for (std::int64_t cell = span.First; cell <= span.Last; ++cell)
      {
        const double covered = height + shares[cell].Area;
        height += shares[cell].Height;
        shares[cell] = { 0.0, 0.0 };
        visit(row * this->Slab.Size[0] + cell, covered, tolerance);
      }
      span = { this->Slab.Size[0], -1, 0.0 };
    }
    this->FirstRow = this->Slab.Last;
    this->LastRow = this->Slab.First - 1;
  }
  void AddInRow(std::int64_t row, double from, double to, double height);

  const GridSlab<2> Slab;
  std::vector<Share> Shares;
  std::vector<Row> Rows;
  std::int64_t FirstRow;
  std::int64_t LastRow;
};

} // namespace RectifiedTransport

#endif

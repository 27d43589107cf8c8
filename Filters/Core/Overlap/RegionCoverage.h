// SPDX-License-Identifier: BSD-3-Clause
// What regions between straight edges cover of each cell of a plane grid, exact to rounding.
#ifndef RectifiedTransport_RegionCoverage_h
#define RectifiedTransport_RegionCoverage_h

#include "Core/Overlap/Overlap.h"

#include <cstdint>
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
  // The same where edges may run the other way round: there areas are negative, and they are
  // multiples where edges run around several times.
  void FinishSigned(double value);

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

  template <class PartOf>
  void FinishRows(const PartOf& partOf);
  void AddInRow(std::int64_t row, double from, double to, double height);

  const GridSlab<2> Slab;
  std::vector<Share> Shares;
  std::vector<Row> Rows;
  std::int64_t FirstRow;
  std::int64_t LastRow;
};

} // namespace RectifiedTransport

#endif

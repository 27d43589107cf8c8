// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/GridSlabs.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

// The range of slabs that each cell reaches along the last axis, found in parallel, then sorted by
// slabs.
template <int D>
Bins<std::int64_t> cellsOfSlabs(const CellValues& values, const ImageGrid& grid,
  const GridSlabs<D>& slabs, double margin, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  // Slabs [First, Last] of a cell.
  struct Reach
  {
    std::int32_t First;
    std::int32_t Last;
  };
  const CellSet& cells = values.Cells();
  // An empty range for cells that are not divided.
  std::vector<Reach> reaches(static_cast<std::size_t>(cells.NumberOfCells), Reach{ 0, -1 });
  progress.For(cells.NumberOfCells, grain, [&](std::int64_t first, std::int64_t last) {
    const auto reader = cells.Read();
    for (std::int64_t cell = first; cell < last; ++cell)
    {
      if (!values.IsDivided(cell))
      {
        continue;
      }
      // Convex cells are within the bounds of their points.
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (const std::int64_t point : reader->PointsOf(cell))
      {
        double x[3];
        reader->GetPosition(point, x);
        double index[D];
        grid.ToIndex<D>(x, index);
        low = std::min(low, index[D - 1]);
        high = std::max(high, index[D - 1]);
      }
      // False for cells without points, and for points that are not numbers.
      if (low <= high)
      {
        reaches[static_cast<std::size_t>(cell)] = { static_cast<std::int32_t>(
                                                      slabs.At(low - margin)),
          static_cast<std::int32_t>(slabs.At(high + margin)) };
      }
    }
  });
  // Cells in their order in each slab, whatever thread found them.
  Bins<std::int64_t> found;
  found.Fill(static_cast<std::size_t>(slabs.Count), [&](const auto& add) {
    for (std::size_t cell = 0; cell < reaches.size(); ++cell)
    {
      for (std::int32_t s = reaches[cell].First; s <= reaches[cell].Last; ++s)
      {
        add(static_cast<std::size_t>(s), static_cast<std::int64_t>(cell));
      }
    }
  });
  return found;
}

} // namespace

template <int D>
std::vector<Bins<std::int64_t>> GridSlabs<D>::CellsOf(const std::vector<CellValues>& sets,
  const ImageGrid& grid, double margin, Progress& progress) const
{
  std::vector<Bins<std::int64_t>> cells;
  cells.reserve(sets.size());
  for (const CellValues& values : sets)
  {
    cells.push_back(cellsOfSlabs<D>(values, grid, *this, margin, progress));
  }
  return cells;
}

template struct GridSlabs<1>;
template struct GridSlabs<2>;
template struct GridSlabs<3>;

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellSums.h"

#include "Core/Geometry/Dispatch.h"
#include "Core/Overlap/RegionCoverage.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Resampling/GridSlabs.h"
#include "Core/Resampling/RegionShapes.h"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

namespace
{

// Adds the areas of regions, and these times their values.
void addSizes(const RegionBatch& batch, CellSize& all)
{
  for (const RegionShape& shape : batch.Shapes)
  {
    CellSize size;
    shape.VisitRegions([&](std::int32_t ring, const OutlineEdge* first, const OutlineEdge* last) {
      // In cells of the grid.
      const double area = sizeOfRegion(first, last).Area;
      size.Measure += area;
      // A region has one value.
      size.Integral += area * shape.Values[static_cast<std::size_t>(ring)];
    });
    all = all + size;
  }
}

// What the cells that are divided contain. Chunks of a fixed size make the sum the same for any
// number of threads.
template <int D>
CellSize sizeOf(const std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
  CellSize size;
  for (std::size_t s = 0; s < sets.size(); ++s)
  {
    const CellValues& values = sets[s];
    CellSize ofSet = reduceChunks(
      progress, values.Cells().NumberOfCells, grain, CellSize(),
      [&](std::int64_t first, std::int64_t last) {
        CellPieces<D> pieces(values, grid);
        CellSize part;
        for (std::int64_t cell = first; cell < last; ++cell)
        {
          part = values.IsDivided(cell) ? part + pieces.SizeOf(cell) : part;
        }
        return part;
      },
      std::plus<>());
    ofSet.Set = s;
    size = size + ofSet;
  }
  return size;
}

// Adds what the regions of a batch cover of a slab: the edges of one region follow each other, and
// its value is added when the last one has come.
void addEdges(const std::vector<CellValues>& sets, const RegionBatch& batch, std::int64_t number,
  const GridSlab<2>& slab)
{
  const auto edges = batch.Slabs[static_cast<std::size_t>(number)];
  if (edges.Size() == 0)
  {
    return;
  }
  // One for all regions of the slab: Finish clears only what was touched.
  RegionCoverage coverage(slab);
  for (const RegionBatch::Edge* edge = edges.First; edge != edges.Last; ++edge)
  {
    const OutlineEdge& piece = batch.At(*edge);
    coverage.Add(piece.From, piece.To);
    if (edge + 1 == edges.Last || !batch.IsSame(*edge, *(edge + 1)))
    {
      const RegionShape& shape = batch.ShapeOf(*edge);
      coverage.Finish(sets[static_cast<std::size_t>(shape.Set)].OfRegion(
        shape.Values[static_cast<std::size_t>(piece.Ring)]));
    }
  }
}

// Adds the cells that are divided. Slabs have disjoint parts of the grid, so that threads do not
// share a sum, and each slab adds its cells in their order.
template <int D>
void addCells(const std::vector<CellValues>& sets, const ImageGrid& grid, const GridSlabs<D>& slabs,
  Progress& progress, double* sums)
{
  constexpr std::int64_t cellsBetweenPolls = 256;
  const auto cells = slabs.CellsOf(sets, grid, 0.0, progress);
  slabs.ForEach(progress, [&](std::int64_t slab) {
    for (std::size_t s = 0; s < sets.size(); ++s)
    {
      CellPieces<D> pieces(sets[s], grid);
      std::int64_t added = 0;
      for (const std::int64_t cell : cells[s][static_cast<std::size_t>(slab)])
      {
        // Cells may be large: a poll every 256 of them.
        if (added++ % cellsBetweenPolls == 0 && progress.ShouldStop())
        {
          return;
        }
        pieces.AddTo(slabs.Slab(slab, sums), cell);
      }
    }
  });
}

// Sums of integrals over grid cells are the means, as a grid cell has the measure 1.
template <int D>
CellSize resample(
  const std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress, double* sums)
{
  // First what all cells contain, then the means of grid cells.
  const GridSlabs<D> slabs(grid.Size<D>());
  CellSize size = sizeOf<D>(sets, grid, progress);
  std::fill_n(sums, grid.NumberOfCells(), 0.0);
  addCells<D>(sets, grid, slabs, progress, sums);
  if constexpr (D == 2)
  {
    // Regions of one batch are added before the next one is read.
    visitRegions(sets, grid, slabs, 0.0, progress, [&](const RegionBatch& batch) {
      addSizes(batch, size);
      slabs.ForEach(
        progress, [&](std::int64_t slab) { addEdges(sets, batch, slab, slabs.Slab(slab, sums)); });
    });
  }
  return size;
}

template <int D>
double integrate(const std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress)
{
  CellSize size = sizeOf<D>(sets, grid, progress);
  if constexpr (D == 2)
  {
    visitRegions(sets, grid, GridSlabs<2>(grid.Size<2>()), 0.0, progress,
      [&](const RegionBatch& batch) { addSizes(batch, size); });
  }
  return size.Integral;
}

} // namespace

// The density of each grid cell is the mean over it, axis 0 fastest; parts outside all cells count
// as 0.
CellSize resampleCells(
  const std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress, double* density)
{
  return dispatchDimension(grid.Dimension(), resample<1>, resample<2>, resample<3>)(
    sets, grid, progress, density);
}

// The mass alone needs no sums over grid cells: the sizes of cells and regions have it.
double integralOf(const std::vector<CellValues>& sets, const ImageGrid& grid, Progress& progress)
{
  return dispatchDimension(grid.Dimension(), integrate<1>, integrate<2>, integrate<3>)(
    sets, grid, progress);
}

} // namespace RectifiedTransport

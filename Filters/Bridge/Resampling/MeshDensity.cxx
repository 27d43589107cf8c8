// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/MeshDensity.h"

#include "Bridge/Meshes/CellPieces.h"
#include "Bridge/Meshes/MeshSlabs.h"
#include "Bridge/Meshes/RegionShapes.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Overlap/Overlap.h"
#include "Core/Overlap/RegionCoverage.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

template <int D>
CellSize sizeOf(const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress)
{
  CellSize size;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const BlockValues& block = blocks[b];
    CellSize ofBlock = reduceChunks(
      progress, block.Data()->GetNumberOfCells(), grain, CellSize(),
      [&](std::int64_t first, std::int64_t last) {
        CellPieces<D> pieces(block, grid);
        CellSize part;
        for (std::int64_t cell = first; cell < last; ++cell)
        {
          part = block.IsDivided(cell) ? part + pieces.SizeOf(cell) : part;
        }
        return part;
      },
      std::plus<>());
    ofBlock.Block = b;
    size = size + ofBlock;
  }
  return size;
}

void addSizes(const RegionBatch& batch, CellSize& all)
{
  for (const RegionShape& shape : batch.Shapes)
  {
    CellSize size;
    shape.VisitRegions([&](std::int32_t ring, const OutlineEdge* first, const OutlineEdge* last) {
      const double area = sizeOfRegion(first, last).Area;
      size.Measure += area;
      size.Integral += area * shape.Values[static_cast<std::size_t>(ring)];
    });
    all = all + size;
  }
}

// Adds what the regions of a batch cover of a slab.
void addEdges(const std::vector<BlockValues>& blocks, const RegionBatch& batch, std::int64_t number,
  const GridSlab<2>& slab)
{
  const auto edges = batch.Slabs[static_cast<std::size_t>(number)];
  if (edges.Size() == 0)
  {
    return;
  }
  RegionCoverage coverage(slab);
  for (const RegionBatch::Edge* edge = edges.First; edge != edges.Last; ++edge)
  {
    const OutlineEdge& piece = batch.At(*edge);
    coverage.Add(piece.From, piece.To);
    if (edge + 1 == edges.Last || !batch.IsSame(*edge, *(edge + 1)))
    {
      const RegionShape& shape = batch.ShapeOf(*edge);
      coverage.Finish(blocks[static_cast<std::size_t>(shape.Block)].OfRegion(
        shape.Values[static_cast<std::size_t>(piece.Ring)]));
    }
  }
}

template <int D>
void addBlocks(const std::vector<BlockValues>& blocks, const std::vector<Bins<vtkIdType>>& cells,
  const MeshSlabs<D>& slabs, const ImageGrid& grid, Progress& progress, double* sums)
{
  std::fill_n(sums, grid.NumberOfCells(), 0.0);
  constexpr std::int64_t cellsBetweenPolls = 256;
  progress.For(
    slabs.Count, 1,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t s = first; s < last; ++s)
      {
        const GridSlab<D> slab = slabs.Slab(s, sums);
        for (std::size_t b = 0; b < blocks.size(); ++b)
        {
          CellPieces<D> pieces(blocks[b], grid);
          std::int64_t added = 0;
          for (const vtkIdType cell : cells[b][static_cast<std::size_t>(s)])
          {
            if (added++ % cellsBetweenPolls == 0 && progress.ShouldStop())
            {
              return;
            }
            pieces.AddTo(slab, cell);
          }
        }
      }
    },
    1);
}

// Adds what regions cover, and their sizes.
void addRegions(const std::vector<BlockValues>& blocks, const MeshSlabs<2>& slabs,
  const ImageGrid& grid, Progress& progress, double* sums, CellSize& all)
{
  visitRegions(blocks, grid, slabs, 0.0, progress, [&](const RegionBatch& batch) {
    addSizes(batch, all);
    progress.For(
      slabs.Count, 1,
      [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t s = first; s < last && !progress.ShouldStop(); ++s)
        {
          addEdges(blocks, batch, s, slabs.Slab(s, sums));
        }
      },
      1);
  });
}

std::string percent(double part, double whole)
{
  std::ostringstream text;
  text.precision(2);
  text << (whole > 0.0 ? 100.0 * part / whole : 0.0) << " %";
  return text.str();
}

template <int D>
double integrate(const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress)
{
  CellSize size = sizeOf<D>(blocks, grid, progress);
  if constexpr (D == 2)
  {
    visitRegions(blocks, grid, MeshSlabs<2>(grid.Size<2>()), 0.0, progress,
      [&](const RegionBatch& batch) { addSizes(batch, size); });
  }
  return size.Integral;
}

// "(the first is cell 3)", or "cell 3 of block 1 of the input".
std::string firstText(const std::vector<BlockValues>& blocks, std::size_t block, vtkIdType cell)
{
  return " (the first is cell " + std::to_string(cell) +
    (blocks.size() > 1 ? " of " + blocks[block].BlockName() : "") + ")";
}

template <int D>
std::vector<std::string> warningsOf(const CellSize& size, const std::vector<BlockValues>& blocks)
{
  std::vector<std::string> warnings;
  if (size.LeftOut > 0)
  {
    warnings.push_back(std::to_string(size.LeftOut) + (size.LeftOut == 1 ? " cell" : " cells") +
      " of the input" + firstText(blocks, size.Block, size.FirstLeftOut) +
      " could not be divided into simplices and carry no mass: at most " +
      percent(size.LeftOutIntegral, size.LeftOutIntegral + size.Integral) + " of the mass, and " +
      percent(size.LeftOutMeasure, size.LeftOutMeasure + size.Measure) + " of the " +
      (D == 3      ? "volume"
          : D == 2 ? "area"
                   : "length") +
      ", are in the boxes around them");
  }
  vtkIdType open = 0;
  std::string first;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    first = open == 0 ? firstText(blocks, b, blocks[b].FirstOpenLine()) : first;
    open += blocks[b].OpenLines();
  }
  if (open > 0)
  {
    warnings.push_back(std::to_string(open) +
      (open == 1 ? " line of the input is not closed" + first + " and carries no mass"
                 : " lines of the input are not closed" + first + " and carry no mass") +
      "; lines around regions must end where they begin");
  }
  return warnings;
}

template <int D>
std::vector<std::string> resample(
  const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress, double* sums)
{
  const MeshSlabs<D> slabs(grid.Size<D>());
  const std::vector<Bins<vtkIdType>> cells = cellsOfSlabs<D>(blocks, grid, slabs, 0.0, progress);
  CellSize size = sizeOf<D>(blocks, grid, progress);
  addBlocks<D>(blocks, cells, slabs, grid, progress, sums);
  if constexpr (D == 2)
  {
    addRegions(blocks, slabs, grid, progress, sums, size);
  }
  return warningsOf<D>(size, blocks);
}

} // namespace

std::vector<std::string> resampleCells(const std::vector<BlockValues>& blocks,
  const ImageGrid& grid, Progress& progress, double* density)
{
  return withMemory("the order of the input's cells", 0.0, [&]() {
    return dispatchDimension(grid.Dimension(), resample<1>, resample<2>, resample<3>)(
      blocks, grid, progress, density);
  });
}

double integralOf(const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress)
{
  return dispatchDimension(grid.Dimension(), integrate<1>, integrate<2>, integrate<3>)(
    blocks, grid, progress);
}

} // namespace RectifiedTransport::Bridge

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Resampling/MeshDensity.h"

#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Resampling/BlockValues.h"
#include "Bridge/Resampling/CellPieces.h"
#include "Bridge/Resampling/MeshSlabs.h"
#include "Bridge/Run/Memory.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Overlap/Overlap.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

template <int D>
vtkIdType addBlocks(
  const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress, double* sums)
{
  const GridSize<D> size = grid.Size<D>();
  const MeshSlabs<D> slabs(size);
  std::vector<CellsOfSlabs> cells;
  cells.reserve(blocks.size());
  for (const BlockValues& block : blocks)
  {
    cells.push_back(cellsOfSlabs<D>(block, grid, slabs, 0.0, progress));
  }
  std::atomic<vtkIdType> leftOut{ 0 };
  constexpr std::int64_t cellsBetweenPolls = 256;
  progress.For(
    slabs.Count, 1,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t s = first; s < last; ++s)
      {
        const GridSlab<D> slab{ size, s * slabs.Planes,
          std::min((s + 1) * slabs.Planes, size[D - 1]), sums };
        for (std::size_t b = 0; b < blocks.size(); ++b)
        {
          CellPieces<D> pieces(blocks[b], grid);
          const std::int64_t begin = cells[b].Begin[static_cast<std::size_t>(s)];
          const std::int64_t end = cells[b].Begin[static_cast<std::size_t>(s) + 1];
          for (std::int64_t i = begin; i < end; ++i)
          {
            if ((i - begin) % cellsBetweenPolls == 0 && progress.ShouldStop())
            {
              return;
            }
            if (!pieces.AddTo(slab, cells[b].Cells[static_cast<std::size_t>(i)]))
            {
              ++leftOut;
            }
          }
        }
      }
    },
    1);
  return leftOut;
}

} // namespace

MeshDensity MeshDensity::Make(const std::vector<BlockValues>& blocks, const ImageGrid& grid,
  const char* name, Progress& progress)
{
  requireMemory("an image of " + describeValues(grid) + " cells (see DensityResolution)",
    numberOfValues(grid) * sizeof(double));
  MeshDensity made;
  made.Image = vtkSmartPointer<vtkImageData>::New();
  applyGrid(grid, made.Image);
  auto density = newArray<vtkDoubleArray>(name, 1, static_cast<vtkIdType>(grid.NumberOfCells()));
  double* sums = density->GetPointer(0);
  progress.For(grid.NumberOfCells(), grain,
    [=](std::int64_t first, std::int64_t last) { std::fill(sums + first, sums + last, 0.0); });
  made.CellsLeftOut = withMemory("the order of the input's cells", 0.0, [&]() {
    return dispatchDimension(grid.Dimension(), addBlocks<1>, addBlocks<2>, addBlocks<3>)(
      blocks, grid, progress, sums);
  });
  made.Image->GetCellData()->SetScalars(density);
  return made;
}

} // namespace RectifiedTransport

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
#include "Core/Parallel/Reduction.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

template <int D>
using Size = typename CellPieces<D>::Size;

template <int D>
Size<D> sumOf(const Size<D>& a, const Size<D>& b)
{
  return { a.Integral + b.Integral, a.Measure + b.Measure, a.Wide + b.Wide, a.LeftOut + b.LeftOut };
}

template <int D>
Size<D> sizeOf(const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress)
{
  Size<D> size;
  for (const BlockValues& block : blocks)
  {
    size = sumOf<D>(size,
      reduceChunks(
        progress, block.Data()->GetNumberOfCells(), grain, Size<D>(),
        [&](std::int64_t first, std::int64_t last) {
          CellPieces<D> pieces(block, grid);
          Size<D> part;
          for (std::int64_t cell = first; cell < last; ++cell)
          {
            part = block.IsCounted(cell) ? sumOf<D>(part, pieces.SizeOf(cell)) : part;
          }
          return part;
        },
        sumOf<D>));
  }
  return size;
}

template <int D>
void addBlocks(const std::vector<BlockValues>& blocks, const std::vector<CellsOfSlabs>& cells,
  const MeshSlabs<D>& slabs, const ImageGrid& grid, bool alongLines, Progress& progress,
  double* sums)
{
  const GridSize<D> size = grid.Size<D>();
  std::fill_n(sums, grid.NumberOfCells(), 0.0);
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
            pieces.AddTo(slab, cells[b].Cells[static_cast<std::size_t>(i)], alongLines);
          }
        }
      }
    },
    1);
}

template <int D>
double integralOf(const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress)
{
  return sizeOf<D>(blocks, grid, progress).Integral;
}

template <int D>
vtkIdType integrate(
  const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress, double* sums)
{
  const MeshSlabs<D> slabs(grid.Size<D>());
  std::vector<CellsOfSlabs> cells;
  cells.reserve(blocks.size());
  for (const BlockValues& block : blocks)
  {
    cells.push_back(cellsOfSlabs<D>(block, grid, slabs, 0.0, progress));
  }
  const Size<D> size = sizeOf<D>(blocks, grid, progress);
  constexpr double mostlyWide = 0.9;
  constexpr double tolerance = 1e-3; // of the mass, for lines
  bool alongLines = D == 3 && size.Wide >= mostlyWide * size.Measure;
  addBlocks<D>(blocks, cells, slabs, grid, alongLines, progress, sums);
  if (alongLines)
  {
    // Much of the mass may be in simplices that lines miss.
    const double found = reduceChunks(
      progress, grid.NumberOfCells(), grain, 0.0,
      [sums](std::int64_t first, std::int64_t last) {
        return std::accumulate(sums + first, sums + last, 0.0);
      },
      [](double a, double b) { return a + b; });
    alongLines = std::abs(found - size.Integral) <= tolerance * size.Integral;
    if (!alongLines)
    {
      addBlocks<D>(blocks, cells, slabs, grid, false, progress, sums);
    }
  }
  return static_cast<vtkIdType>(size.LeftOut);
}

} // namespace

double MeshDensity::IntegralOf(
  const std::vector<BlockValues>& blocks, const ImageGrid& grid, Progress& progress)
{
  return dispatchDimension(grid.Dimension(), integralOf<1>, integralOf<2>, integralOf<3>)(
    blocks, grid, progress);
}

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
  made.CellsLeftOut = withMemory("the order of the input's cells", 0.0, [&]() {
    return dispatchDimension(grid.Dimension(), integrate<1>, integrate<2>, integrate<3>)(
      blocks, grid, progress, sums);
  });
  made.Image->GetCellData()->SetScalars(density);
  return made;
}

} // namespace RectifiedTransport

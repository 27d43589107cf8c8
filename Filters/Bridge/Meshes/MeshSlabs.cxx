// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Meshes/MeshSlabs.h"

#include "Core/Parallel/Progress.h"

#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <limits>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

template <int D>
Bins<vtkIdType> cellsOfSlabs(const BlockValues& values, const ImageGrid& grid,
  const MeshSlabs<D>& slabs, double margin, Progress& progress)
{
  struct Reach
  {
    std::int32_t First;
    std::int32_t Last;
  };
  vtkDataSet* data = values.Data();
  const vtkIdType count = data->GetNumberOfCells();
  std::vector<Reach> reaches(static_cast<std::size_t>(count), Reach{ 0, -1 });
  progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
    vtkNew<vtkIdList> points;
    for (std::int64_t cell = first; cell < last; ++cell)
    {
      if (!values.IsDivided(cell))
      {
        continue;
      }
      // vtkDataSet::GetCellBounds starts threads for every cell.
      data->GetCellPoints(cell, points);
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
      {
        double x[3];
        data->GetPoint(points->GetId(i), x);
        double index[D];
        grid.ToIndex<D>(x, index);
        low = std::min(low, index[D - 1]);
        high = std::max(high, index[D - 1]);
      }
      if (low <= high)
      {
        reaches[static_cast<std::size_t>(cell)] = { static_cast<std::int32_t>(
                                                      slabs.At(low - margin)),
          static_cast<std::int32_t>(slabs.At(high + margin)) };
      }
    }
  });
  Bins<vtkIdType> found;
  found.Fill(static_cast<std::size_t>(slabs.Count), [&](const auto& add) {
    for (std::size_t cell = 0; cell < reaches.size(); ++cell)
    {
      for (std::int32_t s = reaches[cell].First; s <= reaches[cell].Last; ++s)
      {
        add(static_cast<std::size_t>(s), static_cast<vtkIdType>(cell));
      }
    }
  });
  return found;
}

} // namespace

template <int D>
std::vector<Bins<vtkIdType>> cellsOfSlabs(const std::vector<BlockValues>& blocks,
  const ImageGrid& grid, const MeshSlabs<D>& slabs, double margin, Progress& progress)
{
  std::vector<Bins<vtkIdType>> cells;
  cells.reserve(blocks.size());
  for (const BlockValues& block : blocks)
  {
    cells.push_back(cellsOfSlabs<D>(block, grid, slabs, margin, progress));
  }
  return cells;
}

template std::vector<Bins<vtkIdType>> cellsOfSlabs<1>(
  const std::vector<BlockValues>&, const ImageGrid&, const MeshSlabs<1>&, double, Progress&);
template std::vector<Bins<vtkIdType>> cellsOfSlabs<2>(
  const std::vector<BlockValues>&, const ImageGrid&, const MeshSlabs<2>&, double, Progress&);
template std::vector<Bins<vtkIdType>> cellsOfSlabs<3>(
  const std::vector<BlockValues>&, const ImageGrid&, const MeshSlabs<3>&, double, Progress&);

} // namespace RectifiedTransport::Bridge

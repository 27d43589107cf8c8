// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Meshes/MeshSlabs.h"

#include "Core/Parallel/Progress.h"

#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

} // namespace

template <int D>
CellsOfSlabs cellsOfSlabs(const BlockValues& values, const ImageGrid& grid,
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
  CellsOfSlabs found;
  found.Begin.assign(static_cast<std::size_t>(slabs.Count) + 2, 0);
  for (const Reach& reach : reaches)
  {
    for (std::int32_t s = reach.First; s <= reach.Last; ++s)
    {
      ++found.Begin[static_cast<std::size_t>(s) + 2];
    }
  }
  for (std::size_t s = 2; s < found.Begin.size(); ++s)
  {
    found.Begin[s] += found.Begin[s - 1];
  }
  found.Cells.resize(static_cast<std::size_t>(found.Begin.back()));
  for (std::size_t cell = 0; cell < reaches.size(); ++cell)
  {
    for (std::int32_t s = reaches[cell].First; s <= reaches[cell].Last; ++s)
    {
      std::int64_t& next = found.Begin[static_cast<std::size_t>(s) + 1];
      found.Cells[static_cast<std::size_t>(next++)] = static_cast<vtkIdType>(cell);
    }
  }
  found.Begin.pop_back();
  return found;
}

template CellsOfSlabs cellsOfSlabs<1>(
  const BlockValues&, const ImageGrid&, const MeshSlabs<1>&, double, Progress&);
template CellsOfSlabs cellsOfSlabs<2>(
  const BlockValues&, const ImageGrid&, const MeshSlabs<2>&, double, Progress&);
template CellsOfSlabs cellsOfSlabs<3>(
  const BlockValues&, const ImageGrid&, const MeshSlabs<3>&, double, Progress&);

} // namespace RectifiedTransport

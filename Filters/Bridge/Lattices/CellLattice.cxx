// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Lattices/CellLattice.h"

#include "Bridge/Lattices/LatticeFrame.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// The numbers of cells that a lattice may have: as many as an image of the default resolution, or
// more of few that are there.
bool isDense(double latticeCells, double cells)
{
  constexpr double always = 16777216.0; // 256 cubed
  constexpr double mostEmpty = 64.0;
  return latticeCells <= std::max(always, mostEmpty * cells);
}

// With `cells` cells along the frame's axes.
ImageGrid gridOfFrame(const LatticeFrame& frame, const std::array<std::int64_t, 3>& cells)
{
  std::array<int, 6> extent{ 0, 0, 0, 0, 0, 0 };
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  for (std::size_t a = 0; a < 3; ++a)
  {
    extent[2 * a + 1] = static_cast<int>(cells[a]);
    spacing[static_cast<Eigen::Index>(a)] =
      frame.IsAxis[a] ? frame.Spacing[static_cast<Eigen::Index>(a)] : 1.0;
  }
  return { extent, frame.Axes * frame.Low, spacing, frame.Axes, false };
}

} // namespace

std::optional<CellLattice> CellLattice::Find(
  const std::vector<DensityBlock>& blocks, int dimension, Progress& progress)
{
  const std::optional<LatticeFrame> frame = LatticeFrame::Of(blocks, dimension, progress);
  if (!frame)
  {
    return std::nullopt;
  }
  double latticeCells = 1.0;
  std::array<std::int64_t, 3> cells{ 0, 0, 0 };
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double along = frame->IsAxis[a] ? frame->CellsAlong[a] : 0.0;
    constexpr double largest = 1 << 30;
    if (!(along <= largest))
    {
      return std::nullopt;
    }
    cells[a] = static_cast<std::int64_t>(along);
    latticeCells *= frame->IsAxis[a] ? along : 1.0;
  }
  if (!isDense(latticeCells, frame->Cells))
  {
    return std::nullopt;
  }
  CellLattice lattice;
  lattice.Axes = *frame;
  lattice.Box = gridOfFrame(*frame, cells);
  for (const DensityBlock& block : blocks)
  {
    const vtkIdType count = block.Data->GetNumberOfCells();
    std::vector<std::int64_t> places;
    withMemory("the places of cells in their lattice",
      static_cast<double>(count) * sizeof(std::int64_t),
      [&]() { places.assign(static_cast<std::size_t>(count), -1); });
    const std::array<std::int64_t, 2> rows{ std::max<std::int64_t>(cells[0], 1),
      std::max<std::int64_t>(cells[1], 1) };
    const auto misfits = reduceChunks(
      progress, count, grain, std::int64_t{ 0 },
      [&](std::int64_t first, std::int64_t last) {
        BoxCorners corners(block.Data, dimension);
        std::int64_t others = 0;
        for (std::int64_t cell = first; cell < last && others == 0; ++cell)
        {
          if (corners.IsOfDimension(cell))
          {
            std::array<std::int64_t, 3> at{};
            std::array<unsigned, 8> sides{};
            others += corners.Read(cell) && corners.FindPlace(*frame, at, sides) ? 0 : 1;
            places[static_cast<std::size_t>(cell)] = at[0] + rows[0] * (at[1] + rows[1] * at[2]);
          }
        }
        return others;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
    if (misfits > 0)
    {
      return std::nullopt;
    }
    if (block.Array)
    {
      lattice.Places.push_back(std::move(places));
    }
  }
  return lattice;
}

ImageGrid CellLattice::DividedGrid(int resolution) const
{
  std::array<int, 3> values = this->Box.NumberOfValues();
  const int longest = *std::max_element(values.begin(), values.end());
  const int parts = std::max(1, static_cast<int>(std::lround(double(resolution) / longest)));
  for (std::size_t a = 0; a < 3; ++a)
  {
    values[a] *= this->Box.IsAxis(a) ? parts : 1;
  }
  return this->Box.WithValues(values);
}

bool CellLattice::FindTaken(
  const std::vector<BlockValues>& values, Progress& progress, std::vector<bool>& taken) const
{
  taken.assign(static_cast<std::size_t>(this->Box.NumberOfCells()), false);
  bool once = true;
  this->VisitCounted(values, progress, [&](std::int64_t place, std::size_t, std::size_t) {
    once = once && !taken[static_cast<std::size_t>(place)];
    taken[static_cast<std::size_t>(place)] = true;
  });
  return once;
}

bool CellLattice::HasEachOnce(const std::vector<BlockValues>& values, Progress& progress) const
{
  std::vector<bool> taken;
  return this->FindTaken(values, progress, taken);
}

void CellLattice::CopyValues(
  const std::vector<BlockValues>& values, double* cells, Progress& progress) const
{
  std::fill_n(cells, this->Box.NumberOfCells(), 0.0);
  this->VisitCounted(
    values, progress, [&](std::int64_t place, std::size_t block, std::size_t cell) {
      cells[place] = values[block].Values()[cell];
    });
}

void CellLattice::ClearAround(const std::vector<BlockValues>& values, const ImageGrid& divided,
  double* cells, Progress& progress) const
{
  std::vector<bool> taken;
  this->FindTaken(values, progress, taken);
  const std::array<int, 3> whole = this->Box.NumberOfValues();
  const std::array<int, 3> fine = divided.NumberOfValues();
  const int parts = std::max({ fine[0] / whole[0], fine[1] / whole[1], fine[2] / whole[2] });
  const std::array<int, 3> part{ this->Box.IsAxis(0) ? parts : 1, this->Box.IsAxis(1) ? parts : 1,
    this->Box.IsAxis(2) ? parts : 1 };
  std::int64_t at = 0;
  for (std::int64_t k = 0; k < fine[2]; ++k)
  {
    progress.Check();
    for (std::int64_t j = 0; j < fine[1]; ++j)
    {
      const std::int64_t row = whole[0] * (j / part[1] + whole[1] * (k / part[2]));
      for (std::int64_t i = 0; i < fine[0]; ++i, ++at)
      {
        cells[at] = taken[static_cast<std::size_t>(row + i / part[0])] ? cells[at] : 0.0;
      }
    }
  }
}

} // namespace RectifiedTransport::Bridge

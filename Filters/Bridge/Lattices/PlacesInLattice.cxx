// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Lattices/PlacesInLattice.h"

#include "Bridge/Lattices/LatticeFrame.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace RectifiedTransport::Bridge
{

PlacesInLattice::PlacesInLattice(const CellLattice& lattice, const std::vector<BlockValues>& blocks,
  ConstPointSpan<3> places, Progress& progress)
  : Lattice(lattice)
  , Blocks(blocks)
  , Places(places)
  , First{ 0 }
{
  for (const BlockValues& block : blocks)
  {
    this->First.push_back(this->First.back() + block.Data()->GetNumberOfCells());
  }
  const std::int64_t count = lattice.Grid().NumberOfCells();
  withMemory("the cells in a lattice", static_cast<double>(count) * sizeof(std::int64_t),
    [&]() { this->CellAt.assign(static_cast<std::size_t>(count), -1); });
  lattice.VisitCounted(blocks, progress, [&](std::int64_t at, std::size_t block, std::size_t cell) {
    this->CellAt[static_cast<std::size_t>(at)] =
      this->First[block] + static_cast<std::int64_t>(cell);
  });
}

// `along` is in spacings. A place at a face may be that of either cell.
std::int64_t PlacesInLattice::CellNear(const std::array<double, 3>& along) const
{
  constexpr double rounding = 1e-6;
  const std::array<int, 3> cells = this->Lattice.Grid().NumberOfValues();
  std::array<std::array<std::int64_t, 2>, 3> sides{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double last = cells[a] - 1.0;
    const auto at = [&](double x) {
      return static_cast<std::int64_t>(std::clamp(std::floor(x), 0.0, last));
    };
    const std::int64_t here = at(along[a]);
    const std::int64_t below = at(along[a] - rounding);
    sides[a] = { here, below != here ? below : at(along[a] + rounding) };
  }
  for (int choice = 0; choice < 8; ++choice)
  {
    const auto side = [&](std::size_t a) { return sides[a][choice >> a & 1]; };
    const std::int64_t cell =
      this->CellAt[static_cast<std::size_t>(side(0) + cells[0] * (side(1) + cells[1] * side(2)))];
    if (cell >= 0)
    {
      return cell;
    }
  }
  return -1;
}

SampledPlace PlacesInLattice::Find(std::int64_t place) const
{
  const LatticeFrame& frame = this->Lattice.Frame();
  const double* given = this->Places[place];
  const Eigen::Vector3d x(given[0], given[1], given[2]);
  std::array<double, 3> along{ 0.0, 0.0, 0.0 };
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    along[a] =
      frame.IsAxis[a] ? (frame.Axes.col(axis).dot(x) - frame.Low[axis]) / frame.Spacing[axis] : 0.0;
  }
  SampledPlace found{ {}, {}, 0, -1 };
  const std::int64_t number = this->CellNear(along);
  if (number < 0)
  {
    return found;
  }
  const auto next = std::upper_bound(this->First.begin(), this->First.end(), number);
  found.Set = static_cast<int>(next - this->First.begin()) - 1;
  found.Cell = static_cast<vtkIdType>(number - this->First[static_cast<std::size_t>(found.Set)]);

  BoxCorners corners(
    this->Blocks[static_cast<std::size_t>(found.Set)].Data(), this->Lattice.Grid().Dimension());
  std::array<std::int64_t, 3> at{};
  std::array<unsigned, 8> sides{};
  corners.Read(found.Cell);
  corners.FindPlace(frame, at, sides);
  for (int i = 0; i < corners.Count(); ++i)
  {
    double weight = 1.0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double part = std::clamp(along[a] - static_cast<double>(at[a]), 0.0, 1.0);
      const bool isHigh = (sides[static_cast<std::size_t>(i)] >> a & 1U) != 0;
      weight *= !frame.IsAxis[a] ? 1.0 : isHigh ? part : 1.0 - part;
    }
    // A weight of 0 would not keep out values that are not finite.
    if (weight > 0.0)
    {
      found.Points[found.Count] = corners.PointOf(i);
      found.Weights[found.Count++] = weight;
    }
  }
  return found;
}

} // namespace RectifiedTransport::Bridge

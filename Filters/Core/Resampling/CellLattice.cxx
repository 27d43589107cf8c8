// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/CellLattice.h"

#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t latticeGrain = std::int64_t{ 1 } << 12;

// The numbers of cells that a lattice's box may have: as many as an image of the default
// resolution, or up to 64 for each cell that is there. A larger box is mostly empty, and its grid
// would cost more than it gains.
bool isDense(double latticeCells, double cells)
{
  constexpr double always = 16777216.0; // 256 cubed
  constexpr double mostEmpty = 64.0;
  return latticeCells <= std::max(always, mostEmpty * cells);
}

// An image with values on cells, `cells` of them along the frame's axes.
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

// The frame says whether the cells' edges fit. Numbers of cells beyond 2^30 have no image.
std::optional<CellLattice> CellLattice::Find(
  const CellSets& sets, int dimension, Progress& progress)
{
  const std::optional<LatticeFrame> frame = LatticeFrame::Of(sets, dimension, progress);
  if (!frame)
  {
    return std::nullopt;
  }
  double latticeCells = 1.0;
  std::array<std::int64_t, 3> cells{ 0, 0, 0 };
  for (std::size_t a = 0; a < 3; ++a)
  {
    // 0 cells where there is no axis: one point.
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
  lattice.Dimension = dimension;
  return lattice;
}

// Cells of another dimension have the place -1; they are no misfits.
bool CellLattice::Place(const CellSet& cells, bool hasMass, Progress& progress)
{
  std::vector<std::int64_t> places(static_cast<std::size_t>(cells.NumberOfCells), -1);
  // place = at_0 + rows_0 (at_1 + rows_1 at_2)
  const std::array<int, 3> rows = this->Box.NumberOfValues();
  const auto misfits = reduceChunks(
    progress, cells.NumberOfCells, latticeGrain, std::int64_t{ 0 },
    [&](std::int64_t first, std::int64_t last) {
      BoxCorners corners(cells, this->Dimension);
      std::int64_t others = 0;
      for (std::int64_t cell = first; cell < last && others == 0; ++cell)
      {
        // A chunk ends at its first misfit, as one suffices.
        if (corners.IsOfDimension(cell))
        {
          std::array<std::int64_t, 3> at{};
          std::array<unsigned, 8> sides{};
          // A cell fits if its corners are those of a box of the lattice.
          others += corners.Read(cell) && corners.FindPlace(this->Axes, at, sides) ? 0 : 1;
          places[static_cast<std::size_t>(cell)] = at[0] + rows[0] * (at[1] + rows[1] * at[2]);
        }
      }
      return others;
    },
    std::plus<>());
  if (hasMass)
  {
    this->Places.push_back(std::move(places));
  }
  return misfits == 0;
}

ImageGrid CellLattice::DividedGrid(int resolution) const
{
  std::array<int, 3> values = this->Box.NumberOfValues();
  const int longest = *std::max_element(values.begin(), values.end());
  // As many parts a cell as bring the longest axis nearest to the resolution.
  const int parts = std::max(1, static_cast<int>(std::lround(double(resolution) / longest)));
  for (std::size_t a = 0; a < 3; ++a)
  {
    values[a] *= this->Box.IsAxis(a) ? parts : 1;
  }
  return this->Box.WithValues(values);
}

bool CellLattice::FindTaken(
  const std::vector<CellValues>& sets, Progress& progress, std::vector<bool>& taken) const
{
  taken.assign(static_cast<std::size_t>(this->Box.NumberOfCells()), false);
  bool once = true;
  // Twice at one place: the cells overlap, and copying would lose one.
  this->VisitCounted(sets, progress, [&](std::int64_t place, std::size_t, std::size_t) {
    // False as soon as a place is taken twice.
    once = once && !taken[static_cast<std::size_t>(place)];
    taken[static_cast<std::size_t>(place)] = true;
  });
  return once;
}

// Whether no two cells share a place; FindTaken also says which places are taken.
bool CellLattice::HasEachOnce(const std::vector<CellValues>& sets, Progress& progress) const
{
  std::vector<bool> taken;
  return this->FindTaken(sets, progress, taken);
}

// Places without a cell carry no mass.
void CellLattice::CopyValues(
  const std::vector<CellValues>& sets, double* cells, Progress& progress) const
{
  std::fill_n(cells, this->Box.NumberOfCells(), 0.0);
  this->VisitCounted(sets, progress, [&](std::int64_t place, std::size_t set, std::size_t cell) {
    cells[place] = sets[set].At(static_cast<std::int64_t>(cell));
  });
}

// Resampling may put the mass of rounding into cells beside those that are there.
void CellLattice::ClearAround(const std::vector<CellValues>& sets, const ImageGrid& divided,
  double* cells, Progress& progress) const
{
  std::vector<bool> taken;
  this->FindTaken(sets, progress, taken);
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
      // Cell (i, j, k) of the divided grid is in the lattice's cell (i / parts, j / parts, k /
      // parts).
      const std::int64_t row = whole[0] * (j / part[1] + whole[1] * (k / part[2]));
      for (std::int64_t i = 0; i < fine[0]; ++i, ++at)
      {
        cells[at] = taken[static_cast<std::size_t>(row + i / part[0])] ? cells[at] : 0.0;
      }
    }
  }
}

// Makes a table from each place of the lattice to the number of its cell, -1 without one.
LatticeLookup::LatticeLookup(
  const CellLattice& lattice, const std::vector<CellValues>& sets, Progress& progress)
  : Lattice(lattice)
  , Sets(sets)
  , CellAt(static_cast<std::size_t>(lattice.Grid().NumberOfCells()), -1)
{
  for (const CellValues& values : sets)
  {
    // Numbers of the cells of all sets, one set after the other.
    this->First.push_back(this->First.back() + values.Cells().NumberOfCells);
  }
  lattice.VisitCounted(sets, progress, [&](std::int64_t at, std::size_t set, std::size_t cell) {
    this->CellAt[static_cast<std::size_t>(at)] = this->First[set] + static_cast<std::int64_t>(cell);
  });
}

// The cell at a place, `along` in spacings from the lattice's begin. A place at a face may be
// that of either cell: up to rounding, both cells along each axis are tried, eight in all.
std::int64_t LatticeLookup::CellNear(const std::array<double, 3>& along) const
{
  constexpr double rounding = 1e-6;
  const std::array<int, 3> cells = this->Lattice.Grid().NumberOfValues();
  std::array<std::array<std::int64_t, 2>, 3> sides{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    // Cells of the lattice are 0 to last along the axis.
    const double last = cells[a] - 1.0;
    const auto at = [&](double x) {
      return static_cast<std::int64_t>(std::clamp(std::floor(x), 0.0, last));
    };
    const std::int64_t here = at(along[a]);
    const std::int64_t below = at(along[a] - rounding);
    // The cell itself, and its neighbour if the place is within rounding of the face between them.
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

// The weights are multilinear: along each axis `part` for corners on the high side, 1 - part for
// others.
LatticeLookup::Place LatticeLookup::Find(const double* place) const
{
  const LatticeFrame& frame = this->Lattice.Frame();
  const Eigen::Vector3d x(place[0], place[1], place[2]);
  std::array<double, 3> along{ 0.0, 0.0, 0.0 };
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    // Coordinate along the axis from the first face, in spacings.
    along[a] =
      frame.IsAxis[a] ? (frame.Axes.col(axis).dot(x) - frame.Low[axis]) / frame.Spacing[axis] : 0.0;
  }
  Place found;
  const std::int64_t number = this->CellNear(along);
  if (number < 0)
  {
    return found;
  }
  // Numbers run through the cells of all sets, one set after the other.
  const auto next = std::upper_bound(this->First.begin(), this->First.end(), number);
  found.Set = static_cast<std::size_t>(next - this->First.begin()) - 1;
  found.Cell = number - this->First[found.Set];

  BoxCorners corners(this->Sets[found.Set].Cells(), this->Lattice.Grid().Dimension());
  std::array<std::int64_t, 3> at{};
  std::array<unsigned, 8> sides{};
  corners.Read(found.Cell);
  corners.FindPlace(frame, at, sides);
  for (int i = 0; i < corners.Count(); ++i)
  {
    double weight = 1.0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      // From 0 at the cell's low side to 1 at its high side.
      const double part = std::clamp(along[a] - static_cast<double>(at[a]), 0.0, 1.0);
      const bool isHigh = (sides[static_cast<std::size_t>(i)] >> a & 1U) != 0;
      weight *= !frame.IsAxis[a] ? 1.0 : isHigh ? part : 1.0 - part;
    }
    // A weight of 0 would not keep out values that are not finite.
    if (weight > 0.0)
    {
      const auto entry = static_cast<std::size_t>(found.Count++);
      found.Points[entry] = corners.PointOf(i);
      found.Weights[entry] = weight;
    }
  }
  return found;
}

} // namespace RectifiedTransport

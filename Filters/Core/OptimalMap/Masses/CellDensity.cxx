// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Masses/CellDensity.h"

#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Tables/DensityInspection.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

// Cells a chunk of parallel loops.
constexpr std::int64_t densityGrain = std::int64_t{ 1 } << 14;

} // namespace

// The uniform measure: each cell has the share 1 / cells, without an array.
template <int Dimension>
CellDensity<Dimension>::CellDensity(const GridSize<Dimension>& size)
  : Cells(size)
  , Count(LatticePart<Dimension>::WholeOf(size).Count())
  , UniformShare(1.0 / numberOfCells<Dimension>(size))
{
}

// Shares f_i / sum f, an array of one double a cell, axis 0 fastest. Reading, checking and summing
// take one pass by chunks.
template <int Dimension>
CellDensity<Dimension>::CellDensity(const DensitySource<Dimension>& density, Progress& progress)
  : CellDensity(density.Size)
{
  const auto values = density.Whole();
  this->Shares = LargeBuffer<double>(this->Count);
  double* shares = this->Shares.data();
  const DensitySummary found = reduceChunks(
    progress, this->Count, densityGrain, DensitySummary(),
    [&](std::int64_t first, std::int64_t last) {
      values->Read(first, last - first, shares + first);
      return summarize(shares + first, last - first, first);
    },
    [](DensitySummary all, const DensitySummary& part) {
      merge(part, all);
      return all;
    });
  requireDensity(found);
  this->Voids = !(found.Minimum > 0.0);
  const double total = found.Total;
  progress.ForEach(this->Count, densityGrain, [=](std::int64_t cell) { shares[cell] /= total; });
  // Shares below the smallest double are voids.
  this->Voids = this->Voids || found.Minimum / total == 0.0;
}

// Replaces own shares by the other's where both are the same density in different precisions, so
// that a map between them is exactly the identity.
template <int Dimension>
void CellDensity<Dimension>::TakeIfSame(const CellDensity& other, Progress& progress)
{
  if (this->Cells != other.Cells || this->IsUniform() || other.IsUniform())
  {
    return;
  }
  // One may have been kept as floats.
  constexpr double rounding = std::numeric_limits<float>::epsilon();
  // The least normal double allows for shares that are denormal in one of them.
  constexpr double least = std::numeric_limits<double>::min();
  double* own = this->Shares.data();
  const double* shares = other.Shares.data();
  const int areSame = reduceChunks(
    progress, this->Count, densityGrain, 1,
    [&](std::int64_t first, std::int64_t last) {
      const auto isSame = [](double a, double b) {
        return std::abs(a - b) <= rounding * std::max(a, b) + least;
      };
      return std::equal(own + first, own + last, shares + first, isSame) ? 1 : 0;
    },
    [](int all, int part) { return all & part; });
  if (areSame != 0)
  {
    std::copy_n(shares, this->Count, own);
    this->Voids = other.Voids;
  }
}

// The number of the cell that holds a point, axis 0 fastest.
template <int Dimension>
std::int64_t CellDensity<Dimension>::CellOf(const double* point) const
{
  return numberOfCellAt<Dimension>(point, this->Cells);
}

// The nearest cell with mass, in lengths between centres of cells.
template <int Dimension>
void CellDensity<Dimension>::MoveToMass(double* point, const Point<Dimension>& sides) const
{
  const PlaceInCell<Dimension> place(point, {}, this->Cells);
  const GridSize<Dimension>& own = place.Cell;
  const double shortest = *std::min_element(sides.begin(), sides.end());
  // Searches boxes of doubling radius about the cell. A found cell within the radius is the nearest
  // one, as every cell beyond the box is farther than the radius.
  for (double radius = 2.0 * shortest;; radius *= 2.0)
  {
    LatticePart<Dimension> part;
    bool isAll = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      // The box must hold all cells within the radius, in whole cells along each axis.
      const double reach = std::ceil(radius / sides[axis]);
      const auto cells =
        static_cast<std::int64_t>(std::min(reach, static_cast<double>(this->Cells[axis])));
      part.Low[axis] = std::max<std::int64_t>(0, own[axis] - cells);
      const std::int64_t end = std::min(this->Cells[axis], own[axis] + cells + 1);
      part.Cells[axis] = end - part.Low[axis];
      isAll = isAll && part.Cells[axis] == this->Cells[axis];
    }
    // If several cells are equally near, the first one in the part's order is taken, axis 0
    // fastest.
    double least = std::numeric_limits<double>::infinity();
    GridSize<Dimension> best = own;
    for (std::int64_t i = 0; i < part.Count(); ++i)
    {
      const GridSize<Dimension> cell = part.CellOf(i);
      double square = 0.0;
      std::int64_t number = 0;
      for (int axis = Dimension; axis-- > 0;)
      {
        const double way = static_cast<double>(cell[axis] - own[axis]) * sides[axis];
        square += way * way;
        number = number * this->Cells[axis] + cell[axis];
      }
      if (least > square && this->Share(number) > 0.0)
      {
        least = square;
        best = cell;
      }
    }
    if (least <= radius * radius || isAll)
    {
      place.MoveTo(best, point);
      return;
    }
  }
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(CellDensity);

} // namespace RectifiedTransport

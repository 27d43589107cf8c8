// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/MapFolds.h"

#include "Core/Flow/MapDerivatives.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Tables/CoveredCells.h"

#include <algorithm>
#include <atomic>
#include <vector>

namespace RectifiedTransport
{

// Counts from determinants that are there, of the samples `within`, axis 0 fastest.
template <int Dimension>
FoldCount MapFolds<Dimension>::Count(const LatticePart<Dimension>& part,
  const LatticePart<Dimension>& within, const double* determinants, Progress& progress) const
{
  return this->CountRows(
    part,
    [&](const LatticePart<Dimension>& row, std::vector<double>&) {
      return determinants + within.NumberOf(row.Low);
    },
    progress);
}

// Counts from positions: determinants are made for one row at a time, and need no array.
template <int Dimension>
FoldCount MapFolds<Dimension>::Count(const LatticePart<Dimension>& part,
  const LatticePart<Dimension>& within, const Point<Dimension>& step,
  ConstPointSpan<Dimension> positions, Progress& progress) const
{
  return this->CountRows(
    part,
    [&](const LatticePart<Dimension>& row, std::vector<double>& memory) {
      const auto count = static_cast<std::size_t>(row.Count());
      // Determinants and divergences of one row; only the former are used.
      memory.resize(2 * count);
      MapDerivatives<Dimension>(this->Lattice, row, within, step, positions)
        .Write(0, row.Count(), memory.data() + count, memory.data());
      return static_cast<const double*>(memory.data());
    },
    progress);
}

// Counts folds row by row. `determinantsOf` returns the determinants of a row of samples, in its
// buffer or elsewhere.
template <int Dimension>
template <class Determinants>
FoldCount MapFolds<Dimension>::CountRows(
  const LatticePart<Dimension>& part, const Determinants& determinantsOf, Progress& progress) const
{
  if (part.IsEmpty())
  {
    return {};
  }
  // In 1D the single row is cut, so that threads share it.
  constexpr std::int64_t most = 1 << 13;
  // Rows are the units of work: a row's determinants are computed or found together, and counted
  // one after the other.
  const std::int64_t length = Dimension > 1 ? part.Cells[0] : std::min(most, part.Cells[0]);
  const std::int64_t rows = (part.Count() + length - 1) / length;
  return sumExactly<FoldCount>(progress, rows, std::max<std::int64_t>(1, most / length),
    [&](std::int64_t first, std::int64_t last, FoldCount& found) {
      std::vector<double> memory;
      for (std::int64_t i = first; i < last; ++i)
      {
        LatticePart<Dimension> row{ part.CellOf(i * length), {} };
        row.Cells.fill(1);
        row.Cells[0] = std::min(length, part.End(0) - row.Low[0]);
        const double* determinants = determinantsOf(row, memory);
        GridSize<Dimension> sample = row.Low;
        // The exact sum of areas does not depend on how samples are divided among threads and
        // ranks.
        for (std::int64_t k = 0; k < row.Cells[0]; ++k, ++sample[0])
        {
          // A folded sample; its area counts as the reversed part of its image.
          if (determinants[k] <= 0.0 && !this->IsCorner(sample) && this->HasMass(sample))
          {
            ++found.Samples;
            found.Area.Add(-determinants[k]);
          }
        }
      }
    });
}

template <int Dimension>
std::int64_t MapFolds<Dimension>::CountWithMass(
  const LatticePart<Dimension>& part, Progress& progress) const
{
  constexpr std::int64_t grain = 1 << 13;
  if (!this->Density || part.IsEmpty())
  {
    return part.IsEmpty() ? 0 : part.Count();
  }
  // Integers add up exactly in any order.
  std::atomic<std::int64_t> all{ 0 };
  progress.For(part.Count(), grain, [&](std::int64_t first, std::int64_t last) {
    std::int64_t found = 0;
    for (std::int64_t i = first; i < last; ++i)
    {
      found += this->HasMass(part.CellOf(i)) ? 1 : 0;
    }
    all += found;
  });
  return all;
}

// The two outermost samples along two axes: central differences there mix both faces.
template <int Dimension>
bool MapFolds<Dimension>::IsCorner(const GridSize<Dimension>& sample) const
{
  constexpr std::int64_t outermost = 2;
  // Counts the axes along which the sample is at a face of the domain; two or more make a corner or
  // an edge.
  int atBorder = 0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t samples = this->Lattice[axis];
    const bool isAxis = samples > 1; // otherwise displacements do not change along it
    atBorder += isAxis && (sample[axis] < outermost || sample[axis] >= samples - outermost) ? 1 : 0;
  }
  return atBorder > 1;
}

// Tests the occupied grid cells, since shares from tables have rounding errors.
template <int Dimension>
bool MapFolds<Dimension>::HasMass(const GridSize<Dimension>& sample) const
{
  if (!this->Density)
  {
    return true;
  }
  // The cells of the density under the sample's cell of the lattice.
  const GridSize<Dimension>& size = this->Density->Size();
  const Point<Dimension> step = latticeStep<Dimension>(this->Lattice, size);
  LatticePart<Dimension> cells;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const auto place = static_cast<double>(sample[axis]);
    // The cells of the density that the sample's cell covers, in part or as a whole.
    const CoveredCells covered(place * step[axis], (place + 1.0) * step[axis], size[axis]);
    cells.Low[axis] = covered.First;
    cells.Cells[axis] = covered.End - covered.First;
  }
  const std::int64_t count = cells.Count();
  for (std::int64_t i = 0; i < count; ++i)
  {
    const GridSize<Dimension> cell = cells.CellOf(i);
    Point<Dimension> centre = cellCentre<Dimension>();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      centre[axis] += static_cast<double>(cell[axis]);
    }
    if (this->Density->HasMass(centre))
    {
      return true;
    }
  }
  return false;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(MapFolds);

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/CellMeans.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{

template <int D>
CellMeans<D>::CellMeans(
  const PlacedCells<D>& density, const GridSize<D>& size, const LatticePart<D>& part)
  : Cells(density.Size)
  , Part(part)
{
  // The overlap of boxes along the same axes is a product over the axes, so each axis keeps a
  // sparse matrix: for each cell of the part, the lengths of its intersections with the density's
  // cells.
  for (int axis = 0; axis < D && !part.IsEmpty(); ++axis)
  {
    const std::int64_t cells = density.Size[axis];
    const double side = density.Sides[axis];
    const auto whole = static_cast<double>(size[axis]);
    // The lower end of a cell of the density, in cells of the other grid. It is clamped to that
    // grid.
    const auto endOf = [&](std::int64_t cell) {
      return std::clamp(density.Low[axis] + side * static_cast<double>(cell), 0.0, whole);
    };
    this->First[axis] = cells;
    for (std::int64_t i = part.Low[axis]; i < part.End(axis); ++i)
    {
      const auto low = static_cast<double>(i);
      const double high = low + 1.0;
      Overlap overlap;
      // Division gives the first cell that overlaps up to rounding. The loops then correct it by
      // the same ends that the lengths use, so that consecutive cells neither leave a gap nor
      // overlap.
      const double guess = std::floor((low - density.Low[axis]) / side);
      auto cell = static_cast<std::int64_t>(std::clamp(guess, 0.0, static_cast<double>(cells)));
      while (cell > 0 && endOf(cell) > low)
      {
        --cell;
      }
      while (cell < cells && endOf(cell + 1) <= low)
      {
        ++cell;
      }
      overlap.First = cell;
      for (; cell < cells && endOf(cell) < high; ++cell)
      {
        const double from = endOf(cell);
        const double to = endOf(cell + 1);
        const double both = std::min(to, high) - std::max(from, low);
        // Side times the part of the clamped cell [from, to] that is in this one. What is beyond
        // the border is spread over the clamped cell, so that sum over parts = side: no mass is
        // lost. Where both grids have the same cells the factor is exactly 1.
        overlap.Shares.push_back(to > from ? side * (both / (to - from)) : 0.0);
      }
      if (overlap.Count() > 0)
      {
        this->First[axis] = std::min(this->First[axis], overlap.First);
        this->Last[axis] = std::max(this->Last[axis], overlap.First + overlap.Count());
      }
      this->Axes[axis].push_back(std::move(overlap));
    }
    this->First[axis] = std::min(this->First[axis], this->Last[axis]);
  }
}

template <int D>
void CellMeans<D>::WriteRow(
  std::int64_t row, const DensityValues& density, double* buffer, double* means) const
{
  // The matrix product along the axes across the row: mean(i) = sum over k and j of s_2(k) s_1(j)
  // sum over cells of s_0(i, cell) f(cell, j, k). Each row of the density is read once for each
  // row of means.
  const std::int64_t columns = this->Part.Cells[0];
  std::fill_n(means, columns, 0.0);
  const Overlap* across[2] = { nullptr, nullptr };
  for (int axis = 1; axis < D; ++axis)
  {
    across[axis - 1] = &this->Axes[axis][static_cast<std::size_t>(row % this->Part.Cells[axis])];
    row /= this->Part.Cells[axis];
  }
  const auto countOf = [&](int axis) {
    return D > axis ? across[axis - 1]->Count() : std::int64_t{ 1 };
  };
  const std::int64_t wanted = this->Last[0] - this->First[0];
  for (std::int64_t k = 0; k < countOf(2) && wanted > 0; ++k)
  {
    for (std::int64_t j = 0; j < countOf(1); ++j)
    {
      GridSize<D> cell = this->First;
      double share = 1.0;
      const std::int64_t at[2] = { j, k };
      for (int axis = 1; axis < D; ++axis)
      {
        cell[axis] = across[axis - 1]->First + at[axis - 1];
        share *= across[axis - 1]->Shares[static_cast<std::size_t>(at[axis - 1])];
      }
      density.Read(LatticePart<D>::WholeOf(this->Cells).NumberOf(cell), wanted, buffer);
      for (std::int64_t i = 0; i < columns; ++i)
      {
        const Overlap& along = this->Axes[0][static_cast<std::size_t>(i)];
        const double* values = buffer + (along.First - this->First[0]);
        double sum = 0.0;
        for (const double part : along.Shares)
        {
          sum += part * *values++;
        }
        means[i] += share * sum;
      }
    }
  }
}

template <int D>
void CellMeans<D>::Write(const DensityValues& density, Progress& progress, double* means) const
{
  if (this->Part.IsEmpty())
  {
    return;
  }
  // Chunks of about this many cells, for few tasks and short waits for cancellation.
  constexpr std::int64_t atOnce = std::int64_t{ 1 } << 14;
  const std::int64_t columns = this->Part.Cells[0];
  const std::int64_t rows = this->Part.Count() / columns;
  const std::int64_t work = std::max(columns, this->Last[0] - this->First[0]);
  const std::int64_t grain = std::max<std::int64_t>(1, atOnce / work);
  progress.For(
    rows, grain,
    [&](std::int64_t first, std::int64_t last) {
      std::vector<double> buffer(static_cast<std::size_t>(this->Last[0] - this->First[0]));
      for (std::int64_t row = first; row < last; ++row)
      {
        this->WriteRow(row, density, buffer.data(), means + row * columns);
      }
    },
    grain);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(CellMeans);

} // namespace RectifiedTransport

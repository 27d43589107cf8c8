// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/Masses/NodeMasses.h"

#include "Core/OptimalMap/Masses/AxisShares.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The values of cells: an array, or the same for all.
struct CellValues
{
  const double* Values; // null if all are Each
  double Each = 0.0;

  double At(std::int64_t cell) const { return this->Values ? this->Values[cell] : this->Each; }
};

// Sums the cells of rows [first, last) along axis 0 in bins: bin b of a row gets sum_i share(i, b)
// value_i.
void sumRows(const AxisShares& shares, const CellValues& values, std::int64_t cells,
  std::int64_t bins, std::int64_t first, std::int64_t last, double* sums)
{
  for (std::int64_t row = first; row < last; ++row)
  {
    // A row's bins are its own, so rows may be summed on any thread.
    double* rowSums = sums + row * bins;
    std::fill_n(rowSums, bins, 0.0);
    for (std::int64_t cell = 0; cell < cells; ++cell)
    {
      const double value = values.At(row * cells + cell);
      shares.ForBins(cell, [&](std::int64_t bin, double share) { rowSums[bin] += share * value; });
    }
  }
}

// Sums the values of cells in bins, along one axis after the other: the weight of a hat or cell is
// the product of those along the axes. Bins are nodes with hats, else cells between nodes. Rows,
// and parts of layers across an axis, are independent.
template <int Dimension>
NodeValues sumInBins(CellValues values, GridSize<Dimension> size,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, bool hats,
  Progress& progress)
{
  // A part of a layer has so many columns: 4 KiB, which stay in cache while the bins of a layer are
  // summed.
  constexpr std::int64_t columns = 512;
  constexpr std::int64_t firstValues = std::int64_t{ 1 } << 18;
  NodeValues last;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const AxisShares shares(
      size[axis], placement.Low[axis], placement.Sides[axis], grid.Cells[axis], hats);
    // Values lie as [after][cells][before]: `before` values along the axes already summed, and
    // `after` layers of those still to come.
    std::int64_t before = 1;
    std::int64_t after = 1;
    for (int a = 0; a < Dimension; ++a)
    {
      (a < axis ? before : after) *= a == axis ? 1 : size[a];
    }
    const std::int64_t cells = size[axis];
    const std::int64_t bins = grid.Cells[axis] + (hats ? 1 : 0);
    NodeValues sums(before * bins * after);
    double* to = sums.data();
    // Work is divided into layers after the axis, and each layer into parts of its columns.
    const std::int64_t parts = (before + columns - 1) / columns;
    const std::int64_t grain = axis == 0 ? std::max<std::int64_t>(1, 4096 / cells) : 1;
    progress.For(
      parts * after, grain,
      [&](std::int64_t first, std::int64_t end) {
        if (axis == 0)
        {
          sumRows(shares, values, cells, bins, first, end, to);
          return;
        }
        for (std::int64_t part = first; part < end; ++part)
        {
          const std::int64_t layer = part / parts;
          const std::int64_t begin = part % parts * columns;
          const std::int64_t count = std::min(columns, before - begin);
          double* layerSums = to + layer * bins * before + begin;
          for (std::int64_t bin = 0; bin < bins; ++bin)
          {
            std::fill_n(layerSums + bin * before, count, 0.0);
          }
          for (std::int64_t cell = 0; cell < cells; ++cell)
          {
            // A cell's columns are added to the few bins that it overlaps.
            const double* of = values.Values + (layer * cells + cell) * before + begin;
            shares.ForBins(cell, [&](std::int64_t bin, double share) {
              double* sum = layerSums + bin * before;
              for (std::int64_t i = 0; i < count; ++i)
              {
                sum[i] += share * of[i];
              }
            });
          }
        }
      },
      std::max<std::int64_t>(1, firstValues / std::min(before, columns) / bins));
    // The next axis reads these sums; those of the axis before are freed.
    last = std::move(sums);
    values = { last.data() };
    size[axis] = bins;
  }
  return last;
}

// The shares of a density's cells, in an array or all the same.
template <int Dimension>
CellValues sharesOf(const CellDensity<Dimension>& density)
{
  return { density.data(), density.IsUniform() ? density.Share(0) : 0.0 };
}

// Multiplies all values by a factor.
void scale(NodeValues& values, double factor, Progress& progress)
{
  double* all = values.data();
  progress.ForEach(
    values.size(), std::int64_t{ 1 } << 14, [=](std::int64_t i) { all[i] *= factor; });
}

// The marginals: the density summed over all axes but one, for each axis, one array after the
// other. At most 64 partial sums over rows keep the bits independent of threads.
template <int Dimension>
std::vector<double> marginalsOf(const CellDensity<Dimension>& density, Progress& progress)
{
  constexpr std::int64_t mostParts = 64;
  const GridSize<Dimension>& size = density.Size();
  if (density.IsUniform())
  {
    // Each cell of an axis has the same part of the mass.
    std::vector<double> sums;
    for (const std::int64_t cells : size)
    {
      sums.insert(sums.end(), static_cast<std::size_t>(cells), 1.0 / static_cast<double>(cells));
    }
    return sums;
  }
  const std::int64_t rows = density.NumberOfCells() / size[0];
  const std::int64_t each = (rows + mostParts - 1) / mostParts;
  const auto all = static_cast<std::size_t>(std::accumulate(size.begin(), size.end(), 0LL));
  return reduceChunks(
    progress, rows, each, std::vector<double>(all, 0.0),
    [&](std::int64_t first, std::int64_t last) {
      std::vector<double> sums(all, 0.0);
      for (std::int64_t row = first; row < last; ++row)
      {
        double sum = 0.0;
        for (std::int64_t i = 0; i < size[0]; ++i)
        {
          const double share = density.data()[row * size[0] + i];
          sums[static_cast<std::size_t>(i)] += share;
          sum += share;
        }
        // A row's sum goes to its own place along each other axis; `begin` is where that axis's
        // array starts.
        std::int64_t begin = size[0];
        std::int64_t rest = row;
        for (int axis = 1; axis < Dimension; ++axis)
        {
          sums[static_cast<std::size_t>(begin + rest % size[axis])] += sum;
          begin += size[axis];
          rest /= size[axis];
        }
      }
      return sums;
    },
    [](std::vector<double> sums, const std::vector<double>& part) {
      std::transform(sums.begin(), sums.end(), part.begin(), sums.begin(), std::plus<>());
      return sums;
    },
    each);
}

} // namespace

// mu_i = integral of hat function i over the density; the sum over all nodes is 1.
template <int Dimension>
NodeValues hatMasses(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, Progress& progress)
{
  return sumInBins<Dimension>(sharesOf(density), density.Size(), placement, grid, true, progress);
}

// The values need not be masses; they are not scaled.
template <int Dimension>
NodeValues hatSums(const double* values, const GridSize<Dimension>& size,
  const NodeGrid<Dimension>& grid, Progress& progress)
{
  // The grid of values fills the box of the nodes, whatever their numbers.
  return sumInBins<Dimension>(CellValues{ values }, size,
    CellPlacement<Dimension>::Filling(size, grid.Cells), grid, true, progress);
}

template <int Dimension>
NodeValues hatMasses(const double* cells, const GridSize<Dimension>& size,
  const NodeGrid<Dimension>& grid, Progress& progress)
{
  // Masses of mean 1 sum to the number of cells, by which the sums over hats are divided
  // afterwards.
  const CellValues values{ cells, 1.0 };
  NodeValues masses = sumInBins<Dimension>(
    values, size, CellPlacement<Dimension>::Filling(size, grid.Cells), grid, true, progress);
  scale(masses, 1.0 / numberOfCells<Dimension>(size), progress);
  return masses;
}

// Shares times the number of cells: masses of mean 1.
template <int Dimension>
NodeValues cellMasses(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, Progress& progress)
{
  NodeValues values =
    sumInBins<Dimension>(sharesOf(density), density.Size(), placement, grid, false, progress);
  scale(values, static_cast<double>(grid.NumberOfCells()), progress);
  return values;
}

// The masses are exact also if the numbers of cells are no multiples of each other: a fine cell is
// divided by length.
template <int Dimension>
NodeValues coarserCells(const double* cells, const GridSize<Dimension>& size,
  const NodeGrid<Dimension>& coarser, Progress& progress)
{
  const CellValues values{ cells };
  NodeValues masses = sumInBins<Dimension>(
    values, size, CellPlacement<Dimension>::Filling(size, coarser.Cells), coarser, false, progress);
  // Means of 1 on both grids: a coarse cell holds the sum of `all / coarser` fine ones.
  const double all = numberOfCells<Dimension>(size);
  scale(masses, static_cast<double>(coarser.NumberOfCells()) / all, progress);
  return masses;
}

// sum_i mu_i |x_i|^2 - M2(density), in squared lengths. Hats keep masses and centroids, so that the
// excess is a sum over axes and cells: the second moment of a cell's hats about its centre, less
// side^2 / 12, that of a uniform cell.
template <int Dimension>
double lumpingExcess(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, Progress& progress)
{
  const std::vector<double> marginals = marginalsOf(density, progress);
  double excess = 0.0;
  std::size_t begin = 0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const std::int64_t cells = density.Size()[axis];
    const double low = placement.Low[axis];
    const double side = placement.Sides[axis];
    const AxisShares shares(cells, low, side, grid.Cells[axis], true);
    double sum = 0.0; // in squared cells of the nodes
    for (std::int64_t cell = 0; cell < cells; ++cell)
    {
      const double centre = low + side * (static_cast<double>(cell) + 0.5);
      double lumped = 0.0;
      shares.ForBins(cell, [&](std::int64_t bin, double share) {
        const double way = static_cast<double>(bin) - centre;
        lumped += share * way * way;
      });
      sum += marginals[begin + static_cast<std::size_t>(cell)] * (lumped - side * side / 12.0);
    }
    excess += sum * grid.Spacing[axis] * grid.Spacing[axis];
    begin += static_cast<std::size_t>(cells);
  }
  return excess;
}

template NodeValues hatMasses<1>(
  const CellDensity<1>&, const CellPlacement<1>&, const NodeGrid<1>&, Progress&);
template NodeValues hatMasses<2>(
  const CellDensity<2>&, const CellPlacement<2>&, const NodeGrid<2>&, Progress&);
template NodeValues hatMasses<3>(
  const CellDensity<3>&, const CellPlacement<3>&, const NodeGrid<3>&, Progress&);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(hatSums);
template NodeValues hatMasses<1>(const double*, const GridSize<1>&, const NodeGrid<1>&, Progress&);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(coarserCells);
template NodeValues hatMasses<2>(const double*, const GridSize<2>&, const NodeGrid<2>&, Progress&);
template NodeValues hatMasses<3>(const double*, const GridSize<3>&, const NodeGrid<3>&, Progress&);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(cellMasses);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(lumpingExcess);

} // namespace RectifiedTransport

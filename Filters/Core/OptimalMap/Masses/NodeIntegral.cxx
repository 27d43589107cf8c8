// SPDX-License-Identifier: BSD-3-Clause
// Integrals of functions that are given at nodes.
#include "Core/OptimalMap/Masses/AxisShares.h"
#include "Core/OptimalMap/Masses/NodeMasses.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The integral of the interpolant over the density, sum_cells share sum_nodes w_node value: a
// tensor product of AxisShares. From the last axis to the first it takes the mean of the layers of
// nodes about a layer of cells, while these are in the cache.
template <int Dimension>
class Integral
{
public:
  Integral(const CellDensity<Dimension>& density, const CellPlacement<Dimension>& placement,
    const NodeGrid<Dimension>& grid)
    : Density(density)
    , Grid(grid)
  {
    constexpr bool hats = true;
    std::int64_t cells = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Shares.emplace_back(
        density.Size()[axis], placement.Low[axis], placement.Sides[axis], grid.Cells[axis], hats);
      this->CellStrides[static_cast<std::size_t>(axis)] = cells;
      cells *= density.Size()[axis];
    }
  }

  // `values` has one value a node. Chunks of layers have a fixed size and are added in order, so
  // that the bits do not depend on the number of threads.
  double Over(const double* values, Progress& progress) const
  {
    constexpr int last = Dimension - 1;
    // Nodes a chunk: 256 KiB, which stay in the second-level cache.
    constexpr std::int64_t nodes = std::int64_t{ 1 } << 15;
    const std::int64_t grain = std::max<std::int64_t>(1, nodes / this->Grid.Stride(last));
    return reduceChunks(
      progress, this->Density.Size()[last], grain, 0.0,
      [&](std::int64_t first, std::int64_t end) {
        Means means;
        for (std::size_t axis = 1; axis < means.size(); ++axis)
        {
          means[axis].resize(static_cast<std::size_t>(this->Grid.Stride(static_cast<int>(axis))));
        }
        return this->template Along<last>(values, 0, first, end, means);
      },
      [](double all, double part) { return all + part; }, grain);
  }

private:
  using Means = std::array<std::vector<double>, Dimension>; // the mean layer across each axis

  // The integral over the cells [first, end) along an axis, in the layer of cells that begins at
  // `cell`. `values` are the nodes of a layer, means along the axes after Axis.
  template <int Axis>
  double Along(const double* values, std::int64_t cell, std::int64_t first, std::int64_t end,
    Means& means) const
  {
    double sum = 0.0;
    for (std::int64_t i = first; i < end; ++i)
    {
      const std::int64_t begin = cell + i * this->CellStrides[Axis];
      if constexpr (Axis == 0)
      {
        double mean = 0.0;
        this->Shares[Axis].ForBins(
          i, [&](std::int64_t node, double share) { mean += share * values[node]; });
        sum += this->Density.Share(begin) * mean;
      }
      else if (this->HasMass<Axis>(begin))
      {
        this->template TakeMean<Axis>(values, i, means[Axis]);
        sum += this->template Along<Axis - 1>(
          means[Axis].data(), begin, 0, this->Density.Size()[Axis - 1], means);
      }
    }
    return sum;
  }

  // Whether a layer has any; those of a void need no mean.
  template <int Axis>
  bool HasMass(std::int64_t begin) const
  {
    const double* shares = this->Density.data();
    return !shares ||
      std::any_of(shares + begin, shares + begin + this->CellStrides[Axis],
        [](double share) { return share > 0.0; });
  }

  // The mean over a cell along the axis of the layers of nodes about it, by their hats.
  template <int Axis>
  void TakeMean(const double* values, std::int64_t cell, std::vector<double>& mean) const
  {
    const auto stride = static_cast<std::int64_t>(mean.size());
    double* means = mean.data();
    std::fill_n(means, stride, 0.0);
    this->Shares[Axis].ForBins(cell, [&](std::int64_t node, double share) {
      const double* layer = values + node * stride;
      for (std::int64_t i = 0; i < stride; ++i)
      {
        means[i] += share * layer[i];
      }
    });
  }

  const CellDensity<Dimension>& Density;
  const NodeGrid<Dimension>& Grid;
  std::vector<AxisShares> Shares;
  std::array<std::int64_t, Dimension> CellStrides{};
};

} // namespace

template <int Dimension>
double integrateOver(const CellDensity<Dimension>& density,
  const CellPlacement<Dimension>& placement, const NodeGrid<Dimension>& grid, const double* values,
  Progress& progress)
{
  return Integral<Dimension>(density, placement, grid).Over(values, progress);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(integrateOver);

} // namespace RectifiedTransport

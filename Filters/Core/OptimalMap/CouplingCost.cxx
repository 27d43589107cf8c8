// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/CouplingCost.h"

#include "Core/OptimalMap/Masses/NodeMasses.h"
#include "Core/OptimalMap/Nodes/IntegerSums.h"
#include "Core/OptimalMap/Nodes/NodePoisson.h"
#include "Core/OptimalMap/Nodes/NodeSums.h"
#include "Core/OptimalMap/Nodes/PoissonMoves.h"
#include "Core/OptimalMap/PassRest.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr int corrections = 2;
constexpr int iterations = 6;
constexpr double leastWeight = 0.1; // of the mean density
constexpr std::int64_t grain = std::int64_t{ 1 } << 14;

// The coupling. Masses are integers, as in IntegerSums.h, so that passing them on loses nothing.
template <int Dimension>
class Coupling
{
public:
  Coupling(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
    const NodeMap<Dimension>& map, Progress& progress)
    : Source(source)
    , Target(target)
    , Count(target.NumberOfCells())
    , Placement(CellPlacement<Dimension>::Filling(target.Size(), map.Grid.Cells))
    , Work(progress)
  {
    this->Shares.Size = target.Size();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Shares.Sides[axis] = map.Grid.Spacing[axis] * this->Placement.Sides[axis];
      const double length = this->Shares.Sides[axis] * static_cast<double>(this->Shares.Size[axis]);
      this->Shares.SquaredDiagonal += length * length;
    }
  }

  double Cost(const NodeMap<Dimension>& map)
  {
    this->ShareCorrected(map);
    return passRest(this->Shares, this->Target, this->Work);
  }

private:
  // The images of the cells' corners, in cells, of a map between its nodes.
  void FindCorners(const std::array<NodeValues, Dimension>& images,
    const GridSize<Dimension>& nodeCells, NodeMap<Dimension>& corners)
  {
    const GridSize<Dimension>& cells = corners.Grid.Cells;
    const std::int64_t line = cells[0] + 1;
    const auto placeOf = [&](std::int64_t corner, int axis) {
      return static_cast<double>(corner * nodeCells[axis]) / static_cast<double>(cells[axis]);
    };
    const std::int64_t lines = std::max<std::int64_t>(1, grain / line);
    this->Work.For(
      corners.Grid.NumberOfNodes(), lines * line, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t begin = first; begin < last; begin += line)
        {
          Point<Dimension> at{};
          std::int64_t rest = begin / line;
          for (int axis = 1; axis < Dimension; ++axis)
          {
            at[axis] = placeOf(rest % (cells[axis] + 1), axis);
            rest /= cells[axis] + 1;
          }
          for (std::int64_t i = 0; i < line; ++i)
          {
            at[0] = placeOf(i, 0);
            const HatsAt<Dimension> hats(at.data(), nodeCells);
            for (int axis = 0; axis < Dimension; ++axis)
            {
              const auto a = static_cast<std::size_t>(axis);
              corners.Images[a].data()[begin + i] =
                hats.Interpolate(images[a].data()) / this->Placement.Sides[axis];
            }
          }
        }
      });
  }

  // Shares the source's mass among the target's cells as the map says, with its images corrected
  // so that cells get what they should.
  void ShareCorrected(const NodeMap<Dimension>& map)
  {
    const NodeGrid<Dimension>& grid = map.Grid;
    const std::int64_t nodes = grid.NumberOfNodes();
    auto corners = NodeMap<Dimension>::On({ this->Shares.Size, this->Shares.Sides });
    std::array<NodeValues, Dimension> images;
    for (std::size_t axis = 0; axis < images.size(); ++axis)
    {
      images[axis] = NodeValues(nodes);
      std::copy_n(map.Images[axis].data(), nodes, images[axis].data());
    }
    const NodeValues wanted = hatMasses<Dimension>(this->Target, this->Placement, grid, this->Work);
    NodePoisson<Dimension> poisson(grid);
    NodeValues excess(nodes);
    NodeValues q(nodes);
    for (int correction = 0;; ++correction)
    {
      this->FindCorners(images, grid.Cells, corners);
      if (correction == corrections)
      {
        this->ShareImages<CellShares<Dimension>::WithCosts>(corners);
        return;
      }
      this->ShareImages<CellShares<Dimension>::MassAlone>(corners);
      this->FindExcess(grid, excess);
      poisson.SolveWeighted(
        excess.data(), wanted.data(), leastWeight, iterations, q.data(), this->Work);
      const NodeMoves<Dimension> moves(grid, q.data(), this->Work);
      this->Work.For(nodes, grain, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t node = first; node < last; ++node)
        {
          Point<Dimension> at;
          for (std::size_t axis = 0; axis < images.size(); ++axis)
          {
            at[axis] = images[axis].data()[node];
          }
          const Point<Dimension> move = moves.At(at.data());
          for (std::size_t axis = 0; axis < images.size(); ++axis)
          {
            images[axis].data()[node] =
              std::clamp(at[axis] + move[axis], 0.0, static_cast<double>(grid.Cells[axis]));
          }
        }
      });
    }
  }

  // What the nodes' hats got above the target, with each cell's mass at its centre.
  void FindExcess(const NodeGrid<Dimension>& grid, NodeValues& excess)
  {
    NodeSums<Dimension> sums(grid, 1.0, this->Count, this->Work);
    this->Work.For(this->Count, grain, [&](std::int64_t first, std::int64_t last) {
      typename NodeSums<Dimension>::Part part(sums);
      for (std::int64_t cell = first; cell < last; ++cell)
      {
        Point<Dimension> centre;
        const GridSize<Dimension> place = this->Shares.PlaceOf(cell);
        for (int axis = 0; axis < Dimension; ++axis)
        {
          centre[axis] = static_cast<double>(place[axis]) + 0.5;
        }
        const Point<Dimension> at = this->Placement.ToNodes(centre.data());
        part.Add(
          static_cast<double>(this->Shares.RestOf(cell, this->Target)) / integerUnit, at.data());
      }
    });
    sums.Write(excess.data(), this->Work, [](std::int64_t, double sum) { return sum; });
  }

  // Each image of a part of a cell goes to the cells with mass about it.
  template <int Each>
  void ShareImages(const NodeMap<Dimension>& corners)
  {
    this->Shares.Each = Each;
    const std::int64_t rows = ImageSamples<Dimension>::NumberOfRows(corners.Grid);
    const std::int64_t each = std::max<std::int64_t>(1, 8192 / this->Shares.Size[0]);
    const std::int64_t sums = this->Count * Each;
    this->Shares.Sums = LargeBuffer<std::int64_t>(); // before there are new ones
    IntegerSums integers(sums, this->Count * 4, this->Work);
    this->Work.For(
      rows, each,
      [&](std::int64_t first, std::int64_t last) {
        const IntegerSums::Part part(integers);
        ImageSamples<Dimension> samples(corners);
        const double scale = integerUnit * (this->Source.IsUniform() ? this->Source.Share(0) : 1.0);
        for (std::int64_t row = first; row < last; ++row)
        {
          const std::int64_t begin = row * this->Shares.Size[0];
          GridSize<Dimension> place = this->Shares.PlaceOf(begin);
          samples.ForRow(row, this->Source.data(),
            [&](const CellSample<Dimension>& sample, const Point<Dimension>& image) {
              place[0] = sample.Cell - begin;
              this->ShareImage<Each>(place, sample.Mass * scale, image, part.Values());
            });
        }
      },
      each);
    this->Shares.Sums = integers.Release(this->Work);
  }

  template <int Each>
  void ShareImage(const GridSize<Dimension>& from, double mass, const Point<Dimension>& image,
    std::int64_t* out) const
  {
    constexpr int corners = 1 << Dimension;
    std::int64_t to[corners] = { 0 };
    double weight[corners] = { 1.0 };
    double ways[Dimension][2];
    std::int64_t stride = 1;
    int count = 1;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double most = static_cast<double>(this->Shares.Size[axis] - 1);
      const double at = std::clamp(image[axis] - 0.5, 0.0, most);
      const auto low = static_cast<std::int64_t>(at);
      const double high = at - static_cast<double>(low);
      const std::int64_t step = low + 1 < this->Shares.Size[axis] ? stride : 0;
      ways[axis][0] = static_cast<double>(low - from[axis]);
      ways[axis][1] = static_cast<double>(low + 1 - from[axis]);
      for (int c = 0; c < count; ++c)
      {
        to[c] += low * stride;
        to[count + c] = to[c] + step;
        weight[count + c] = weight[c] * high;
        weight[c] *= 1.0 - high;
      }
      count *= 2;
      stride *= this->Shares.Size[axis];
    }
    double sum = 0.0;
    for (int c = 0; c < corners; ++c)
    {
      weight[c] = this->Target.Share(to[c]) > 0.0 ? weight[c] : 0.0;
      sum += weight[c];
    }
    if (sum == 0.0) // None has mass: all to one of them, from where it goes on.
    {
      weight[0] = 1.0;
      sum = 1.0;
    }
    for (int c = 0; c < corners; ++c)
    {
      if (weight[c] > 0.0)
      {
        const double share = mass * (weight[c] / sum);
        std::int64_t* got = out + to[c] * Each;
        got[0] += toInteger(share);
        if constexpr (Each > 1)
        {
          double square = 0.0;
          for (int axis = 0; axis < Dimension; ++axis)
          {
            const double way = ways[axis][(c >> axis) & 1];
            const double length = way * this->Shares.Sides[axis];
            square += length * length;
            got[1 + axis] += toInteger(share * way / static_cast<double>(this->Shares.Size[axis]));
          }
          // Rounded up.
          const double cost = share * square / this->Shares.SquaredDiagonal;
          got[1 + Dimension] += static_cast<std::int64_t>(cost) + (cost > 0.0 ? 1 : 0);
        }
      }
    }
  }

  const CellDensity<Dimension>& Source;
  const CellDensity<Dimension>& Target;
  std::int64_t Count;
  CellPlacement<Dimension> Placement; // of the cells on the nodes
  Progress& Work;
  CellShares<Dimension> Shares;
};

} // namespace

template <int Dimension>
double couplingCost(const CellDensity<Dimension>& source, const CellDensity<Dimension>& target,
  const NodeMap<Dimension>& map, Progress& progress)
{
  if (source.Size() != target.Size())
  {
    throw std::invalid_argument("A coupling's cost needs densities of the same size.");
  }
  return Coupling<Dimension>(source, target, map, progress).Cost(map);
}

template <int Dimension>
double memoryForCoupling(const GridSize<Dimension>& size, const NodeGrid<Dimension>& grid)
{
  constexpr double integers = 16.0 + (Dimension + 2) + 1; // a cell: of all arrays, and the rest
  constexpr double ofCurve = 24.0;                        // bytes a cell
  const double cells = numberOfCells<Dimension>(size);
  return cells * (sizeof(std::int64_t) * integers + ofCurve) +
    numberOfCorners<Dimension>(size) * sizeof(double) * Dimension +
    numberOfCorners<Dimension>(grid.Cells) * sizeof(double) *
    (2.0 * Dimension + 3.0 + mostArraysOfSums) +
    NodePoisson<Dimension>::MemoryFor(grid, true);
}

template double couplingCost<1>(
  const CellDensity<1>&, const CellDensity<1>&, const NodeMap<1>&, Progress&);
template double couplingCost<2>(
  const CellDensity<2>&, const CellDensity<2>&, const NodeMap<2>&, Progress&);
template double couplingCost<3>(
  const CellDensity<3>&, const CellDensity<3>&, const NodeMap<3>&, Progress&);
template double memoryForCoupling<1>(const GridSize<1>&, const NodeGrid<1>&);
template double memoryForCoupling<2>(const GridSize<2>&, const NodeGrid<2>&);
template double memoryForCoupling<3>(const GridSize<3>&, const NodeGrid<3>&);

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/CouplingCost.h"

#include "Core/OptimalMap/Masses/NodeMasses.h"
#include "Core/OptimalMap/Nodes/IntegerSums.h"
#include "Core/OptimalMap/Nodes/NodePoisson.h"
#include "Core/OptimalMap/Nodes/NodeSums.h"
#include "Core/OptimalMap/Nodes/PoissonMoves.h"
#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
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
    , Size(target.Size())
    , Count(target.NumberOfCells())
    , Placement(CellPlacement<Dimension>::Filling(target.Size(), map.Grid.Cells))
    , Work(progress)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Sides[axis] = map.Grid.Spacing[axis] * this->Placement.Sides[axis];
      const double length = this->Sides[axis] * static_cast<double>(this->Size[axis]);
      this->SquaredDiagonal += length * length;
    }
  }

  double Cost(const NodeMap<Dimension>& map)
  {
    this->ShareCorrected(map);
    this->FindRest();
    this->PassToNeighbours();
    this->PassAlongCurve();
    return this->TotalCost();
  }

private:
  // What each cell got: the mass, and in the end also its first moments, with ways from the source
  // in parts of the whole grid, and its cost from there to the cell, in squared diagonals.
  static constexpr int Sums = Dimension + 2;
  const std::int64_t* Got(std::int64_t cell) const
  {
    return this->Shares.data() + cell * this->SumsACell;
  }

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
    auto corners = NodeMap<Dimension>::On({ this->Size, this->Sides });
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
        this->ShareImages<Sums>(corners);
        return;
      }
      this->ShareImages<1>(corners);
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
        const GridSize<Dimension> place = this->PlaceOf(cell);
        for (int axis = 0; axis < Dimension; ++axis)
        {
          centre[axis] = static_cast<double>(place[axis]) + 0.5;
        }
        const Point<Dimension> at = this->Placement.ToNodes(centre.data());
        part.Add(static_cast<double>(this->RestOf(cell)) / integerUnit, at.data());
      }
    });
    sums.Write(excess.data(), this->Work, [](std::int64_t, double sum) { return sum; });
  }

  // Each image of a part of a cell goes to the cells with mass about it.
  template <int Each>
  void ShareImages(const NodeMap<Dimension>& corners)
  {
    this->SumsACell = Each;
    const std::int64_t rows = ImageSamples<Dimension>::NumberOfRows(corners.Grid);
    const std::int64_t each = std::max<std::int64_t>(1, 8192 / this->Size[0]);
    const std::int64_t sums = this->Count * Each;
    this->Shares = LargeBuffer<std::int64_t>(); // before there are new ones
    IntegerSums integers(sums, this->Count * 4, this->Work);
    this->Work.For(
      rows, each,
      [&](std::int64_t first, std::int64_t last) {
        const IntegerSums::Part part(integers);
        ImageSamples<Dimension> samples(corners);
        const double scale = integerUnit * (this->Source.IsUniform() ? this->Source.Share(0) : 1.0);
        for (std::int64_t row = first; row < last; ++row)
        {
          const std::int64_t begin = row * this->Size[0];
          GridSize<Dimension> place = this->PlaceOf(begin);
          samples.ForRow(row, this->Source.data(),
            [&](const CellSample<Dimension>& sample, const Point<Dimension>& image) {
              place[0] = sample.Cell - begin;
              this->ShareImage<Each>(place, sample.Mass * scale, image, part.Values());
            });
        }
      },
      each);
    this->Shares = integers.Release(this->Work);
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
      const double most = static_cast<double>(this->Size[axis] - 1);
      const double at = std::clamp(image[axis] - 0.5, 0.0, most);
      const auto low = static_cast<std::int64_t>(at);
      const double high = at - static_cast<double>(low);
      const std::int64_t step = low + 1 < this->Size[axis] ? stride : 0;
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
      stride *= this->Size[axis];
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
            const double length = way * this->Sides[axis];
            square += length * length;
            got[1 + axis] += toInteger(share * way / static_cast<double>(this->Size[axis]));
          }
          // Rounded up.
          const double cost = share * square / this->SquaredDiagonal;
          got[1 + Dimension] += static_cast<std::int64_t>(cost) + (cost > 0.0 ? 1 : 0);
        }
      }
    }
  }

  GridSize<Dimension> PlaceOf(std::int64_t cell) const
  {
    GridSize<Dimension> place;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      place[axis] = cell % this->Size[axis];
      cell /= this->Size[axis];
    }
    return place;
  }

  std::int64_t RestOf(std::int64_t cell) const
  {
    return this->Got(cell)[0] - toInteger(this->Target.Share(cell) * integerUnit);
  }

  // What each cell got more than its share; the rest of what it got stays.
  void FindRest()
  {
    this->Rest = LargeBuffer<std::int64_t>(this->Count);
    for (std::int64_t cell = 0; cell < this->Count; ++cell)
    {
      const std::int64_t rest = this->RestOf(cell);
      this->Rest.data()[cell] = rest;
      const std::int64_t kept = this->Got(cell)[0] - std::max<std::int64_t>(rest, 0);
      if (kept > 0)
      {
        this->Sum.Add(
          this->Share(kept, cell) * static_cast<double>(this->Got(cell)[1 + Dimension]));
      }
      this->Work.Add(1);
    }
  }

  double Share(std::int64_t mass, std::int64_t cell) const
  {
    return static_cast<double>(mass) / static_cast<double>(this->Got(cell)[0]);
  }

  // From a cell that got too much to one that got too little. The mixture of what the cell got
  // goes on.
  void Pass(std::int64_t from, std::int64_t to)
  {
    const GridSize<Dimension> begin = this->PlaceOf(from);
    GridSize<Dimension> way = this->PlaceOf(to);
    std::transform(way.begin(), way.end(), begin.begin(), way.begin(), std::minus<>());
    this->Pass(from, to, way, 1.0);
  }
  // The way times `sign` leads there.
  void Pass(std::int64_t from, std::int64_t to, const GridSize<Dimension>& cells, double sign)
  {
    std::int64_t* rest = this->Rest.data();
    const std::int64_t mass = std::min(rest[from], -rest[to]);
    rest[from] -= mass;
    rest[to] += mass;
    const std::int64_t* got = this->Got(from);
    const double share = this->Share(mass, from);
    double cost = share * static_cast<double>(got[1 + Dimension]);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double scale = this->Sides[axis] * this->Sides[axis] / this->SquaredDiagonal;
      const double way = sign * static_cast<double>(cells[axis]);
      const double before = share * static_cast<double>(got[1 + axis]) *
        static_cast<double>(this->Size[axis]); // in cells
      cost += scale * way * (2.0 * before + way * static_cast<double>(mass));
    }
    this->Sum.Add(cost);
  }

  // The nearest ones first.
  void PassToNeighbours()
  {
    constexpr int reach = Dimension == 3 ? 2 : 5; // cells
    struct Offset
    {
      double Square;
      std::array<std::int64_t, 3> Cells;
    };
    std::vector<Offset> offsets;
    const std::array<std::int64_t, 3> reaches = { reach, Dimension > 1 ? reach : 0,
      Dimension > 2 ? reach : 0 };
    for (std::int64_t z = 0; z <= reaches[2]; ++z)
    {
      for (std::int64_t y = -reaches[1]; y <= reaches[1]; ++y)
      {
        for (std::int64_t x = -reaches[0]; x <= reaches[0]; ++x)
        {
          // One of two opposite ones.
          const bool isFirst = z > 0 || (z == 0 && (y > 0 || (y == 0 && x > 0)));
          if (isFirst && x * x + y * y + z * z <= reach * reach)
          {
            const std::array<std::int64_t, 3> cells = { x, y, z };
            double square = 0.0;
            for (int axis = 0; axis < Dimension; ++axis)
            {
              const double way =
                static_cast<double>(cells[static_cast<std::size_t>(axis)]) * this->Sides[axis];
              square += way * way;
            }
            offsets.push_back({ square, cells });
          }
        }
      }
    }
    std::stable_sort(offsets.begin(), offsets.end(),
      [](const Offset& a, const Offset& b) { return a.Square < b.Square; });
    for (const Offset& offset : offsets)
    {
      this->PassBy(offset.Cells);
    }
  }

  void PassBy(const std::array<std::int64_t, 3>& offset)
  {
    std::array<std::int64_t, 3> size = { 1, 1, 1 };
    std::copy(this->Size.begin(), this->Size.end(), size.begin());
    const std::int64_t step = offset[0] + size[0] * (offset[1] + size[1] * offset[2]);
    const auto begin = [&](std::size_t axis) { return std::max<std::int64_t>(0, -offset[axis]); };
    const auto end = [&](std::size_t axis) {
      return size[axis] - std::max<std::int64_t>(0, offset[axis]);
    };
    GridSize<Dimension> way;
    std::copy_n(offset.begin(), Dimension, way.begin());
    const std::int64_t* rest = this->Rest.data();
    for (std::int64_t z = begin(2); z < end(2); ++z)
    {
      for (std::int64_t y = begin(1); y < end(1); ++y)
      {
        const std::int64_t row = size[0] * (y + size[1] * z);
        for (std::int64_t cell = row + begin(0); cell < row + end(0); ++cell)
        {
          const std::int64_t other = cell + step;
          if (rest[cell] > 0 && rest[other] < 0)
          {
            this->Pass(cell, other, way, 1.0);
          }
          else if (rest[cell] < 0 && rest[other] > 0)
          {
            this->Pass(other, cell, way, -1.0);
          }
        }
        this->Work.Add(size[0]);
      }
    }
  }

  // What is left meets along Morton's curve, as brackets do.
  void PassAlongCurve()
  {
    struct Ordered
    {
      std::uint64_t Key;
      std::int64_t Cell;
    };
    std::vector<Ordered> order;
    for (std::int64_t cell = 0; cell < this->Count; ++cell)
    {
      if (this->Rest.data()[cell] != 0)
      {
        order.push_back({ this->MortonCode(cell), cell });
      }
      this->Work.Add(1);
    }
    sortByKey(order, this->Work);
    std::vector<std::int64_t> open; // all with too much or all with too little
    for (const Ordered& next : order)
    {
      std::int64_t& rest = this->Rest.data()[next.Cell];
      while (rest != 0 && !open.empty() && (this->Rest.data()[open.back()] > 0) != (rest > 0))
      {
        const std::int64_t other = open.back();
        this->Pass(rest > 0 ? next.Cell : other, rest > 0 ? other : next.Cell);
        if (this->Rest.data()[other] == 0)
        {
          open.pop_back();
        }
      }
      if (rest != 0)
      {
        open.push_back(next.Cell);
      }
      this->Work.Add(1);
    }
  }

  std::uint64_t MortonCode(std::int64_t cell) const
  {
    constexpr int bits = Dimension == 3 ? 21 : 31; // of each coordinate
    std::uint64_t code = 0;
    const GridSize<Dimension> place = this->PlaceOf(cell);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      auto rest = static_cast<std::uint64_t>(place[axis]);
      for (int bit = 0; bit < bits && rest > 0; ++bit)
      {
        code |= (rest & 1) << (bit * Dimension + axis);
        rest >>= 1;
      }
    }
    return code;
  }

  double TotalCost()
  {
    // What rounding left may have to cross the whole box.
    for (std::int64_t cell = 0; cell < this->Count; ++cell)
    {
      this->Sum.Add(std::abs(static_cast<double>(this->Rest.data()[cell])));
      this->Work.Add(1);
    }
    return this->Sum.Value() / integerUnit * this->SquaredDiagonal;
  }

  const CellDensity<Dimension>& Source;
  const CellDensity<Dimension>& Target;
  GridSize<Dimension> Size;
  std::int64_t Count;
  CellPlacement<Dimension> Placement; // of the cells on the nodes
  Point<Dimension> Sides{};           // of a cell
  double SquaredDiagonal = 0.0;       // of the box
  Progress& Work;
  LargeBuffer<std::int64_t> Shares;
  int SumsACell = 0;
  LargeBuffer<std::int64_t> Rest;
  ExactSum Sum; // of the cost, in integerUnit squared diagonals
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/PassRest.h"

#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
class Passing
{
public:
  Passing(
    const CellShares<Dimension>& shares, const CellDensity<Dimension>& target, Progress& progress)
    : Shares(shares)
    , Target(target)
    , Work(progress)
  {
  }

  double Cost()
  {
    this->FindRest();
    this->PassToNeighbours();
    this->PassAlongCurve();
    return this->TotalCost();
  }

private:
  // What each cell got more than its share; the rest of what it got stays.
  void FindRest()
  {
    this->Rest = LargeBuffer<std::int64_t>(this->Target.NumberOfCells());
    for (std::int64_t cell = 0; cell < this->Target.NumberOfCells(); ++cell)
    {
      const std::int64_t rest = this->Shares.RestOf(cell, this->Target);
      this->Rest.data()[cell] = rest;
      const std::int64_t kept = this->Shares.Got(cell)[0] - std::max<std::int64_t>(rest, 0);
      if (kept > 0)
      {
        this->Sum.Add(
          this->PartOf(kept, cell) * static_cast<double>(this->Shares.Got(cell)[1 + Dimension]));
      }
      this->Work.Add(1);
    }
  }

  double PartOf(std::int64_t mass, std::int64_t cell) const
  {
    return static_cast<double>(mass) / static_cast<double>(this->Shares.Got(cell)[0]);
  }

  // From a cell that got too much to one that got too little. The mixture of what the cell got
  // goes on.
  void Pass(std::int64_t from, std::int64_t to)
  {
    const GridSize<Dimension> begin = this->Shares.PlaceOf(from);
    GridSize<Dimension> way = this->Shares.PlaceOf(to);
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
    const std::int64_t* got = this->Shares.Got(from);
    const double share = this->PartOf(mass, from);
    double cost = share * static_cast<double>(got[1 + Dimension]);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double scale =
        this->Shares.Sides[axis] * this->Shares.Sides[axis] / this->Shares.SquaredDiagonal;
      const double way = sign * static_cast<double>(cells[axis]);
      const double before = share * static_cast<double>(got[1 + axis]) *
        static_cast<double>(this->Shares.Size[axis]); // in cells
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
              const double way = static_cast<double>(cells[static_cast<std::size_t>(axis)]) *
                this->Shares.Sides[axis];
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
    std::copy(this->Shares.Size.begin(), this->Shares.Size.end(), size.begin());
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
    for (std::int64_t cell = 0; cell < this->Target.NumberOfCells(); ++cell)
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
    const GridSize<Dimension> place = this->Shares.PlaceOf(cell);
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
    for (std::int64_t cell = 0; cell < this->Target.NumberOfCells(); ++cell)
    {
      this->Sum.Add(std::abs(static_cast<double>(this->Rest.data()[cell])));
      this->Work.Add(1);
    }
    return this->Sum.Value() / integerUnit * this->Shares.SquaredDiagonal;
  }

  const CellShares<Dimension>& Shares;
  const CellDensity<Dimension>& Target;
  Progress& Work;
  LargeBuffer<std::int64_t> Rest;
  ExactSum Sum; // of the cost, in integerUnit squared diagonals
};

} // namespace

template <int Dimension>
double passRest(
  const CellShares<Dimension>& shares, const CellDensity<Dimension>& target, Progress& progress)
{
  return Passing<Dimension>(shares, target, progress).Cost();
}

template double passRest<1>(const CellShares<1>&, const CellDensity<1>&, Progress&);
template double passRest<2>(const CellShares<2>&, const CellDensity<2>&, Progress&);
template double passRest<3>(const CellShares<3>&, const CellDensity<3>&, Progress&);

} // namespace RectifiedTransport

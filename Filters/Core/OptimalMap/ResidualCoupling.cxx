// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/ResidualCoupling.h"

#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/KeySort.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Completes a coupling: moves what cells got beyond their shares to cells that lack mass, and keeps
// the sum of what all that costs.
template <int Dimension>
class ResidualCoupling
{
public:
  ResidualCoupling(
    const CellShares<Dimension>& shares, const CellDensity<Dimension>& target, Progress& progress)
    : Shares(shares)
    , Target(target)
    , Work(progress)
  {
  }

  // Greedy: excess first goes to the nearest cells that lack mass; what is left meets along a curve
  // that keeps neighbours together.
  double Cost()
  {
    this->FindResidual();
    this->SendToNeighbours();
    this->SendAlongCurve();
    return this->TotalCost();
  }

private:
  // How much mass each cell got beyond its share, in parts of integerUnit; negative where it lacks
  // some.
  void FindResidual()
  {
    this->Residual = LargeBuffer<std::int64_t>(this->Target.NumberOfCells());
    this->ForCells([this](std::int64_t cell) {
      this->Residual.data()[cell] = this->Shares.ResidualOf(cell, this->Target);
    });
    this->Sum.Add(static_cast<double>(this->Shares.Cost));
  }

  // Calls visit(cell) for all cells, in order.
  template <class Visit>
  void ForCells(const Visit& visit)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
    this->Work.ForEachInOrder(this->Target.NumberOfCells(), grain, visit);
  }

  // Which part of all that a cell got a mass is.
  double PartOf(std::int64_t mass, std::int64_t cell) const
  {
    return static_cast<double>(mass) / static_cast<double>(this->Shares.Got(cell)[0]);
  }

  // Passes mass from a cell that got too much to one that lacks some. What goes on is a mixture of
  // all that the cell got, in the same proportions.
  void Send(std::int64_t from, std::int64_t to)
  {
    const GridSize<Dimension> begin = this->Shares.PlaceOf(from);
    GridSize<Dimension> shift = this->Shares.PlaceOf(to);
    std::transform(shift.begin(), shift.end(), begin.begin(), shift.begin(), std::minus<>());
    this->Send(from, to, shift, 1.0);
  }
  // The same, where the displacement from `from` to `to` is `cells` times `sign`.
  void Send(std::int64_t from, std::int64_t to, const GridSize<Dimension>& cells, double sign)
  {
    std::int64_t* residual = this->Residual.data();
    const std::int64_t mass = std::min(residual[from], -residual[to]);
    residual[from] -= mass;
    residual[to] += mass;
    const std::int64_t* got = this->Shares.Got(from);
    const double share = this->PartOf(mass, from);
    // A mass m that came by w and goes on by d has moved by w + d, which costs m (|w + d|^2 -
    // |w|^2) = 2 d . (m w) + m |d|^2 more. The first moment m w is what the cell got, in
    // proportion.
    double cost = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double scale =
        this->Shares.Sides[axis] * this->Shares.Sides[axis] / this->Shares.SquaredDiagonal;
      const double shift = sign * static_cast<double>(cells[axis]);
      // The first moment of the mass that goes on, in cells.
      const double before =
        share * static_cast<double>(got[1 + axis]) * static_cast<double>(this->Shares.Size[axis]);
      cost += scale * shift * (2.0 * before + shift * static_cast<double>(mass));
    }
    this->Sum.Add(cost);
  }

  // Passes mass to neighbours within reach, the nearest ones first. Pairs nearer than that are the
  // most; farther ones are left to the curve, as the number of offsets grows with reach^Dimension.
  void SendToNeighbours()
  {
    constexpr int reach = Dimension == 3 ? 2 : 5; // cells
    struct Offset
    {
      double Square;
      GridSize<Dimension> Cells;
    };
    LatticePart<Dimension> about;
    about.Low.fill(-reach);
    about.Cells.fill(2 * reach + 1);
    std::vector<Offset> offsets;
    // One of each two opposite offsets: SendEach looks both ways.
    for (std::int64_t i = about.Count() / 2 + 1; i < about.Count(); ++i)
    {
      Offset offset{ 0.0, about.CellOf(i) };
      std::int64_t cells = 0;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const std::int64_t shift = offset.Cells[axis];
        const double length = static_cast<double>(shift) * this->Shares.Sides[axis];
        cells += shift * shift;
        offset.Square += length * length;
      }
      if (cells <= reach * reach)
      {
        offsets.push_back(offset);
      }
    }
    std::stable_sort(offsets.begin(), offsets.end(),
      [](const Offset& a, const Offset& b) { return a.Square < b.Square; });
    for (const Offset& offset : offsets)
    {
      this->SendBy(offset.Cells);
    }
  }
  // Passes mass between all cells and their neighbours at one offset.
  void SendBy(const GridSize<Dimension>& shift)
  {
    const auto whole = LatticePart<Dimension>::WholeOf(this->Shares.Size);
    auto reached = whole;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      reached.Low[axis] = -shift[axis];
    }
    reached = reached.And(whole); // the cells whose neighbour is in the grid
    const std::int64_t row = reached.Cells[0];
    const std::int64_t step = whole.NumberOf(shift);
    for (std::int64_t i = 0; !reached.IsEmpty() && i < reached.Count(); i += row)
    {
      const std::int64_t first = whole.NumberOf(reached.CellOf(i));
      this->SendInRow(first, first + row, step, shift);
      this->Work.Add(this->Shares.Size[0]);
    }
  }
  // Passes mass between cells [first, last) of a row and those `step` farther on.
  void SendInRow(
    std::int64_t first, std::int64_t last, std::int64_t step, const GridSize<Dimension>& shift)
  {
    // Few pairs have one cell with too much and one with too little. Eight pairs at a time are
    // tested for it by the signs' exclusive or, which the compiler turns into vectors.
    constexpr std::int64_t atOnce = 8;
    const std::int64_t* residual = this->Residual.data();
    for (; first + atOnce <= last; first += atOnce)
    {
      std::int64_t signs = 0; // The sign bit is set if any pair's signs differ.
      for (std::int64_t i = 0; i < atOnce; ++i)
      {
        signs |= residual[first + i] ^ residual[first + i + step];
      }
      if (signs < 0)
      {
        this->SendEach(first, first + atOnce, step, shift);
      }
    }
    this->SendEach(first, last, step, shift);
  }

  // Passes mass in the pairs whose signs differ.
  void SendEach(
    std::int64_t first, std::int64_t last, std::int64_t step, const GridSize<Dimension>& shift)
  {
    const std::int64_t* residual = this->Residual.data();
    for (std::int64_t cell = first; cell < last; ++cell)
    {
      const std::int64_t other = cell + step;
      if (residual[cell] > 0 && residual[other] < 0)
      {
        this->Send(cell, other, shift, 1.0);
      }
      else if (residual[cell] < 0 && residual[other] > 0)
      {
        this->Send(other, cell, shift, -1.0);
      }
    }
  }

  // Matches what is left along Morton's curve with a stack, as brackets match: a cell that lacks
  // mass takes it from the nearest open one before it, and the other way round. Each cell enters
  // the stack once, so that the time is linear.
  void SendAlongCurve()
  {
    struct Ordered
    {
      std::uint64_t Key;
      std::int64_t Cell;
    };
    std::vector<Ordered> order;
    this->ForCells([&](std::int64_t cell) {
      if (this->Residual.data()[cell] != 0)
      {
        order.push_back({ this->MortonCode(cell), cell });
      }
    });
    sortByKey(order, this->Work);
    std::vector<std::int64_t> open; // all with too much, or all with too little
    for (const Ordered& next : order)
    {
      std::int64_t& residual = this->Residual.data()[next.Cell];
      while (residual != 0 && !open.empty() &&
        (this->Residual.data()[open.back()] > 0) != (residual > 0))
      {
        const std::int64_t other = open.back();
        this->Send(residual > 0 ? next.Cell : other, residual > 0 ? other : next.Cell);
        if (this->Residual.data()[other] == 0)
        {
          open.pop_back();
        }
      }
      if (residual != 0)
      {
        open.push_back(next.Cell);
      }
      this->Work.Add(1);
    }
  }

  // Interleaves the bits of a cell's coordinates, axis 0 in the lowest ones.
  std::uint64_t MortonCode(std::int64_t cell) const
  {
    constexpr int bits = Dimension == 3 ? 21 : 31; // bits a coordinate: 3 * 21 = 63 fit the code
    std::uint64_t code = 0;
    const GridSize<Dimension> place = this->Shares.PlaceOf(cell);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      auto coordinate = static_cast<std::uint64_t>(place[axis]);
      for (int bit = 0; bit < bits && coordinate > 0; ++bit)
      {
        code |= (coordinate & 1) << (bit * Dimension + axis);
        coordinate >>= 1;
      }
    }
    return code;
  }

  // The cost of the completed coupling, in squared lengths; never less than the true one.
  double TotalCost()
  {
    // Sums of rounded shares need not agree. What cannot be passed on counts as if it had to cross
    // the whole box, whose squared diagonal is 1 here.
    this->ForCells([this](std::int64_t cell) {
      if (this->Residual.data()[cell] != 0)
      {
        this->Sum.Add(std::abs(static_cast<double>(this->Residual.data()[cell])));
      }
    });
    return this->Sum.Value() / integerUnit * this->Shares.SquaredDiagonal;
  }

  const CellShares<Dimension>& Shares;
  const CellDensity<Dimension>& Target;
  Progress& Work;
  LargeBuffer<std::int64_t> Residual;
  ExactSum Sum; // the cost, in squared diagonals over integerUnit
};

} // namespace

template <int Dimension>
double coupleResidual(
  const CellShares<Dimension>& shares, const CellDensity<Dimension>& target, Progress& progress)
{
  return ResidualCoupling<Dimension>(shares, target, progress).Cost();
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(coupleResidual);

} // namespace RectifiedTransport

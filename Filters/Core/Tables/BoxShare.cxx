// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/BoxShare.h"

#include "Core/Geometry/ReproducibleMath.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// A side of a box on one axis: the node below and the place between it and the next, in [0, 1].
struct Side
{
  std::int64_t Node;
  double Place;
};

template <int Dimension>
Side findSide(const TableView<Dimension>& tables, int axis, double x)
{
  const double high = tables.High[axis];
  const double clipped = std::clamp(x, tables.Low[axis], high);
  const std::int64_t cell =
    std::min(static_cast<std::int64_t>(clipped), static_cast<std::int64_t>(high) - 1);
  if (!tables.IsUneven)
  {
    return { cell, clipped - static_cast<double>(cell) };
  }
  const auto& uneven = tables.Uneven[axis];
  const std::int64_t node = uneven.NodeBelow[cell];
  const double below = uneven.Places[node];
  return { node, (clipped - below) / (uneven.Places[node + 1] - below) };
}

template <int Dimension>
const typename TableView<Dimension>::Level& finestLevel(const TableView<Dimension>& tables)
{
  return tables.Levels[tables.IsUneven ? 1 : 0];
}

// The sum of the density over [low, high] on the axes from `Axis` down; `nodes` includes the
// offsets of the axes above (paper, Section 3.3; Algorithm 1, for the mass alone).
template <int Dimension, int Axis>
double sumBox(
  const std::int64_t (&strides)[Dimension], const Side (&sides)[Dimension][2], const double* nodes)
{
  const std::int64_t stride = strides[Axis];
  double ends[2];
  for (int end = 0; end < 2; ++end)
  {
    const Side& side = sides[Axis][end];
    const double* at = nodes + side.Node * stride;
    double below = 0.0;
    double above = 0.0;
    if constexpr (Axis == 0)
    {
      below = at[0];
      above = at[stride];
    }
    else
    {
      below = sumBox<Dimension, Axis - 1>(strides, sides, at);
      above = sumBox<Dimension, Axis - 1>(strides, sides, at + stride);
    }
    ends[end] = below + side.Place * (above - below);
  }
  return ends[1] - ends[0];
}

// As the tables are scaled.
template <int Dimension>
double sumIn(
  const TableView<Dimension>& tables, const Point<Dimension>& low, const Point<Dimension>& high)
{
  Side sides[Dimension][2];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    sides[axis][0] = findSide(tables, axis, low[axis]);
    sides[axis][1] = findSide(tables, axis, high[axis]);
  }
  const auto& level = finestLevel(tables);
  return std::max(sumBox<Dimension, Dimension - 1>(level.Stride, sides, level.Nodes), 0.0);
}

// What tables of the whole domain sum up to.
template <int Dimension>
double sumOfAll(const TableView<Dimension>& tables)
{
  const auto& level = finestLevel(tables);
  std::int64_t last = 0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    last += (findSide(tables, axis, tables.High[axis]).Node + 1) * level.Stride[axis];
  }
  return level.Nodes[last];
}

// The boxes with half the sides h * aspect about a point.
template <int Dimension>
class GrowingBox
{
public:
  GrowingBox(const Point<Dimension>& centre, const Point<Dimension>& aspect, double share)
    : Centre(centre)
    , Aspect(aspect)
    , Wanted(root<Dimension>(share))
  {
  }

  // How much the root of the share of the mass is above what is wanted. It is nearly linear in h.
  double Excess(const TableView<Dimension>& tables, double all, double h) const
  {
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      low[axis] = this->Centre[axis] - h * this->Aspect[axis];
      high[axis] = this->Centre[axis] + h * this->Aspect[axis];
    }
    return root<Dimension>(sumIn<Dimension>(tables, low, high) / all) - this->Wanted;
  }

  double Measure(const TableView<Dimension>& tables, double h) const
  {
    double measure = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double size = tables.Size[axis];
      measure *= std::clamp(this->Centre[axis] + h * this->Aspect[axis], 0.0, size) -
        std::clamp(this->Centre[axis] - h * this->Aspect[axis], 0.0, size);
    }
    return measure;
  }

  // Sizes of a box that is too small and one that is not.
  struct Bracket
  {
    double Below;
    double ExcessBelow;
    double Above;
    double ExcessAbove;
  };

  // The bracket of an empty box and the whole domain.
  Bracket All(const TableView<Dimension>& tables) const
  {
    double largest = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double x = this->Centre[axis];
      largest = std::max(largest, std::max(x, tables.Size[axis] - x) / this->Aspect[axis]);
    }
    return { 0.0, -this->Wanted, largest, 1.0 - this->Wanted };
  }

  // The size up to which no side is in the domain but beyond the tables.
  double Reach(const TableView<Dimension>& tables) const
  {
    double reach = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double low = tables.Low[axis];
      const double high = tables.High[axis];
      if (low > 0.0)
      {
        reach = std::min(reach, (this->Centre[axis] - low) / this->Aspect[axis]);
      }
      if (high < tables.Size[axis])
      {
        reach = std::min(reach, (high - this->Centre[axis]) / this->Aspect[axis]);
      }
    }
    return reach;
  }

  // By false position, with a bisection in every third step, as the share may be constant where
  // there is no mass.
  double FindSize(const TableView<Dimension>& tables, double all, Bracket bracket) const
  {
    auto& [below, excessBelow, above, excessAbove] = bracket;
    constexpr double precision = 1e-9;
    for (int step = 0; above - below > precision * above && step < 200; ++step)
    {
      double h = 0.5 * (below + above);
      if (step % 3 != 2 && excessAbove > excessBelow)
      {
        const double slope = (excessAbove - excessBelow) / (above - below);
        // Shifted to either side in turn, so that both ends converge.
        const double guess = below - excessBelow / slope;
        const double aside = (step % 3 == 0 ? 1.0 : -1.0) * 0.25 * precision * above;
        h = std::clamp(guess + aside, below, above);
      }
      const double found = this->Excess(tables, all, h);
      (found >= 0.0 ? above : below) = h;
      (found >= 0.0 ? excessAbove : excessBelow) = found;
    }
    return above;
  }

private:
  const Point<Dimension>& Centre;
  const Point<Dimension>& Aspect;
  const double Wanted;
};

} // namespace

template <int Dimension>
double boxShare(
  const TableView<Dimension>& tables, const Point<Dimension>& low, const Point<Dimension>& high)
{
  return sumIn<Dimension>(tables, low, high) / sumOfAll(tables);
}

template <int Dimension>
double measureOfShare(const TableView<Dimension>& tables, const Point<Dimension>& centre,
  const Point<Dimension>& aspect, double share)
{
  if (!(share > 0.0))
  {
    return 0.0;
  }
  const GrowingBox<Dimension> box(centre, aspect, share);
  const auto bracket = box.All(tables);
  const double size =
    share >= 1.0 ? bracket.Above : box.FindSize(tables, sumOfAll(tables), bracket);
  return box.Measure(tables, size);
}

template <int Dimension>
double measureOfShare(const TableView<Dimension>& graded, const TableView<Dimension>& tile,
  const Point<Dimension>& centre, const Point<Dimension>& aspect, double share)
{
  if (!(share > 0.0) || share >= 1.0)
  {
    return measureOfShare<Dimension>(graded, centre, aspect, share);
  }
  const double all = sumOfAll(graded);
  const GrowingBox<Dimension> box(centre, aspect, share);
  auto bracket = box.All(graded);
  const double reach = box.Reach(tile);
  bool endsInTile = true;
  if (reach < bracket.Above)
  {
    const double excess = box.Excess(tile, all, reach);
    endsInTile = excess >= 0.0;
    (endsInTile ? bracket.Above : bracket.Below) = reach;
    (endsInTile ? bracket.ExcessAbove : bracket.ExcessBelow) = excess;
  }
  return box.Measure(graded, box.FindSize(endsInTile ? tile : graded, all, bracket));
}

template double boxShare<1>(const TableView<1>&, const Point<1>&, const Point<1>&);
template double boxShare<2>(const TableView<2>&, const Point<2>&, const Point<2>&);
template double boxShare<3>(const TableView<3>&, const Point<3>&, const Point<3>&);
template double measureOfShare<1>(const TableView<1>&, const Point<1>&, const Point<1>&, double);
template double measureOfShare<2>(const TableView<2>&, const Point<2>&, const Point<2>&, double);
template double measureOfShare<3>(const TableView<3>&, const Point<3>&, const Point<3>&, double);
template double measureOfShare<2>(
  const TableView<2>&, const TableView<2>&, const Point<2>&, const Point<2>&, double);
template double measureOfShare<3>(
  const TableView<3>&, const TableView<3>&, const Point<3>&, const Point<3>&, double);

} // namespace RectifiedTransport

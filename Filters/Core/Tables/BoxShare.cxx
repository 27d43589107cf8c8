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
  // A side beyond the tables is clipped to them; a side at the upper face belongs to the last cell.
  const double high = tables.High[axis];
  const double clipped = std::clamp(x, tables.Low[axis], high);
  const std::int64_t cell =
    std::min(static_cast<std::int64_t>(clipped), static_cast<std::int64_t>(high) - 1);
  if (!tables.IsUneven)
  {
    return { cell, clipped - static_cast<double>(cell) };
  }
  // On graded tables, r is relative to the width of the cell between its two nodes.
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

// Returns the sum of the density over [low, high] on the axes from `Axis` down; `nodes` includes
// the offsets of the axes above (paper, Section 3.3; Algorithm 1, for the mass alone). Each axis
// applies L(high) - L(low) with L[F] = (1 - r) F_i + r F_{i+1} to the sums of the axes below it, so
// that the tensor product needs no signs of corners.
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

// Returns the sum over a box in the units of the tables. Rounding may make the sum over an empty
// box negative, so it is at least 0.
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

// Returns the sum of all cells, which is the record at the last node of tables of the whole domain.
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

// The boxes about a point whose half sides are h * aspect.
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

  // Returns root(share in the box) - root(wanted share). With the D-th root, the function of h is
  // linear for a uniform density, so that false position converges in few steps.
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

  // Returns the measure of the box in the domain, in grid cells.
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

  // A size with a negative excess and one with a non-negative excess, which bracket the solution.
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
    // From the centre to the face that is farthest in units of the aspect, the box covers the
    // domain.
    double largest = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double x = this->Centre[axis];
      largest = std::max(largest, std::max(x, tables.Size[axis] - x) / this->Aspect[axis]);
    }
    return { 0.0, -this->Wanted, largest, 1.0 - this->Wanted };
  }

  // Returns the largest size for which every side is in the tables or beyond the domain, where the
  // tables of a tile give the same sums as those of the whole.
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

  // Regula falsi with a bisection in every third step: where there is no mass the share is
  // constant, and secants alone would hardly shorten the bracket.
  double FindSize(const TableView<Dimension>& tables, double all, Bracket bracket) const
  {
    auto& [below, excessBelow, above, excessAbove] = bracket;
    // The relative precision of h, far above the rounding of the sums, so that the function is
    // monotonous at this scale. The number of steps is bounded in any case.
    constexpr double precision = 1e-9;
    for (int step = 0; above - below > precision * above && step < 200; ++step)
    {
      double h = 0.5 * (below + above);
      if (step % 3 != 2 && excessAbove > excessBelow)
      {
        const double slope = (excessAbove - excessBelow) / (above - below);
        // The secant's root, shifted to either side in turn by a quarter of the precision, so that
        // both ends of the bracket converge to it.
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
  // If the largest box within the tile already holds the share, the solution is in the tile.
  // Otherwise its size is the lower end for a search in the graded tables.
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

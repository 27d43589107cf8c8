// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/BoxShare.h"

#include "Core/Geometry/ReproducibleMath.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// A side of a box on one axis: the node below and the place in the grid cell above it, in [0, 1].
struct Side
{
  std::int64_t Node;
  double Place;
};

Side findSide(double x, std::int64_t cells)
{
  const double clipped = std::clamp(x, 0.0, static_cast<double>(cells));
  const std::int64_t node = std::min(static_cast<std::int64_t>(clipped), cells - 1);
  return { node, clipped - static_cast<double>(node) };
}

// The sum of the density over [low, high] on the axes from `Axis` down; `nodes` includes the
// offsets of the axes above (paper, Section 3.3; Algorithm 1, for the mass alone).
template <int Dimension, int Axis>
double sumBox(
  const TableView<Dimension>& tables, const Side (&sides)[Dimension][2], const double* nodes)
{
  const std::int64_t stride = tables.Levels[0].Stride[Axis];
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
      below = sumBox<Dimension, Axis - 1>(tables, sides, at);
      above = sumBox<Dimension, Axis - 1>(tables, sides, at + stride);
    }
    ends[end] = below + side.Place * (above - below);
  }
  return ends[1] - ends[0];
}

// The boxes with half the sides h * aspect about a point.
template <int Dimension>
class GrowingBox
{
public:
  GrowingBox(const TableView<Dimension>& tables, const Point<Dimension>& centre,
    const Point<Dimension>& aspect)
    : Tables(tables)
    , Centre(centre)
    , Aspect(aspect)
  {
  }

  double Share(double h) const
  {
    Point<Dimension> low;
    Point<Dimension> high;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      low[axis] = this->Centre[axis] - h * this->Aspect[axis];
      high[axis] = this->Centre[axis] + h * this->Aspect[axis];
    }
    return boxShare<Dimension>(this->Tables, low, high);
  }

  double Measure(double h) const
  {
    double measure = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double size = this->Tables.Size[axis];
      measure *= std::clamp(this->Centre[axis] + h * this->Aspect[axis], 0.0, size) -
        std::clamp(this->Centre[axis] - h * this->Aspect[axis], 0.0, size);
    }
    return measure;
  }

  // The size at which the box is the whole domain.
  double Largest() const
  {
    double largest = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double x = this->Centre[axis];
      largest = std::max(largest, std::max(x, this->Tables.Size[axis] - x) / this->Aspect[axis]);
    }
    return largest;
  }

private:
  const TableView<Dimension>& Tables;
  const Point<Dimension>& Centre;
  const Point<Dimension>& Aspect;
};

} // namespace

template <int Dimension>
double boxShare(
  const TableView<Dimension>& tables, const Point<Dimension>& low, const Point<Dimension>& high)
{
  Side sides[Dimension][2];
  std::int64_t last = 0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    sides[axis][0] = findSide(low[axis], tables.Cells[axis]);
    sides[axis][1] = findSide(high[axis], tables.Cells[axis]);
    last += tables.Cells[axis] * tables.Levels[0].Stride[axis];
  }
  const double* nodes = tables.Levels[0].Nodes;
  return std::max(sumBox<Dimension, Dimension - 1>(tables, sides, nodes), 0.0) / nodes[last];
}

template <int Dimension>
double measureOfShare(const TableView<Dimension>& tables, const Point<Dimension>& centre,
  const Point<Dimension>& aspect, double share)
{
  const GrowingBox<Dimension> box(tables, centre, aspect);
  double above = box.Largest();
  if (!(share > 0.0))
  {
    return 0.0;
  }
  if (share >= 1.0)
  {
    return box.Measure(above);
  }
  // The root of the share is nearly linear in the size. False position, with a bisection in every
  // third step, as the share may be constant where there is no mass.
  const double wanted = root<Dimension>(share);
  const auto excess = [&](double h) { return root<Dimension>(box.Share(h)) - wanted; };
  double below = 0.0;
  double excessBelow = -wanted;
  double excessAbove = 1.0 - wanted;
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
    const double found = excess(h);
    (found >= 0.0 ? above : below) = h;
    (found >= 0.0 ? excessAbove : excessBelow) = found;
  }
  return box.Measure(above);
}

template double boxShare<1>(const TableView<1>&, const Point<1>&, const Point<1>&);
template double boxShare<2>(const TableView<2>&, const Point<2>&, const Point<2>&);
template double boxShare<3>(const TableView<3>&, const Point<3>&, const Point<3>&);
template double measureOfShare<1>(const TableView<1>&, const Point<1>&, const Point<1>&, double);
template double measureOfShare<2>(const TableView<2>&, const Point<2>&, const Point<2>&, double);
template double measureOfShare<3>(const TableView<3>&, const Point<3>&, const Point<3>&, double);

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "BoxShare.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// The sum of the density below a point: the mass of the nodes around it, interpolated.
template <int Dimension>
double massBelow(const TableView<Dimension>& tables, const Point<Dimension>& point)
{
  const auto& level = tables.Levels[0];
  const double* node = level.Nodes;
  double weight[Dimension];
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double x = std::max(0.0, std::min(point[axis], tables.Size[axis]));
    const auto cell = std::min(static_cast<std::int64_t>(x), tables.Cells[axis] - 1);
    weight[axis] = x - static_cast<double>(cell);
    node += cell * level.Stride[axis];
  }
  double sum = 0.0;
  for (int corner = 0; corner < 1 << Dimension; ++corner)
  {
    double part = 1.0;
    std::int64_t offset = 0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const bool upper = (corner >> axis & 1) != 0;
      part *= upper ? weight[axis] : 1.0 - weight[axis];
      offset += upper ? level.Stride[axis] : 0;
    }
    sum += part * node[offset];
  }
  return sum;
}

} // namespace

template <int Dimension>
double boxShare(
  const TableView<Dimension>& tables, const Point<Dimension>& low, const Point<Dimension>& high)
{
  Point<Dimension> last;
  std::copy_n(tables.Size, Dimension, last.begin());
  double sum = 0.0;
  for (int corner = 0; corner < 1 << Dimension; ++corner)
  {
    Point<Dimension> point;
    double sign = 1.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const bool upper = (corner >> axis & 1) != 0;
      point[axis] = upper ? high[axis] : low[axis];
      sign = upper ? sign : -sign;
    }
    sum += sign * massBelow<Dimension>(tables, point);
  }
  return std::max(0.0, std::min(sum / massBelow<Dimension>(tables, last), 1.0));
}

template double boxShare<1>(const TableView<1>&, const Point<1>&, const Point<1>&);
template double boxShare<2>(const TableView<2>&, const Point<2>&, const Point<2>&);
template double boxShare<3>(const TableView<3>&, const Point<3>&, const Point<3>&);

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/RelaxationFrame.h"

#include "Core/Geometry/ReproducibleMath.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// Sides in proportion below this are thin beyond all counts of points, and have too few digits.
constexpr double thinnest = 1e-15;

} // namespace

template <int Dimension>
RelaxationFrame<Dimension>::RelaxationFrame(
  const GridSize<Dimension>& size, const Point<Dimension>& spacing, std::int64_t points)
{
  double largest = 0.0;
  for (const double side : spacing)
  {
    if (!(side > 0.0) || std::isinf(side))
    {
      throw std::invalid_argument(
        "a spacing is " + std::to_string(side) + ", it must be positive and finite");
    }
    largest = std::max(largest, side);
  }
  // The unit is the mean spacing: the side of a cube with the measure of the domain for each point,
  // where axes thinner than that side are covered completely.
  double measure = 1.0 / static_cast<double>(std::max<std::int64_t>(points, 1));
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Sides relative to the longest one, so that their product neither overflows nor vanishes.
    this->CellSides[axis] = std::max(spacing[axis] / largest, thinnest);
    this->Sides[axis] = this->CellSides[axis] * static_cast<double>(size[axis]);
    measure *= this->Sides[axis];
  }
  const double unit = this->SideOf(measure);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    this->CellSides[axis] /= unit;
    this->Sides[axis] = this->CellSides[axis] * static_cast<double>(size[axis]);
  }
}

template <int Dimension>
double RelaxationFrame<Dimension>::SideOf(double measure) const
{
  // Finds the side s with the product over axes of min(s, side of the domain) = measure: while s
  // passes the shortest side, that axis is divided out and the root has one degree less.
  Point<Dimension> sides = this->Sides;
  std::sort(sides.begin(), sides.end());
  if (!(root<Dimension>(measure) > sides[0]))
  {
    return root<Dimension>(measure);
  }
  measure /= sides[0];
  if constexpr (Dimension == 3)
  {
    if (!(std::sqrt(measure) > sides[1]))
    {
      return std::sqrt(measure);
    }
    measure /= sides[1];
  }
  return measure;
}

template <int Dimension>
double RelaxationFrame<Dimension>::SideOfCells(double cells) const
{
  for (const double side : this->CellSides)
  {
    cells *= side;
  }
  return this->SideOf(cells);
}

template struct RelaxationFrame<2>;
template struct RelaxationFrame<3>;

} // namespace RectifiedTransport

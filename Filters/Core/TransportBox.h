// SPDX-License-Identifier: BSD-3-Clause
// Boxes, cells and points of Transport.h.
#ifndef RectifiedTransport_TransportBox_h
#define RectifiedTransport_TransportBox_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Parallel/Progress.h"
#include "Core/Plan/TransportPlan.h"
#include "Core/Transport.h"

#include <cstdint>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace RectifiedTransport
{

// The sides of a cell, in lengths.
template <int D>
Point<D> cellSides(const BoxDensity<D>& density)
{
  Point<D> sides = density.Sides();
  for (int axis = 0; axis < D; ++axis)
  {
    sides[axis] /= static_cast<double>(density.Cells()[axis]);
  }
  return sides;
}

// The measure of a cell: a value times this is a mass.
template <int D>
double cellMeasure(const BoxDensity<D>& density)
{
  const Point<D> sides = cellSides(density);
  return std::accumulate(sides.begin(), sides.end(), 1.0, std::multiplies<>());
}

// Returns the grid of cells that fills the box [0, sides].
template <int D>
ImageGrid gridOf(const GridSize<D>& cells, const Point<D>& sides)
{
  std::array<int, 6> extent{};
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();
  for (int axis = 0; axis < D; ++axis)
  {
    extent[static_cast<std::size_t>(2 * axis + 1)] = static_cast<int>(cells[axis]);
    spacing[axis] = sides[axis] / static_cast<double>(cells[axis]);
  }
  return { extent, Eigen::Vector3d::Zero(), spacing, ImageGrid::Matrix::Identity(), false };
}

// Multiplies the coordinates along each axis.
template <int D>
void scalePoints(const Point<D>& factors, PointSpan<D> points, Progress& progress)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  progress.ForEach(points.size(), grain, [=](std::int64_t i) {
    for (int axis = 0; axis < D; ++axis)
    {
      points[i][axis] *= factors[axis];
    }
  });
}

template <int D>
void requireSameBox(const BoxDensity<D>& a, const BoxDensity<D>& b)
{
  if (a.Sides() != b.Sides())
  {
    throw std::invalid_argument("the boxes of the densities differ; they must have the same sides");
  }
}

// The end of a plan at a density on the box [0, sides].
template <int D>
PlanEnd<D> planEnd(const BoxDensity<D>& density)
{
  return PlanEnd<D>(PlacedDensity<D>{ density.Source(), {}, density.Sides() });
}

} // namespace RectifiedTransport

#endif

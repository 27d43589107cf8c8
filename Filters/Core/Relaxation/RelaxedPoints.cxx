// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/RelaxedPoints.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Polls.h"
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/NeighbourTree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

void check(const RelaxationOptions& options)
{
  if (options.MaximumIterations < 0)
  {
    throw std::invalid_argument("MaximumIterations is " +
      std::to_string(options.MaximumIterations) + ", it must be 0 or more");
  }
  if (!(options.Tolerance >= 0.0 && options.Tolerance < 1.0))
  {
    throw std::invalid_argument(
      "Tolerance is " + std::to_string(options.Tolerance) + ", it must be at least 0 and below 1");
  }
}

template <int Dimension>
RelaxedPoints<Dimension>::RelaxedPoints(
  ConstPointSpan<Dimension> points, const RelaxationFrame<Dimension>& frame)
  : Frame(frame)
  , X(static_cast<std::size_t>(points.size()) * Dimension)
{
  for (std::size_t i = 0; i < this->X.size(); ++i)
  {
    // From index space to the frame, and into the domain.
    const double index = points.data()[i];
    if (!std::isfinite(index))
    {
      throw std::invalid_argument("point " + std::to_string(i / Dimension) + " is not finite");
    }
    const std::size_t axis = i % Dimension;
    this->X[i] = std::clamp(index * this->Frame.CellSides[axis], 0.0, this->Frame.Sides[axis]);
  }
  this->Given = this->X;
}

// Coordinates are interleaved, Dimension a point, in lengths of the frame.
template <int Dimension>
Point<Dimension> RelaxedPoints<Dimension>::At(std::int64_t point) const
{
  return pointAt<Dimension>(this->X.data() + point * Dimension);
}

// Coincident points have the gradient 0 with respect to each other and would stay together for
// ever.
template <int Dimension>
void RelaxedPoints<Dimension>::Separate(
  const std::function<double(const Point<Dimension>&)>& spacing, Progress& progress)
{
  // The displacement of coincident points, in spacings: far above rounding, and too small to change
  // what the energy sees of the density.
  constexpr double part = 1.0 / 64;
  // Sorted by coordinates, coincident points are neighbours. `ordinal` numbers them in a place; it
  // alone chooses the displacement, so that the result does not depend on the order of the points.
  std::vector<std::int64_t> order(static_cast<std::size_t>(this->Size()));
  std::iota(order.begin(), order.end(), 0);
  Polls polls(progress);
  std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
    polls.Count();
    const auto first = this->At(a);
    const auto second = this->At(b);
    return first < second || (first == second && a < b);
  });
  std::uint64_t ordinal = 0;
  Point<Dimension> last{};
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const Point<Dimension> x = this->At(order[i]);
    ordinal = i > 0 && x == last ? ordinal + 1 : 0;
    last = x;
    if (ordinal > 0)
    {
      this->MoveAside(order[i], part * spacing(x), ordinal);
    }
  }
}

template <int Dimension>
void RelaxedPoints<Dimension>::MoveAside(std::int64_t point, double distance, std::uint64_t ordinal)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // A random word for each axis and ordinal gives a displacement in [-distance, distance].
    const auto stream = static_cast<std::uint64_t>(axis);
    const double aside = distance * (2.0 * unitReal(randomWord(stream, ordinal)) - 1.0);
    const double side = this->Frame.Sides[axis];
    double& x = this->X[static_cast<std::size_t>(point * Dimension + axis)];
    // A displacement that leads out of the domain is mirrored. Clamping would put several points
    // into the same place.
    x = std::clamp(x + (x + aside < 0.0 || x + aside > side ? -aside : aside), 0.0, side);
  }
}

// Points in the order of a NeighbourTree are near each other in memory. All spacings are 1: the
// tree then divides by position alone.
template <int Dimension>
void RelaxedPoints<Dimension>::Arrange(Progress& progress)
{
  std::vector<ScaledPoint<Dimension>> points(static_cast<std::size_t>(this->Size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = scaledPoint<Dimension>(this->At(static_cast<std::int64_t>(i)), 1.0, 1.0);
  }
  NeighbourTree<Dimension> sorted;
  sorted.Build(points, progress);
  this->Order.assign(sorted.Order(), sorted.Order() + sorted.Size());
  for (std::int64_t i = 0; i < sorted.Size(); ++i)
  {
    std::copy_n(sorted.Get(i).X, Dimension, this->X.data() + i * Dimension);
  }
}

// Writes index coordinates in the order of the given points, whatever order Arrange() has made.
template <int Dimension>
void RelaxedPoints<Dimension>::Write(
  const GridSize<Dimension>& size, PointSpan<Dimension> points) const
{
  for (std::int64_t i = 0; i < this->Size(); ++i)
  {
    const std::int64_t point = this->Order.empty() ? i : this->Order[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double x = this->X[static_cast<std::size_t>(i * Dimension + axis)];
      // A coordinate that did not change keeps its bits: x * side / side may differ by rounding.
      const bool isMoved = x != this->Given[static_cast<std::size_t>(point * Dimension + axis)];
      // Back to index space, at the point's original place in the order.
      double& index = points[point][axis];
      index = std::clamp(
        isMoved ? x / this->Frame.CellSides[axis] : index, 0.0, static_cast<double>(size[axis]));
    }
  }
}

template class RelaxedPoints<2>;
template class RelaxedPoints<3>;

} // namespace RectifiedTransport

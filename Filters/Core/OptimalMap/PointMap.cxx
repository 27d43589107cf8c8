// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/PointMap.h"

#include "Core/OptimalMap/Nodes/CostTransform.h"
#include "Core/Parallel/Progress.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t pointGrain = std::int64_t{ 1 } << 13;

// T(x_i) = x_i - grad potential(x_i) at each node, in cells of the nodes.
template <int Dimension>
NodeMap<Dimension> gradientMap(
  const NodeGrid<Dimension>& grid, const double* potential, Progress& progress)
{
  auto map = NodeMap<Dimension>::On(grid);
  writeGradientMap<Dimension>(potential, map, progress);
  return map;
}

// solution = matrix^-1 right, for one Newton step; false where the matrix is singular.
template <int Dimension>
bool solve(const std::array<Point<Dimension>, Dimension>& matrix, const Point<Dimension>& right,
  Point<Dimension>& solution)
{
  using Square = Eigen::Matrix<double, Dimension, Dimension, Eigen::DontAlign>;
  using Column = Eigen::Matrix<double, Dimension, 1, Eigen::DontAlign>;
  // Added to the diagonal; small beside the derivatives of a map, which are about 1.
  constexpr double raise = 1e-9;
  Square square;
  for (int row = 0; row < Dimension; ++row)
  {
    for (int column = 0; column < Dimension; ++column)
    {
      square(row, column) =
        matrix[static_cast<std::size_t>(row)][column] + (row == column ? raise : 0.0);
    }
  }
  const Column found = square.inverse() * Eigen::Map<const Column>(right.data());
  Eigen::Map<Column>(solution.data()) = found;
  return found.allFinite();
}

// The multilinear interpolant of values at a cell's corners, at a place in [0, 1]^Dimension, and
// its derivatives along the axes. Corner numbers have axis 0 in their lowest bit; each axis in turn
// halves the values and the differences of the axes before it.
template <int Dimension>
double interpolate(std::array<double, std::size_t{ 1 } << Dimension> values,
  const Point<Dimension>& place, Point<Dimension>& slopes)
{
  constexpr std::size_t half = (std::size_t{ 1 } << Dimension) / 2;
  std::array<std::array<double, half>, Dimension> differences;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    for (std::size_t i = 0; i < half >> axis; ++i)
    {
      for (std::size_t before = 0; before < axis; ++before)
      {
        auto& of = differences[before];
        of[i] = of[2 * i] + place[axis] * (of[2 * i + 1] - of[2 * i]);
      }
      differences[axis][i] = values[2 * i + 1] - values[2 * i];
      values[i] = values[2 * i] + place[axis] * differences[axis][i];
    }
  }
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    slopes[axis] = differences[axis][0];
  }
  return values[0];
}

// Clamps a point of the nodes' index space to the box.
template <int Dimension>
Point<Dimension> clampedTo(const Point<Dimension>& point, const GridSize<Dimension>& cells)
{
  Point<Dimension> clamped;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    clamped[axis] = std::clamp(point[axis], 0.0, static_cast<double>(cells[axis]));
  }
  return clamped;
}

} // namespace

template <int Dimension>
PointMap<Dimension>::PointMap(const PotentialSolver<Dimension>& solver, int from,
  const CellDensity<Dimension>& target, const Point<Dimension>& sides, PointImages images,
  Progress& progress)
  : Images(images)
  , Target(target)
  , CellSides(sides)
  , SourcePlacement(solver.Side(from).Placement)
  , TargetPlacement(solver.Side(1 - from).Placement)
  , There(gradientMap(solver.Grid(), solver.Side(from).Potential.data(), progress))
  , Potential(solver.Side(1 - from).Potential.data())
{
  const SolverSide<Dimension>& other = solver.Side(1 - from);
  // Back is the gradient map of the other potential, T^-1 up to the error of the nodes. Newton's
  // method needs its derivatives; interpolation needs no inverse and smooths the stairs of T
  // instead.
  if (images == PointImages::Inverted)
  {
    this->Back = gradientMap(solver.Grid(), other.Potential.data(), progress);
  }
  else
  {
    smoothMap(this->There, progress);
  }
  // A node whose hat has no mass is as good as a void: an image there would be outside of the
  // target.
  const double* hats = other.Hats.data();
  const std::int64_t nodes = other.Hats.size();
  bool hasVoids = target.HasVoids();
  for (std::int64_t i = 0; i < nodes && !hasVoids; ++i)
  {
    hasVoids = hats[i] == 0.0;
  }
  // In a void of the target x - grad phi may be anything. The restricted c-transform, argmin over
  // nodes with mass of |x - y|^2 / 2 - psi(y), is where the optimal plan sends x.
  if (hasVoids)
  {
    NodeValues restricted(nodes);
    double* values = restricted.data();
    const double* potential = this->Potential;
    progress.ForEach(nodes, pointGrain, [=](std::int64_t i) {
      values[i] = hats[i] > 0.0 ? potential[i] : -std::numeric_limits<double>::infinity();
    });
    this->Minimizers = LargeBuffer<std::int64_t>(nodes);
    costMinimizers<Dimension>(solver.Grid(), values, this->Minimizers.data(), progress);
  }
}

// Whether an image, in cells of the nodes, lies in a target cell with mass. Without voids this is
// true everywhere.
template <int Dimension>
bool PointMap<Dimension>::HasMass(const Point<Dimension>& image) const
{
  if (this->Minimizers.size() == 0)
  {
    return true;
  }
  const Point<Dimension> point = this->TargetPlacement.FromNodes(image.data());
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (!(point[axis] >= 0.0 && point[axis] <= static_cast<double>(this->Target.Size()[axis])))
    {
      return false;
    }
  }
  return this->Target.HasMass(point.data());
}

// From the source's index space to the target's.
template <int Dimension>
Point<Dimension> PointMap<Dimension>::At(const double* point) const
{
  return this->AtPlace(
    clampedTo<Dimension>(this->SourcePlacement.ToNodes(point), this->There.Grid.Cells));
}

// T at a place in cells of the nodes: the interpolated gradient map, moved out of voids, then
// improved.
template <int Dimension>
Point<Dimension> PointMap<Dimension>::AtPlace(const Point<Dimension>& place) const
{
  Point<Dimension> image = this->There.At(place.data());
  if (!this->HasMass(image))
  {
    image = this->LeastCost(place, image);
  }
  if (this->Images == PointImages::Inverted)
  {
    this->Improve(place, image);
  }
  return this->ToTarget(image);
}

// A sample whose interpolated image is known already needs AtPlace only if that image is in a void,
// or if images are inverted.
template <int Dimension>
Point<Dimension> PointMap<Dimension>::AtSample(
  const CellSample<Dimension>& sample, const Point<Dimension>& image) const
{
  return this->Images == PointImages::Interpolated && this->HasMass(image)
    ? this->ToTarget(image)
    : this->AtPlace(sample.Place(this->There.Grid.Cells));
}

// To the target's index space, clamped to its box, and moved into the nearest cell with mass.
template <int Dimension>
Point<Dimension> PointMap<Dimension>::ToTarget(const Point<Dimension>& image) const
{
  Point<Dimension> point = this->TargetPlacement.FromNodes(image.data());
  point = clampedTo<Dimension>(point, this->Target.Size());
  if (!this->Target.HasMass(point.data())) // nodes do not resolve such cells
  {
    this->Target.MoveToMass(point.data(), this->CellSides);
  }
  return point;
}

// The image of a place whose gradient map ends in a void. Each corner about the place has its node
// y of least cost |x - y|^2 / 2 - psi(y) among those with mass; the best of these wins. The image
// lies in a cell with mass at that node, where in the cell the place is in its own, so that
// neighbours stay apart.
template <int Dimension>
Point<Dimension> PointMap<Dimension>::LeastCost(
  const Point<Dimension>& place, const Point<Dimension>& image) const
{
  // In parts of a cell: the least distance from its sides, so that rounding cannot leave it.
  constexpr double inside = 0.02;
  const NodeGrid<Dimension>& grid = this->There.Grid;
  const CellPlace<Dimension> at(place.data(), grid.Cells);
  Point<Dimension> best = image;
  double least = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < (1 << Dimension); ++corner)
  {
    std::int64_t node = 0;
    for (int axis = Dimension; axis-- > 0;)
    {
      node = node * (grid.Cells[axis] + 1) + at.Cell[axis] + ((corner >> axis) & 1);
    }
    std::int64_t rest = this->Minimizers.data()[node];
    // |x - y|^2 / 2 - psi(y) for this node y, in squared lengths.
    double cost = -this->Potential[rest];
    Point<Dimension> to;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      to[axis] = static_cast<double>(rest % (grid.Cells[axis] + 1));
      rest /= grid.Cells[axis] + 1;
      const double way = grid.Spacing[axis] * (to[axis] - place[axis]);
      cost += 0.5 * way * way;
    }
    if (cost >= least)
    {
      continue;
    }
    for (int side = 0; side < (1 << Dimension); ++side) // the cells that meet at the node
    {
      Point<Dimension> in;
      bool isInBox = true;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        in[axis] = to[axis] - ((side >> axis) & 1) + inside + (1.0 - 2.0 * inside) * at.Place[axis];
        isInBox = isInBox && in[axis] >= 0.0 && in[axis] <= static_cast<double>(grid.Cells[axis]);
      }
      if (isInBox && this->HasMass(in))
      {
        least = cost;
        best = in;
        break;
      }
    }
  }
  return best;
}

// Newton's method for the image y that the inverse map takes to the place: F(y) = y - grad psi(y) -
// x = 0. A step is damped until the residual |F| falls and y stays on mass; without such a step the
// image stays.
template <int Dimension>
void PointMap<Dimension>::Improve(const Point<Dimension>& place, Point<Dimension>& image) const
{
  // Newton's method converges quadratically where it converges; elsewhere 8 steps bound the time.
  constexpr int mostSteps = 8;
  constexpr double close = 1e-6; // in cells: far below the error of the nodes
  // Damping by 1, 1/2 and 1/4: shorter steps gain too little to be worth an evaluation.
  constexpr double leastDamping = 0.2;
  // A step must make the residual at least a tenth smaller.
  constexpr double nearer = 0.9;
  Inverse now = this->InverseAt(image, place);
  for (int step = 0; step < mostSteps && now.Size > close; ++step)
  {
    Point<Dimension> move;
    if (!solve<Dimension>(now.Jacobian, now.Residual, move))
    {
      return;
    }
    bool isNearer = false;
    for (double damping = 1.0; damping > leastDamping && !isNearer; damping *= 0.5)
    {
      Point<Dimension> next;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        next[axis] = image[axis] - damping * move[axis];
      }
      next = clampedTo<Dimension>(next, this->Back.Grid.Cells);
      if (this->HasMass(next))
      {
        const Inverse found = this->InverseAt(next, place);
        isNearer = found.Size < nearer * now.Size;
        if (isNearer)
        {
          image = next;
          now = found;
        }
      }
    }
    if (!isNearer)
    {
      return;
    }
  }
}

// The residual F = y - grad psi(y) - x in cells of the nodes, and its Jacobian, both from the
// multilinear interpolant of the inverse map at the nodes.
template <int Dimension>
typename PointMap<Dimension>::Inverse PointMap<Dimension>::InverseAt(
  const Point<Dimension>& image, const Point<Dimension>& place) const
{
  constexpr std::size_t corners = std::size_t{ 1 } << Dimension;
  // The corners of the cell that holds the image: within it the interpolant is smooth.
  const CellPlace<Dimension> at(image.data(), this->Back.Grid.Cells);
  std::array<std::int64_t, corners> nodes{};
  for (std::size_t corner = 0; corner < corners; ++corner)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t of = at.Cell[axis] + static_cast<std::int64_t>((corner >> axis) & 1);
      nodes[corner] += of * this->Back.Grid.Stride(axis);
    }
  }
  Inverse inverse;
  double square = 0.0;
  for (int coordinate = 0; coordinate < Dimension; ++coordinate)
  {
    const double* of = this->Back.Images[static_cast<std::size_t>(coordinate)].data();
    std::array<double, corners> values;
    for (std::size_t corner = 0; corner < corners; ++corner)
    {
      values[corner] = of[nodes[corner]];
    }
    const double value = interpolate<Dimension>(
      values, at.Place, inverse.Jacobian[static_cast<std::size_t>(coordinate)]);
    inverse.Residual[coordinate] = value - place[coordinate];
    square += inverse.Residual[coordinate] * inverse.Residual[coordinate];
  }
  inverse.Size = std::sqrt(square);
  return inverse;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(PointMap);

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Grid/WeightedPoisson.h"

#include "Core/Grid/ConjugateGradients.h"
#include "Core/Grid/NodeRows.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <algorithm>

namespace RectifiedTransport
{

template <int Dimension>
WeightedPoisson<Dimension>::WeightedPoisson(const NodeGrid<Dimension>& grid)
  : Grid(grid)
  , Nodes(grid.NumberOfNodes())
  , Chunk(chunkOfRows(grid))
{
}

// Preconditioned conjugate gradients with A p = -div(w grad p), w = max(floor, density), from p =
// 0. The preconditioner is the inverse of -Laplace, whose ratio to A is bounded by the extreme
// values of w, whatever the number of nodes. All arrays have one value a node.
template <int Dimension>
void WeightedPoisson<Dimension>::Solve(const double* masses, const double* density, double floor,
  int iterations, const Preconditioner& precondition, double* p, Progress& progress)
{
  for (NodeValues* values :
    { &this->Weights, &this->Residual, &this->Preconditioned, &this->Direction, &this->Image })
  {
    if (values->size() == 0)
    {
      *values = NodeValues(this->Nodes);
    }
  }
  this->Begin(masses, density, floor, p, progress);
  ConjugateGradients method;
  const double* z = this->Preconditioned.data();
  const double* image = this->Image.data();
  double* rest = this->Residual.data();
  double* direction = this->Direction.data();
  // z = M r, and the product r . z.
  const auto solve = [&]() {
    precondition(this->Residual.data(), this->Preconditioned.data());
    return sumOverNodes(
      this->Grid, progress, [=](std::int64_t node) { return z[node] * rest[node]; });
  };
  // d = z + beta d.
  const auto newDirection = [&](double beta) {
    progress.ForEach(
      this->Nodes, this->Chunk, [=](std::int64_t i) { direction[i] = z[i] + beta * direction[i]; });
  };
  // q = A d, and the product d . q.
  const auto apply = [&]() { return this->Apply(progress); };
  // p += alpha d, r -= alpha q.
  const auto advance = [&](double alpha) {
    progress.ForEach(this->Nodes, this->Chunk, [=](std::int64_t i) {
      p[i] += alpha * direction[i];
      rest[i] -= alpha * image[i];
    });
  };
  for (int iteration = 0;
       iteration < iterations && method.Iterate(solve, newDirection, apply, advance); ++iteration)
  {
  }
}

// Calls kernel(row, first node) for the rows along axis 0 of a range of nodes, which begins and
// ends with whole rows.
template <int Dimension>
template <class Kernel>
void WeightedPoisson<Dimension>::ForRows(
  std::int64_t first, std::int64_t last, const Kernel& kernel) const
{
  const std::int64_t nodes = this->Grid.Cells[0] + 1;
  for (; first < last; first += nodes)
  {
    kernel(first / nodes, first);
  }
}

// r = b, p = 0, d = 0, and the weights: a node's density is its mass over the part of the box that
// its hat stands for, half a cell for each side of the box that it lies on.
template <int Dimension>
void WeightedPoisson<Dimension>::Begin(
  const double* masses, const double* density, double floor, double* p, Progress& progress)
{
  const std::int64_t cells = this->Grid.Cells[0];
  const double number = static_cast<double>(this->Grid.NumberOfCells());
  double* rest = this->Residual.data();
  double* weights = this->Weights.data();
  double* direction = this->Direction.data();
  progress.For(this->Nodes, this->Chunk, [&](std::int64_t first, std::int64_t last) {
    std::copy(masses + first, masses + last, rest + first);
    std::fill(p + first, p + last, 0.0);
    std::fill(direction + first, direction + last, 0.0);
    this->ForRows(first, last, [&](std::int64_t row, std::int64_t node) {
      const double factor = number / shareOfRow<Dimension>(this->Grid, row);
      weights[node] = std::max(floor, 2.0 * factor * density[node]);
      for (std::int64_t i = node + 1; i < node + cells; ++i)
      {
        weights[i] = std::max(floor, factor * density[i]);
      }
      weights[node + cells] = std::max(floor, 2.0 * factor * density[node + cells]);
    });
  });
}

// Image = A Direction, as masses. Returns the product Direction . Image. Chunks of rows keep the
// sum's bits independent of threads.
template <int Dimension>
double WeightedPoisson<Dimension>::Apply(Progress& progress)
{
  return reduceChunks(
    progress, this->Nodes, this->Chunk, 0.0,
    [this](std::int64_t first, std::int64_t last) {
      double sum = 0.0;
      this->ForRows(first, last,
        [&](std::int64_t row, std::int64_t node) { sum += this->ApplyToRow(row, node); });
      return sum;
    },
    std::plus<>());
}

// The same for a row, with second-order differences: (A d)_i = sum over neighbours j of (w_i + w_j)
// / 2 (d_i - d_j) / h^2, times the area of the face between both in shares of a cell.
template <int Dimension>
double WeightedPoisson<Dimension>::ApplyToRow(std::int64_t row, std::int64_t node)
{
  const std::int64_t cells = this->Grid.Cells[0];
  const double* d = this->Direction.data() + node;
  const double* w = this->Weights.data() + node;
  double* image = this->Image.data() + node;
  // The face between two nodes has the share of the nodes of the row across it, halved at the
  // border.
  const double share = shareOfRow<Dimension>(this->Grid, row);
  const double number = static_cast<double>(this->Grid.NumberOfCells());
  const auto scaleOf = [&](int axis) {
    const double spacing = this->Grid.Spacing[axis];
    return 0.5 / (number * spacing * spacing);
  };
  std::fill_n(image, cells + 1, 0.0);
  std::int64_t rest = row;
  for (int axis = 1; axis < Dimension; ++axis)
  {
    const std::int64_t end = this->Grid.Cells[axis];
    const std::int64_t at = rest % (end + 1);
    rest /= end + 1;
    const double scale = scaleOf(axis) * share / shareOf(at, end);
    const std::int64_t stride = this->Grid.Stride(axis);
    const std::int64_t low = at > 0 ? -stride : 0; // no flux from the node itself
    const std::int64_t high = at < end ? stride : 0;
    for (std::int64_t i = 0; i <= cells; ++i)
    {
      image[i] += scale *
        ((w[i] + w[i + low]) * (d[i] - d[i + low]) + (w[i] + w[i + high]) * (d[i] - d[i + high]));
    }
  }
  // Along the other axes the faces of the row's end nodes are half as large.
  image[0] *= 0.5;
  image[cells] *= 0.5;
  const double scale = scaleOf(0) * share;
  image[0] += scale * (w[0] + w[1]) * (d[0] - d[1]);
  double sum = image[0] * d[0];
  for (std::int64_t i = 1; i < cells; ++i)
  {
    image[i] +=
      scale * ((w[i] + w[i - 1]) * (d[i] - d[i - 1]) + (w[i] + w[i + 1]) * (d[i] - d[i + 1]));
    sum += image[i] * d[i];
  }
  image[cells] += scale * (w[cells] + w[cells - 1]) * (d[cells] - d[cells - 1]);
  return sum + image[cells] * d[cells];
}

// The five arrays are the weights, the residual, the preconditioned residual, the direction and its
// image.
template <int Dimension>
double WeightedPoisson<Dimension>::MemoryFor(const NodeGrid<Dimension>& grid)
{
  constexpr double arrays = 5.0;
  return arrays * sizeof(double) * numberOfCorners<Dimension>(grid.Cells);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(WeightedPoisson);

} // namespace RectifiedTransport

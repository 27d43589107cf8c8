// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/SpacingLimit.h"

#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/NeighbourTree.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t limitGrain = 256;

// The bound of the mean number of neighbours: about 20 times as many as points have that are
// distributed like the density. More are affordable if there are few points, as long as there are
// at most 1e8 pairs.
template <int Dimension>
double affordableNeighbours(std::int64_t points)
{
  constexpr double pairs = 1e8;
  return std::max(Dimension == 2 ? 2000.0 : 10000.0, pairs / static_cast<double>(points));
}

// The mean over a sample of at most 64 blocks, evenly spaced in the order of the tree.
template <int Dimension>
double meanNeighbours(const NeighbourTree<Dimension>& tree, double reach, Progress& progress)
{
  constexpr std::int64_t most = 64;
  const std::int64_t taken = std::min(most, tree.Blocks());
  Neighbourhood found;
  double sum = 0.0;
  for (std::int64_t i = 0; i < taken; ++i)
  {
    const std::int64_t block = i * tree.Blocks() / taken;
    tree.FindNearby(tree, block, block + 1, reach, found);
    sum += static_cast<double>(found.Count);
    progress.Check();
  }
  return sum / static_cast<double>(taken);
}

} // namespace

template <int Dimension>
double affordableSpacing(const SpacingTree<Dimension>& tree, ConstPointSpan<Dimension> points,
  double reach, Progress& progress)
{
  // With few points, all pairs are affordable.
  const double affordable = affordableNeighbours<Dimension>(points.size());
  if (static_cast<double>(points.size()) <= affordable)
  {
    return std::numeric_limits<double>::infinity();
  }
  std::vector<ScaledPoint<Dimension>> scaled(static_cast<std::size_t>(points.size()));
  progress.ForEach(
    points.size(), limitGrain,
    [&](std::int64_t i) {
      const Point<Dimension> x = pointAt<Dimension>(points[i]);
      const double spacing = tree.Evaluate(tree.Spacing(), tree.Locate(x))[0];
      scaled[static_cast<std::size_t>(i)] = scaledPoint<Dimension>(x, spacing, 1.0);
    },
    16 * limitGrain);
  NeighbourTree<Dimension> neighbours;
  neighbours.Build(scaled, progress);
  // Lowers the largest spacing by 30 % a round, until the sample has an affordable number of
  // neighbours. At the mean spacing, 1, it ends.
  double limit = std::numeric_limits<double>::infinity();
  while (limit > 1.0 && meanNeighbours(neighbours, reach, progress) > affordable)
  {
    double largest = 0.0;
    for (std::int64_t i = 0; i < neighbours.Size(); ++i)
    {
      largest = std::max(largest, neighbours.Get(i).Spacing);
    }
    limit = std::max(0.7 * largest, 1.0);
    for (std::int64_t i = 0; i < neighbours.Size(); ++i)
    {
      ScaledPoint<Dimension> point = neighbours.Get(i);
      point.Spacing = std::min(point.Spacing, limit);
      point.Square = point.Spacing * point.Spacing;
      neighbours.Set(i, point);
    }
    neighbours.Update();
  }
  return limit;
}

template double affordableSpacing<2>(const SpacingTree<2>&, ConstPointSpan<2>, double, Progress&);
template double affordableSpacing<3>(const SpacingTree<3>&, ConstPointSpan<3>, double, Progress&);

} // namespace RectifiedTransport

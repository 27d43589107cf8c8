// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/RepulsionEnergy.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <limits>
#include <numeric>

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

// Chunks in leaves, nodes or points, and in blocks of points. They are fixed, so that sums do not
// depend on the number of threads.
constexpr std::int64_t repulsionGrain = 256;
constexpr std::int64_t repulsionSlice = 16 * repulsionGrain; // a few milliseconds
constexpr std::int64_t blockGrain = 16;

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

template <int Dimension>
RepulsionEnergy<Dimension>::RepulsionEnergy(const RectifiedFlow<Dimension>& flow,
  const RelaxationFrame<Dimension>& frame, const SpacingTree<Dimension>& tree, std::int64_t points,
  const RepulsionWidth& width, Progress& progress)
  : Flow(flow)
  , Frame(frame)
  , Tree(tree)
  , Count(static_cast<double>(points))
  , Kernels(repulsionKernels<Dimension>())
{
  // g(q) uses the kernels' own exp, so that it is exactly 0 at Cut.
  this->Shape.PerVariance = 0.5 / (width.Deviation * width.Deviation);
  this->Shape.Cut = width.Cut;
  this->Shape.AtCut = this->Kernels.Exponential(width.Cut);
  this->Reach = width.Reach();
  this->FindAttraction(progress);
}

// The quadrature of A(x) = integral of n K: each leaf counts as a point mass at its centroid. The
// masses of its 2^D parts are exact (from summed-area tables); each part's centroid is taken to be
// its centre, at 1/4 or 3/4 of the leaf.
template <int Dimension>
NeighbourTree<Dimension> RepulsionEnergy<Dimension>::FindSources(Progress& progress) const
{
  std::vector<ScaledPoint<Dimension>> sources(static_cast<std::size_t>(this->Tree.Leaves()));
  progress.ForEach(
    this->Tree.Leaves(), repulsionGrain,
    [&](std::int64_t leaf) {
      const Point<Dimension> low = this->Tree.LeafLow(leaf);
      const Point<Dimension> sides = this->Tree.LeafSides(leaf);
      double mass = 0.0;
      Point<Dimension> centroid{};
      for (int part = 0; part < hermiteCorners<Dimension>; ++part)
      {
        Point<Dimension> lowIndex;
        Point<Dimension> highIndex;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          // The half of the leaf along this axis, in the frame and in index space.
          const double from = low[axis] + ((part >> axis & 1) ? 0.5 : 0.0) * sides[axis];
          lowIndex[axis] = from / this->Frame.CellSides[axis];
          highIndex[axis] = (from + 0.5 * sides[axis]) / this->Frame.CellSides[axis];
        }
        const double share = this->Flow.Share(lowIndex, highIndex);
        mass += share;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          centroid[axis] += share * ((part >> axis & 1) ? 0.75 : 0.25);
        }
      }
      // Leaves without mass keep any spacing; they are removed below.
      double spacing = 1.0;
      if (mass > 0.0)
      {
        Point<Dimension> at;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          at[axis] = centroid[axis] / mass;
          centroid[axis] = low[axis] + at[axis] * sides[axis];
        }
        // The kernel's width at a source is the spacing at its centroid.
        spacing = this->Tree.Evaluate(this->Tree.Spacing(), this->Tree.InLeaf(leaf, at))[0];
      }
      // Mass * Count: the density is scaled to the number of points, so that it cancels theirs.
      sources[static_cast<std::size_t>(leaf)] =
        scaledPoint<Dimension>(centroid, spacing, mass * this->Count);
    },
    repulsionSlice);
  // Leaves without mass attract nothing.
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                  [](const ScaledPoint<Dimension>& source) { return !(source.Mass > 0.0); }),
    sources.end());
  progress.Check();
  NeighbourTree<Dimension> tree;
  tree.BuildInOrder(sources, progress);
  return tree;
}

// A(x) and its gradient at the nodes, which are points with the spacing h(x). The total derivative
// has the change of the spacing with the place: dA/dx = (dA/dx at constant h) + (dA/d(h^2)) 2 h
// dh/dx.
template <int Dimension>
typename SpacingTree<Dimension>::Field RepulsionEnergy<Dimension>::SumAttraction(
  const NeighbourTree<Dimension>& sources, Progress& progress) const
{
  NeighbourTree<Dimension> targets;
  {
    std::vector<ScaledPoint<Dimension>> nodes(static_cast<std::size_t>(this->Tree.Nodes()));
    for (std::size_t node = 0; node < nodes.size(); ++node)
    {
      nodes[node] = scaledPoint<Dimension>(
        this->Tree.NodePoint(static_cast<std::int64_t>(node)), this->Tree.Spacing()[node][0], 0.0);
    }
    progress.Check();
    targets.BuildInOrder(nodes, progress);
  }
  typename SpacingTree<Dimension>::Field attraction(static_cast<std::size_t>(this->Tree.Nodes()));
  progress.For(
    targets.Blocks(), blockGrain,
    [&](std::int64_t first, std::int64_t last) {
      Neighbourhood found;
      RepulsionBlock<Dimension> block;
      for (std::int64_t i = first; i < last; ++i)
      {
        sources.FindNearby(targets, i, last, this->Reach, found);
        const int count = targets.Fill(i, block);
        this->Kernels.Sum(this->Shape, sources.Points(), found.Points.data(), found.Count, block);
        for (int lane = 0; lane < count; ++lane)
        {
          const auto node = static_cast<std::size_t>(i * repulsionBlock + lane);
          HermiteData<Dimension>& data = attraction[node];
          const HermiteData<Dimension>& spacing = this->Tree.Spacing()[node];
          data[0] = block.Sum[lane];
          for (int axis = 0; axis < Dimension; ++axis)
          {
            const auto entry = std::size_t{ 1 } << axis;
            data[entry] =
              block.Gradient[axis][lane] + 2.0 * spacing[0] * spacing[entry] * block.BySquare[lane];
          }
        }
      }
    },
    blockGrain);
  progress.Check();
  return attraction;
}

// Prepares what does not depend on the points: A as a Hermite field, and the constant of the
// energy.
template <int Dimension>
void RepulsionEnergy<Dimension>::FindAttraction(Progress& progress)
{
  typename SpacingTree<Dimension>::Field attraction;
  {
    const NeighbourTree<Dimension> sources = this->FindSources(progress);
    attraction = this->SumAttraction(sources, progress);
    this->Tree.FindMixed(attraction, false, progress);
    progress.Check();
    // The constant integral of n A, by the same quadrature: the sum over sources of mass *
    // A(source).
    std::vector<double> parts(static_cast<std::size_t>(sources.Size()));
    progress.ForEach(
      sources.Size(), repulsionGrain,
      [&](std::int64_t i) {
        const ScaledPoint<Dimension> source = sources.Get(i);
        const Point<Dimension> x = pointAt<Dimension>(source.X);
        parts[static_cast<std::size_t>(i)] =
          source.Mass * this->Tree.Evaluate(attraction, this->Tree.Locate(x))[0];
      },
      repulsionSlice);
    this->Constant = std::accumulate(parts.begin(), parts.end(), 0.0);
  }
  // The spacing and A are interleaved, so that one evaluation with common weights gives both.
  this->Fields.resize(attraction.size());
  progress.ForEach(
    this->Tree.Nodes(), repulsionGrain,
    [&](std::int64_t i) {
      const auto node = static_cast<std::size_t>(i);
      for (std::size_t entry = 0; entry < attraction[node].size(); ++entry)
      {
        this->Fields[node][entry] = { this->Tree.Spacing()[node][entry], attraction[node][entry] };
      }
    },
    repulsionSlice);
  progress.Check();
}

// Sorts the points into blocks of neighbours. Leaves begin at 0 as a guess for the search.
template <int Dimension>
void RepulsionEnergy<Dimension>::Sort(ConstPointSpan<Dimension> points, Progress& progress)
{
  std::vector<ScaledPoint<Dimension>> particles(static_cast<std::size_t>(points.size()));
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    particles[static_cast<std::size_t>(i)] =
      scaledPoint<Dimension>(pointAt<Dimension>(points[i]), 1.0, 1.0);
  }
  this->Particles.Build(particles, progress);
  this->AtPoints.resize(static_cast<std::size_t>(points.size()));
  this->Leaves.assign(static_cast<std::size_t>(points.size()), 0);
  this->Parts.resize(static_cast<std::size_t>(this->Particles.Blocks()));
}

// E(x) = (sum over i, j of K(x_i, x_j) - 2 sum over i of A(x_i) + constant) / N, the squared
// distance of two sums of Gaussians, with its gradient. It takes two passes, because the kernel
// between two points needs the spacings of both.
template <int Dimension>
double RepulsionEnergy<Dimension>::Evaluate(ConstPointSpan<Dimension> points,
  PointSpan<Dimension> gradient, double* spacings, Progress& progress)
{
  using Data = HermiteData<Dimension, ValuePair>;
  const std::int64_t count = points.size();
  const std::int64_t* order = this->Particles.Order();
  // First pass: the spacing and A at each point. A block of 16 points is located and its nodes are
  // prefetched before the first is evaluated: the latency of memory is then hidden.
  progress.For(
    count, repulsionGrain,
    [&](std::int64_t first, std::int64_t last) {
      constexpr std::int64_t most = 16; // at once
      std::array<typename SpacingTree<Dimension>::Place, most> places;
      for (std::int64_t begin = first; begin < last; begin += most)
      {
        const std::int64_t end = std::min(begin + most, last);
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Point<Dimension> x = pointAt<Dimension>(points[order[i]]);
          std::int64_t& leaf = this->Leaves[static_cast<std::size_t>(i)];
          auto& place = places[static_cast<std::size_t>(i - begin)];
          place = this->Tree.Locate(x, leaf);
          leaf = place.Leaf;
          this->Tree.Prefetch(this->Fields, place);
          if (i + most < last)
          {
            this->Tree.PrefetchLeaf(this->Leaves[static_cast<std::size_t>(i + most)]);
          }
        }
        for (std::int64_t i = begin; i < end; ++i)
        {
          Data& data = this->AtPoints[static_cast<std::size_t>(i)];
          data = this->Tree.Evaluate(this->Fields, places[static_cast<std::size_t>(i - begin)]);
          const Point<Dimension> x = pointAt<Dimension>(points[order[i]]);
          const double spacing = data[0].First();
          this->Particles.Set(i, scaledPoint<Dimension>(x, spacing, 1.0));
          spacings[order[i]] = spacing;
        }
      }
    },
    repulsionSlice);
  this->Particles.Update();
  // Second pass: the repulsion. The double sum over points counts each pair twice, and K is
  // symmetric, so dE/dx_i = (2 / N) (sum over j of dK(x_i, x_j)/dx_i - dA/dx_i), with total
  // derivatives again.
  const double scale = 2.0 / this->Count;
  progress.For(
    this->Particles.Blocks(), blockGrain,
    [&](std::int64_t first, std::int64_t last) {
      Neighbourhood found;
      RepulsionBlock<Dimension> block;
      for (std::int64_t i = first; i < last; ++i)
      {
        this->Particles.FindNearby(this->Particles, i, last, this->Reach, found);
        const int filled = this->Particles.Fill(i, block);
        this->Kernels.Sum(
          this->Shape, this->Particles.Points(), found.Points.data(), found.Count, block);
        // The part of this block in N E: the sum over its points of (sum over j of K) - 2 A. The
        // term j = i is K(x, x) = g(0), whose gradient is 0.
        double sum = 0.0;
        for (int lane = 0; lane < filled; ++lane)
        {
          const std::int64_t point = i * repulsionBlock + lane;
          const Data& data = this->AtPoints[static_cast<std::size_t>(point)];
          sum += block.Sum[lane] - 2.0 * data[0].Second();
          for (int axis = 0; axis < Dimension; ++axis)
          {
            const auto entry = std::size_t{ 1 } << axis;
            gradient[order[point]][axis] = scale *
              (block.Gradient[axis][lane] +
                2.0 * data[0].First() * data[entry].First() * block.BySquare[lane] -
                data[entry].Second());
          }
        }
        this->Parts[static_cast<std::size_t>(i)] = sum;
      }
    },
    blockGrain);
  // The parts are added in the order of the blocks, whatever the threads.
  double sum = this->Constant;
  for (const double energy : this->Parts)
  {
    sum += energy;
  }
  return sum / this->Count;
}

template double affordableSpacing<2>(const SpacingTree<2>&, ConstPointSpan<2>, double, Progress&);
template double affordableSpacing<3>(const SpacingTree<3>&, ConstPointSpan<3>, double, Progress&);
template class RepulsionEnergy<2>;
template class RepulsionEnergy<3>;

} // namespace RectifiedTransport

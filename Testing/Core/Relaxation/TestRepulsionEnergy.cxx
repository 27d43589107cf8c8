// SPDX-License-Identifier: BSD-3-Clause
// The energy of Gaussian blue noise against its definition, and its parts.
#include "Core/Relaxation/RepulsionEnergy.h"

#include "Core/Parallel/Progress.h"

#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr RepulsionWidth width{ 0.5, 13.8 };
constexpr double infinity = std::numeric_limits<double>::infinity();

// What the energy of points on a density needs.
template <int Dimension>
struct EnergyCase
{
  EnergyCase(const TestDensity<Dimension>& density, std::int64_t count, double finest)
    : Density(density)
    , Flow(density.Source())
    , Work(Context())
    , Frame(density.Size, evenPoint<Dimension>(1.0), count)
    , Tree(Flow, Frame, count, finest, infinity, Work)
    , Energy(Flow, Frame, Tree, count, width, Work)
    , Points(randomPoints<Dimension>(density.Size, static_cast<std::size_t>(count)))
  {
    for (Point<Dimension>& point : this->Points)
    {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        point[axis] *= this->Frame.CellSides[axis];
      }
    }
  }

  double Evaluate(const RectifiedTransport::Points<Dimension>& points,
    RectifiedTransport::Points<Dimension>& gradient)
  {
    std::vector<double> spacings(points.size());
    gradient.resize(points.size());
    this->Energy.Sort(points, this->Work);
    return this->Energy.Evaluate(points, gradient, spacings.data(), this->Work);
  }

  double SpacingAt(const Point<Dimension>& x) const
  {
    return this->Tree.Evaluate(this->Tree.Spacing(), this->Tree.Locate(x))[0];
  }

  const TestDensity<Dimension> Density;
  const RectifiedFlow<Dimension> Flow;
  Progress Work;
  const RelaxationFrame<Dimension> Frame;
  const SpacingTree<Dimension> Tree;
  RepulsionEnergy<Dimension> Energy;
  RectifiedTransport::Points<Dimension> Points;
};

template <int Dimension>
struct Mass
{
  Point<Dimension> X;
  double Spacing;
  double Weight;
};

// The sum of K between all points and masses, by its formula.
template <int Dimension>
double sumOfPairs(
  const std::vector<Mass<Dimension>>& first, const std::vector<Mass<Dimension>>& second)
{
  double sum = 0.0;
  for (const auto& a : first)
  {
    for (const auto& b : second)
    {
      const double squares = a.Spacing * a.Spacing + b.Spacing * b.Spacing;
      double squared = 0.0;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        squared += (a.X[axis] - b.X[axis]) * (a.X[axis] - b.X[axis]);
      }
      const double q = squared / (2.0 * width.Deviation * width.Deviation * squares);
      const double ratio = 2.0 * a.Spacing * b.Spacing / squares;
      const double overlap = Dimension == 2 ? ratio : ratio * std::sqrt(ratio);
      sum += a.Weight * b.Weight * overlap * std::exp(-q);
    }
  }
  return sum;
}

// The cells of a density as masses on a lattice of `perCell` points an axis and cell.
template <int Dimension>
std::vector<Mass<Dimension>> massesOf(const EnergyCase<Dimension>& test, int perCell)
{
  GridSize<Dimension> fine = test.Density.Size;
  for (auto& cells : fine)
  {
    cells *= perCell;
  }
  std::vector<Mass<Dimension>> masses;
  double total = 0.0;
  for (std::int64_t i = 0; i < cellCount<Dimension>(fine); ++i)
  {
    GridSize<Dimension> cell = cellAt<Dimension>(i, fine);
    Point<Dimension> x;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      x[axis] = (static_cast<double>(cell[axis]) + 0.5) / perCell * test.Frame.CellSides[axis];
      cell[axis] /= perCell;
    }
    const double value = test.Density.Values[cellIndex<Dimension>(cell, test.Density.Size)];
    masses.push_back({ x, test.SpacingAt(x), value });
    total += value;
  }
  for (auto& mass : masses)
  {
    mass.Weight *= static_cast<double>(test.Points.size()) / total;
  }
  return masses;
}

template <int Dimension>
void expectDefinition(const TestDensity<Dimension>& density, std::int64_t count, double finest,
  int perCell, double error)
{
  EnergyCase<Dimension> test(density, count, finest);
  std::vector<Mass<Dimension>> points;
  for (const auto& x : test.Points)
  {
    points.push_back({ x, test.SpacingAt(x), 1.0 });
  }
  const auto energy = [&](int lattice) {
    const auto masses = massesOf<Dimension>(test, lattice);
    return (sumOfPairs(points, points) - 2.0 * sumOfPairs(points, masses) +
             sumOfPairs(masses, masses)) /
      static_cast<double>(count);
  };
  // Without the error of second order of the lattice.
  const double expected = (4.0 * energy(2 * perCell) - energy(perCell)) / 3.0;
  Points<Dimension> gradient;
  EXPECT_NEAR(test.Evaluate(test.Points, gradient), expected, error);
}

TEST(RepulsionEnergy, IsTheSumOverAllPairs)
{
  expectDefinition<2>(twoGaussians<2>({ 6, 5 }), 20, 0.5, 4, 0.015);
  expectDefinition<2>(twoGaussians<2>({ 6, 5 }), 20, 0.125, 4, 0.001);
  expectDefinition<2>(checker<2>({ 6, 4 }, 2), 20, 0.125, 4, 0.001);
  expectDefinition<3>(twoGaussians<3>({ 3, 2, 3 }), 12, 0.25, 2, 0.008);
}

template <int Dimension>
void expectGradient(const TestDensity<Dimension>& density, std::int64_t count, double finest)
{
  EnergyCase<Dimension> test(density, count, finest);
  Points<Dimension> gradient;
  Points<Dimension> unused;
  test.Evaluate(test.Points, gradient);
  constexpr double step = 1e-5;
  for (std::size_t i = 0; i < test.Points.size(); i += 3)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      Points<Dimension> moved = test.Points;
      moved[i][axis] += step;
      const double above = test.Evaluate(moved, unused);
      moved[i][axis] -= 2.0 * step;
      const double below = test.Evaluate(moved, unused);
      EXPECT_NEAR(gradient[i][axis], (above - below) / (2.0 * step), 2e-6) << i << " " << axis;
    }
  }
}

TEST(RepulsionEnergy, GradientIsThatOfDifferences)
{
  expectGradient<2>(twoGaussians<2>({ 12, 9 }), 60, 0.5);
  expectGradient<2>(discWithHole<2>({ 30, 30 }), 60, 0.5);
  expectGradient<3>(twoGaussians<3>({ 6, 5, 6 }), 30, 0.75);
}

// Boxes of different sizes meet: the function and its derivatives are the same on both sides.
template <int Dimension>
void expectSmooth(const TestDensity<Dimension>& density, std::int64_t count)
{
  EnergyCase<Dimension> test(density, count, 0.75);
  const auto& tree = test.Tree;
  std::mt19937_64 engine(5);
  double widest = 0.0;
  double narrowest = infinity;
  for (std::int64_t leaf = 0; leaf < tree.Leaves(); ++leaf)
  {
    const Point<Dimension> low = tree.LeafLow(leaf);
    const Point<Dimension> sides = tree.LeafSides(leaf);
    widest = std::max(widest, sides[0]);
    narrowest = std::min(narrowest, sides[0]);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      Point<Dimension> inside;
      for (int a = 0; a < Dimension; ++a)
      {
        inside[a] = low[a] + uniformNumber(engine) * sides[a];
      }
      Point<Dimension> outside = inside;
      inside[axis] = low[axis] + 1e-10 * sides[axis];
      outside[axis] = std::max(low[axis] - 1e-10 * sides[axis], 0.0);
      const auto above = tree.Evaluate(tree.Spacing(), tree.Locate(inside));
      const auto below = tree.Evaluate(tree.Spacing(), tree.Locate(outside));
      EXPECT_NEAR(above[0], below[0], 1e-8);
      for (int a = 0; a < Dimension; ++a)
      {
        EXPECT_NEAR(above[std::size_t{ 1 } << a], below[std::size_t{ 1 } << a], 1e-7);
      }
      EXPECT_GT(above[0], 0.0);
      EXPECT_NEAR(above[0], tree.ExactSpacing(inside), 0.25 * above[0]);
    }
  }
  EXPECT_GT(widest, 3.0 * narrowest) << "the boxes differ too little for the test";
}

TEST(RepulsionEnergy, SpacingIsSmooth)
{
  expectSmooth<2>(twoGaussians<2>({ 40, 30 }), 300);
  expectSmooth<2>(discWithHole<2>({ 40, 40 }), 100);
  expectSmooth<3>(twoGaussians<3>({ 12, 12, 12 }), 60);
}

// No leaf is wider than it may be, and a guess changes nothing about a place.
template <int Dimension>
void expectPlaces(const TestDensity<Dimension>& density, std::int64_t count)
{
  constexpr double finest = 0.6;
  EnergyCase<Dimension> test(density, count, finest);
  const auto& tree = test.Tree;
  for (std::int64_t leaf = 0; leaf < tree.Leaves(); ++leaf)
  {
    const Point<Dimension> low = tree.LeafLow(leaf);
    const Point<Dimension> sides = tree.LeafSides(leaf);
    Point<Dimension> centre;
    Point<Dimension> inside;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      centre[axis] = low[axis] + 0.5 * sides[axis];
      inside[axis] = low[axis] + 0.3 * sides[axis];
    }
    EXPECT_LE(*std::max_element(sides.begin(), sides.end()),
      finest * tree.ExactSpacing(centre) * (1.0 + 1e-6));
    for (const std::int64_t guess :
      { leaf, std::max<std::int64_t>(leaf - 1, 0), tree.Leaves() - 1 })
    {
      const auto place = tree.Locate(inside, guess);
      EXPECT_EQ(place.Leaf, leaf);
      EXPECT_EQ(place.At, tree.Locate(inside).At);
      EXPECT_EQ(*place.Sides, sides);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        EXPECT_NEAR(place.At[axis], 0.3, 1e-9);
      }
    }
  }
}

TEST(RepulsionEnergy, PlacesInLeaves)
{
  expectPlaces<2>(twoGaussians<2>({ 40, 30 }), 300);
  expectPlaces<2>(discWithHole<2>({ 60, 4 }), 100);
  expectPlaces<3>(twoGaussians<3>({ 12, 12, 12 }), 60);
}

// Boxes as long as the domain is thin would be millions.
TEST(RepulsionEnergy, NeedlesHaveFewLeaves)
{
  expectSmooth<2>(twoGaussians<2>({ 400, 1 }), 60);
  expectSmooth<3>(twoGaussians<3>({ 200, 2, 1 }), 60);
  constexpr std::int64_t count = 24;
  const TestDensity<3> density = dirac<3>({ 4096, 1, 1 }, { 9, 0, 0 });
  const RectifiedFlow<3> flow(density.Source());
  Progress work{ Context() };
  const RelaxationFrame<3> frame(density.Size, { 1.0, 1e-3, 1e-3 }, count);
  const SpacingTree<3> tree(flow, frame, count, 0.75, infinity, work);
  EXPECT_GT(tree.Leaves(), count);
  EXPECT_LT(tree.Leaves(), 100 * count);
}

// Points all over a domain whose density is in a small part of it would nearly all be neighbours.
TEST(RepulsionEnergy, NeighboursAreBounded)
{
  constexpr std::int64_t count = 12000;
  const auto limitFor = [](const TestDensity<2>& density) {
    const RectifiedFlow<2> flow(density.Source());
    Progress work{ Context() };
    const RelaxationFrame<2> frame(density.Size, { 1.0, 1.0 }, count);
    const SpacingTree<2> tree(flow, frame, count, 0.6, infinity, work);
    Points<2> points = randomPoints<2>(density.Size, count);
    for (Point<2>& point : points)
    {
      point[0] *= frame.CellSides[0];
      point[1] *= frame.CellSides[1];
    }
    return affordableSpacing<2>(tree, points, width.Reach(), work);
  };
  EXPECT_EQ(limitFor(uniformDensity<2>({ 64, 64 })), infinity);
  EXPECT_EQ(limitFor(twoGaussians<2>({ 64, 64 })), infinity);
  const double limit = limitFor(dirac<2>({ 64, 64 }, { 9, 30 }));
  EXPECT_GE(limit, 1.0);
  EXPECT_LT(limit, 50.0);
}

TEST(RepulsionEnergy, ExponentialOfTheKernels)
{
  const auto exponential = repulsionKernels<2>(InstructionSet::SSE2).Exponential;
  for (double q = 0.0; q <= 16.0; q += 0.01)
  {
    EXPECT_NEAR(exponential(q) / std::exp(-q), 1.0, 1e-9) << q;
  }
}

template <int Dimension>
std::vector<ScaledPoint<Dimension>> randomScaledPoints(std::size_t count, double side)
{
  std::mt19937_64 engine(2);
  std::vector<ScaledPoint<Dimension>> points(count);
  for (auto& point : points)
  {
    Point<Dimension> x;
    std::generate(x.begin(), x.end(), [&]() { return side * uniformNumber(engine); });
    point = scaledPoint<Dimension>(x, 0.5 + uniformNumber(engine), uniformNumber(engine));
  }
  return points;
}

// In both orders of the points, for all blocks at once and for single ones.
template <int Dimension>
void expectPointsInReach()
{
  constexpr double reach = 1.7;
  const auto points = randomScaledPoints<Dimension>(301, 12.0);
  Progress work{ Context() };
  NeighbourTree<Dimension> tree;
  NeighbourTree<Dimension> targets;
  tree.Build(points, work);
  targets.BuildInOrder(randomScaledPoints<Dimension>(21, 2.0), work);
  Neighbourhood together;
  for (const bool isAlone : { false, true })
  {
    for (std::int64_t block = 0; block < targets.Blocks(); ++block)
    {
      Neighbourhood alone;
      Neighbourhood& found = isAlone ? alone : together;
      const std::int64_t last = isAlone ? block + 1 : targets.Blocks();
      tree.FindNearby(targets, block, last, reach, found);
      ASSERT_TRUE(std::is_sorted(found.Points.data(), found.Points.data() + found.Count));
      for (std::int64_t i = 0; i < tree.Size(); ++i)
      {
        const ScaledPoint<Dimension> point = tree.Get(i);
        const auto original = static_cast<std::size_t>(tree.Order()[i]);
        ASSERT_EQ(std::memcmp(&point, &points[original], sizeof(point)), 0);
        bool isInReach = false;
        for (std::int64_t k = 8 * block; k < std::min(8 * block + 8, targets.Size()); ++k)
        {
          const ScaledPoint<Dimension> target = targets.Get(k);
          double squared = 0.0;
          for (int axis = 0; axis < Dimension; ++axis)
          {
            squared += (point.X[axis] - target.X[axis]) * (point.X[axis] - target.X[axis]);
          }
          isInReach = isInReach || squared < reach * (point.Square + target.Square);
        }
        if (isInReach)
        {
          EXPECT_TRUE(
            std::binary_search(found.Points.data(), found.Points.data() + found.Count, i));
        }
      }
      EXPECT_GT(found.Count, 0);
      EXPECT_LT(found.Count, tree.Size() / 2) << "nothing is left out";
    }
  }
}

TEST(RepulsionEnergy, PointsInReachAreFound)
{
  expectPointsInReach<2>();
  expectPointsInReach<3>();
}

template <int Dimension>
void expectSameBits(InstructionSet set)
{
  Progress work{ Context() };
  NeighbourTree<Dimension> tree;
  tree.Build(randomScaledPoints<Dimension>(101, 3.0), work);
  std::vector<std::int64_t> blocks(static_cast<std::size_t>(tree.Blocks()));
  std::iota(blocks.begin(), blocks.end(), 0);
  BlockBounds<Dimension> bounds;
  std::fill_n(bounds.Low, Dimension, 0.5);
  std::fill_n(bounds.High, Dimension, 1.5);
  bounds.Largest = 0.3;
  RepulsionBlock<Dimension> block{};
  tree.Fill(3, block);
  RepulsionBlock<Dimension> other = block;
  const RepulsionShape shape{ 2.0, 5.0, std::exp(-5.0) };
  std::vector<std::int64_t> found(8 * blocks.size());
  std::vector<std::int64_t> otherFound(found.size());
  const auto run = [&](InstructionSet with, std::vector<std::int64_t>& numbers, auto& sums) {
    const RepulsionKernels<Dimension> kernels = repulsionKernels<Dimension>(with);
    const std::int64_t count =
      kernels.Select(bounds, 0.9, tree.Points(), blocks.data(), tree.Blocks(), numbers.data());
    kernels.Sum(shape, tree.Points(), numbers.data(), count, sums);
    numbers.resize(static_cast<std::size_t>(count));
  };
  run(InstructionSet::SSE2, found, block);
  run(set, otherFound, other);
  EXPECT_EQ(found, otherFound) << nameOf(set);
  EXPECT_LT(found.size(), 101u) << "nothing is left out";
  EXPECT_EQ(std::memcmp(&block, &other, sizeof(block)), 0) << nameOf(set);
}

TEST(RepulsionEnergy, KernelsHaveTheSameBits)
{
  for (const InstructionSet set : { InstructionSet::AVX2, InstructionSet::AVX512 })
  {
    if (set <= widestInstructionSet())
    {
      expectSameBits<2>(set);
      expectSameBits<3>(set);
    }
  }
}

} // namespace
} // namespace RectifiedTransport

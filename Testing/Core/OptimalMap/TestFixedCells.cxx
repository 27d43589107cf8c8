// SPDX-License-Identifier: BSD-3-Clause
// What both densities have stays where it is, with samples and without.
#include "TestDensities.h"

#include "Core/OptimalMap/Nodes/NodeMap.h"
#include "Core/OptimalMap/OptimalMap.h"
#include "Core/Parallel/Progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr double radius = 0.12;

// Discs or balls in a box of side 1 over an even ground.
template <int Dimension>
std::vector<double> discs(
  std::int64_t cells, const std::array<Point<Dimension>, 2>& middles, double ground)
{
  std::int64_t count = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    count *= cells;
  }
  std::vector<double> values(static_cast<std::size_t>(count), ground);
  for (std::int64_t i = 0; i < count; ++i)
  {
    for (const Point<Dimension>& middle : middles)
    {
      double square = 0.0;
      std::int64_t rest = i;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const double at = (static_cast<double>(rest % cells) + 0.5) / static_cast<double>(cells);
        square += (at - middle[axis]) * (at - middle[axis]);
        rest /= cells;
      }
      const double inside = static_cast<double>(cells) * (radius - std::sqrt(square)) + 0.5;
      values[static_cast<std::size_t>(i)] += std::clamp(inside, 0.0, 1.0);
    }
  }
  return values;
}

template <int Dimension>
GridSize<Dimension> cubeOf(std::int64_t cells)
{
  GridSize<Dimension> size;
  size.fill(cells);
  return size;
}

template <int Dimension>
struct Pair
{
  Pair(const std::vector<double>& from, const std::vector<double>& to, std::int64_t cells)
    : Size(cubeOf<Dimension>(cells))
    , From(from.data(), this->Size)
    , To(to.data(), this->Size)
    , Map(PlacedDensity<Dimension>{ { this->Size, this->From }, {}, Sides() },
        PlacedDensity<Dimension>{ { this->Size, this->To }, {}, Sides() })
  {
    this->Map.Solve();
  }
  static Point<Dimension> Sides()
  {
    Point<Dimension> sides;
    sides.fill(1.0);
    return sides;
  }

  GridSize<Dimension> Size;
  DensityArray<Dimension, double> From;
  DensityArray<Dimension, double> To;
  OptimalMap<Dimension> Map;
};

// So many points a cell with mass, at random.
template <int Dimension>
std::vector<double> pointsIn(const std::vector<double>& values, std::int64_t cells)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.001, 0.999);
  std::vector<double> points;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    std::int64_t rest = static_cast<std::int64_t>(i);
    for (int axis = 0; axis < Dimension && values[i] > 0.5; ++axis)
    {
      points.push_back(static_cast<double>(rest % cells) + uniform(random));
      rest /= cells;
    }
  }
  return points;
}

// How far the points near a place move, in cells.
template <int Dimension>
std::vector<double> movesNear(const Point<Dimension>& middle, const std::vector<double>& points,
  const std::vector<double>& images, std::int64_t cells, double reach = radius)
{
  std::vector<double> moves;
  for (std::size_t i = 0; i < points.size(); i += Dimension)
  {
    double square = 0.0;
    double move = 0.0;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
    {
      const double way = points[i + axis] / static_cast<double>(cells) - middle[axis];
      square += way * way;
      move += std::pow(images[i + axis] - points[i + axis], 2);
    }
    if (square < reach * reach)
    {
      moves.push_back(std::sqrt(move));
    }
  }
  return moves;
}

template <int Dimension>
void checkThatOneStays(std::int64_t cells, double ground)
{
  Point<Dimension> still;
  Point<Dimension> away;
  still.fill(0.25);
  away.fill(0.7);
  Point<Dimension> there = away;
  there[1] = 0.45;
  const auto from = discs<Dimension>(cells, { still, away }, ground);
  const auto to = discs<Dimension>(cells, { still, there }, ground);
  const Pair<Dimension> pair(from, to, cells);
  const std::vector<double> points = pointsIn<Dimension>(from, cells);
  const FlowSeeds<Dimension> seeds(
    points.data(), static_cast<std::int64_t>(points.size()) / Dimension);
  for (const bool areSamples : { false, true })
  {
    std::vector<double> images(points.size());
    pair.Map.Forward(
      areSamples ? seeds.AsSamples() : seeds, { images.data(), seeds.Points().size() });
    const auto stay = movesNear<Dimension>(still, points, images, cells);
    EXPECT_EQ(*std::max_element(stay.begin(), stay.end()), 0.0);
    auto move = movesNear<Dimension>(away, points, images, cells);
    std::nth_element(move.begin(), move.begin() + move.size() / 2, move.end());
    EXPECT_NEAR(move[move.size() / 2], 0.25 * static_cast<double>(cells), 0.5);
  }
}

} // namespace

TEST(FixedCells, OneOfTwoDiscsStays)
{
  checkThatOneStays<2>(64, 0.0);
  checkThatOneStays<3>(24, 0.0);
  checkThatOneStays<2>(64, 1e-4);
}

// Mass of the ground crosses the disc, and the optimal map moves it: by the same part of the box
// whatever the grid, as no error of the grid does.
TEST(FixedCells, ADiscOnADenseGroundDoesNotStay)
{
  constexpr Point<2> still{ 0.25, 0.25 };
  std::vector<double> means; // in the box, of what is well within the disc
  for (const std::int64_t cells : { 64, 128 })
  {
    const auto from = discs<2>(cells, { still, { 0.7, 0.7 } }, 0.1);
    const auto to = discs<2>(cells, { still, { 0.7, 0.45 } }, 0.1);
    const Pair<2> pair(from, to, cells);
    const std::vector<double> points = pointsIn<2>(from, cells);
    std::vector<double> images(points.size());
    pair.Map.Forward({ points.data(), static_cast<std::int64_t>(points.size()) / 2 },
      { images.data(), static_cast<std::int64_t>(points.size()) / 2 });
    const auto moves = movesNear<2>(still, points, images, cells, 0.5 * radius);
    EXPECT_GT(*std::min_element(moves.begin(), moves.end()), 0.0);
    const double sum = std::accumulate(moves.begin(), moves.end(), 0.0);
    means.push_back(sum / static_cast<double>(moves.size()) / static_cast<double>(cells));
  }
  EXPECT_NEAR(means[0], means[1], 0.1 * means[1]);
}

// Up to their masses, and to the rounding of numbers of four bytes.
TEST(FixedCells, EqualDensitiesMoveNothing)
{
  constexpr std::int64_t cells = 40;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.3, 1.0);
  std::vector<double> from(cells * cells);
  std::generate(from.begin(), from.end(), [&]() { return std::max(0.0, uniform(random)); });
  for (const double factor : { 1.0, 3.0 })
  {
    std::vector<double> to(from.size());
    std::transform(from.begin(), from.end(), to.begin(),
      [=](double value) { return factor * static_cast<double>(static_cast<float>(value)); });
    const Pair<2> pair(from, to, cells);
    EXPECT_EQ(pair.Map.LowerBound(), 0.0);
    EXPECT_EQ(pair.Map.MassError(), 0.0);
    const std::vector<double> points = pointsIn<2>(from, cells);
    const auto count = static_cast<std::int64_t>(points.size()) / 2;
    std::vector<double> images(points.size());
    pair.Map.Forward(FlowSeeds<2>(points.data(), count).AsSamples(), { images.data(), count });
    EXPECT_EQ(images, points);
    pair.Map.Backward({ points.data(), count }, { images.data(), count });
    EXPECT_EQ(images, points);
  }
}

// Of masses from 1 to 1e-30, whose rounding moved points.
TEST(FixedCells, AMultipleOfABellMovesNothing)
{
  constexpr std::int64_t cells = 48;
  std::vector<double> from(cells * cells);
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    const double x = static_cast<double>(i % cells) - 20.0;
    const double y = static_cast<double>(i / cells) - 20.0;
    from[i] = std::exp(-(x * x + y * y) / 20.0);
  }
  for (const bool areFloats : { false, true })
  {
    std::vector<double> to(from.size());
    std::transform(from.begin(), from.end(), to.begin(), [areFloats](double value) {
      return areFloats ? static_cast<double>(static_cast<float>(3.0 * value)) : 3.0 * value;
    });
    const Pair<2> pair(from, to, cells);
    EXPECT_EQ(pair.Map.LowerBound(), 0.0);
    const std::vector<double> points = pointsIn<2>(from, cells);
    const auto count = static_cast<std::int64_t>(points.size()) / 2;
    std::vector<double> images(points.size());
    pair.Map.Forward(FlowSeeds<2>(points.data(), count).AsSamples(), { images.data(), count });
    EXPECT_EQ(images, points);
  }
}

TEST(FixedCells, AUniformDensityMovesNothing)
{
  const GridSize<2> size{ 20, 30 };
  const std::vector<double> values(600, 2.0);
  const DensityArray<2, double> array(values.data(), size);
  OptimalMap<2> map({ size, array }, { 1.0, 1.5 });
  map.Solve();
  std::vector<double> images(2 * 50);
  const std::vector<double> points = pointsIn<2>(std::vector<double>(50, 1.0), 10);
  map.Forward(FlowSeeds<2>(points.data(), 50).AsSamples(), { images.data(), 50 });
  EXPECT_EQ(images, points);
}

// A map that stretches most cells is sampled as often as others, about.
TEST(LimitedFineness, BoundsTheSamples)
{
  const NodeGrid<2> grid{ { 64, 48 }, { 1.0, 1.0 } };
  auto map = NodeMap<2>::On(grid);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(0.0, 64.0);
  std::uniform_real_distribution<double> y(0.0, 48.0);
  std::generate_n(map.Images[0].data(), grid.NumberOfNodes(), [&]() { return x(random); });
  std::generate_n(map.Images[1].data(), grid.NumberOfNodes(), [&]() { return y(random); });
  Progress progress{ Context() };
  const auto countWith = [&](const SampleFineness& fineness) {
    ImageSamples<2> samples(map, fineness);
    double visited = 0.0;
    double counted = 0.0;
    for (std::int64_t row = 0; row < ImageSamples<2>::NumberOfRows(grid); ++row)
    {
      samples.ForRow(row, nullptr, [&](const CellSample<2>&, const Point<2>&) { visited += 1.0; });
      counted += samples.CountRow(row, nullptr);
    }
    EXPECT_EQ(counted, visited);
    return counted / static_cast<double>(grid.NumberOfCells());
  };
  EXPECT_GT(countWith({}), 100.0);
  const SampleFineness limited = limitFineness<2>(map, nullptr, {}, progress);
  EXPECT_LT(countWith(limited), 6.0);
  EXPECT_GE(countWith(limited), 1.0);
  writeGradientMap<2>(std::vector<double>(65 * 49, 0.0).data(), map, progress);
  EXPECT_EQ(limitFineness<2>(map, nullptr, {}, progress).Each, 1.0);
}

} // namespace RectifiedTransport

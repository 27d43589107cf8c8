// SPDX-License-Identifier: BSD-3-Clause
// The upper bound: never below closed forms, whatever the map; near them for the right map; 0 where
// nothing has to move.
#include "Core/OptimalMap/CouplingCost.h"

#include "OptimalMap/Masses/ParticleMasses.h"
#include "RecordingContext.h"
#include "TestDimensions.h"
#include "TestRefusal.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

namespace RectifiedTransport
{
namespace
{

// The mass below each face of cells.
std::vector<double> massesBelow(const std::vector<double>& values)
{
  std::vector<double> below{ 0.0 };
  const double total = std::accumulate(values.begin(), values.end(), 0.0);
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
    below.push_back(std::min(sum / total, 1.0));
  }
  below.back() = 1.0;
  return below;
}

// The least cost between two piecewise constant densities on [0, length]: the integral of the
// squared difference of their quantiles, which are linear between all masses below faces.
double leastCost(const std::vector<double>& f, const std::vector<double>& g, double length)
{
  const std::vector<double> a = massesBelow(f);
  const std::vector<double> b = massesBelow(g);
  const auto quantile = [&](const std::vector<double>& below, std::size_t cell, double mass) {
    const double place = (mass - below[cell]) / (below[cell + 1] - below[cell]);
    return length * (static_cast<double>(cell) + place) / static_cast<double>(below.size() - 1);
  };
  double cost = 0.0;
  double mass = 0.0;
  for (std::size_t i = 0, j = 0; i < f.size() && j < g.size();)
  {
    const double next = std::min(a[i + 1], b[j + 1]);
    if (next > mass)
    {
      const double p = quantile(a, i, mass) - quantile(b, j, mass);
      const double q = quantile(a, i, next) - quantile(b, j, next);
      cost += (next - mass) * (p * p + p * q + q * q) / 3.0;
      mass = next;
    }
    (a[i + 1] <= b[j + 1] ? i : j) += 1;
  }
  return cost;
}

// The place, from 0 to the number of cells, below which a density has so much mass.
double quantileOf(const std::vector<double>& values, double mass)
{
  const std::vector<double> below = massesBelow(values);
  std::size_t cell = 0;
  while (cell + 2 < below.size() && (below[cell + 1] < mass || below[cell + 1] == below[cell]))
  {
    ++cell;
  }
  return static_cast<double>(cell) +
    std::clamp((mass - below[cell]) / (below[cell + 1] - below[cell]), 0.0, 1.0);
}

// Images of the nodes, whose places and images are given from 0 to 1.
template <int D>
NodeMap<D> mapOf(const GridSize<D>& nodeCells, const Point<D>& lengths,
  const std::function<double(int, double)>& image)
{
  NodeMap<D> map;
  map.Grid.Cells = nodeCells;
  for (int axis = 0; axis < D; ++axis)
  {
    const auto cells = static_cast<double>(nodeCells[axis]);
    map.Grid.Spacing[axis] = lengths[axis] / cells;
    NodeValues& images = map.Images[static_cast<std::size_t>(axis)];
    images = NodeValues(map.Grid.NumberOfNodes());
    const std::int64_t stride = map.Grid.Stride(axis);
    for (std::int64_t node = 0; node < images.size(); ++node)
    {
      const auto at = static_cast<double>(node / stride % (nodeCells[axis] + 1));
      images.data()[node] = cells * image(axis, at / cells);
    }
  }
  return map;
}

template <int D>
NodeMap<D> identity(const GridSize<D>& nodeCells, const Point<D>& lengths)
{
  return mapOf<D>(nodeCells, lengths, [](int, double x) { return x; });
}

template <int D>
NodeMap<D> copyOf(const NodeMap<D>& map)
{
  auto copy = NodeMap<D>::On(map.Grid);
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    std::copy_n(map.Images[axis].data(), map.Images[axis].size(), copy.Images[axis].data());
  }
  return copy;
}

template <int D>
double costOf(const CellDensity<D>& source, const CellDensity<D>& target, const NodeMap<D>& map,
  const Executor& threads = SerialExecutor())
{
  Progress progress(threads);
  const CouplingCost cost = couplingCost<D>(source, target, copyOf(map), progress);
  EXPECT_GE(cost.OfSpread, 0.0);
  EXPECT_LE(cost.OfSpread, cost.All * (1.0 + 1e-12));
  return cost.All;
}

template <int D>
Point<D> someLengths()
{
  Point<D> lengths;
  for (int axis = 0; axis < D; ++axis)
  {
    lengths[axis] = axis == 0 ? 1.7 : 0.6 * axis;
  }
  return lengths;
}

template <int D>
double squaredDiagonal(const Point<D>& lengths)
{
  return std::inner_product(lengths.begin(), lengths.end(), lengths.begin(), 0.0);
}

// Factors of separable densities: random, with zeros, of large contrast, bumps, one cell, steps.
std::vector<double> someLine(std::int64_t cells, std::mt19937_64& engine)
{
  std::vector<double> line(static_cast<std::size_t>(cells));
  const auto kind = engine() % 7;
  const double centre = uniformNumber(engine);
  const auto one = static_cast<std::size_t>(centre * static_cast<double>(cells));
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(cells) - centre;
    const double random = uniformNumber(engine);
    const double values[] = { 0.1 + random, random < 0.5 ? 0.0 : random,
      std::pow(10.0, -16.0 * random), std::exp(-40.0 * x * x), i == one ? 1.0 : 0.0,
      x < 0.0 || i == 0 ? 1.0 : 0.0, 1.0 };
    line[i] = values[kind];
  }
  line[one] += line[one] == 0.0 ? 1.0 : 0.0;
  return line;
}

template <class T>
using CouplingCosts = DimensionTest<T>;
TYPED_TEST_SUITE(CouplingCosts, Dimensions, );

TYPED_TEST(CouplingCosts, IsNoneWhereNothingMoves)
{
  constexpr int D = TypeParam::value;
  const Point<D> lengths = someLengths<D>();
  const GridSize<D> size = sizeFor<D>({ 40 }, { 26, 18 }, { 10, 6, 8 });
  for (const TestDensity<D>& values :
    { twoGaussians<D>(size), randomCells<D>(size), discWithHole<D>(size), checker<D>(size, 2) })
  {
    const CellDensity<D> density = cellDensity(values);
    EXPECT_EQ(costOf<D>(density, density, identity<D>(size, lengths)), 0.0);
  }
  const CellDensity<D> uniform(size);
  EXPECT_EQ(costOf<D>(uniform, uniform, identity<D>(size, lengths)), 0.0);
  // Nodes that are not at the cells' corners.
  const GridSize<D> odd = sizeFor<D>({ 41 }, { 27, 15 }, { 9, 7, 5 });
  const CellDensity<D> density = cellDensity(twoGaussians<D>(odd));
  const GridSize<D> nodes = sizeFor<D>({ 42 }, { 14, 16 }, { 10, 8, 6 });
  EXPECT_LT(
    costOf<D>(density, density, identity<D>(nodes, lengths)), 1e-12 * squaredDiagonal<D>(lengths));
}

TYPED_TEST(CouplingCosts, IsNotBelowClosedFormsForAnyMap)
{
  constexpr int D = TypeParam::value;
  std::mt19937_64 engine(11);
  double total = 0.0;
  double right = 0.0;
  for (int test = 0; test < 60; ++test)
  {
    const Point<D> lengths = test % 3 == 0 ? evenPoint<D>(1.0) : someLengths<D>();
    SeparableDensity<D> f;
    SeparableDensity<D> g;
    GridSize<D> size;
    GridSize<D> nodes;
    double exact = 0.0;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      size[axis] = static_cast<std::int64_t>(1 + engine() % (D == 1 ? 90 : D == 2 ? 30 : 12));
      nodes[axis] = std::max<std::int64_t>(2, size[axis] + size[axis] % 2);
      f.Factors[axis] = someLine(size[axis], engine);
      g.Factors[axis] = someLine(size[axis], engine);
      exact += leastCost(f.Factors[axis], g.Factors[axis], lengths[axis]);
    }
    const CellDensity<D> source = cellDensity(f.Density());
    const CellDensity<D> target = cellDensity(g.Density());
    const double diagonal = squaredDiagonal<D>(lengths);
    const double least = exact - 1e-12 * diagonal;
    SCOPED_TRACE("case " + std::to_string(test));
    EXPECT_GE(costOf<D>(source, target, identity<D>(nodes, lengths)), least);
    // The optimal one.
    const double cost = costOf<D>(source, target, mapOf<D>(nodes, lengths, [&](int axis, double x) {
      const auto a = static_cast<std::size_t>(axis);
      const auto cells = static_cast<double>(size[axis]);
      const std::vector<double> below = massesBelow(f.Factors[a]);
      const auto cell = std::min(static_cast<std::size_t>(x * cells), below.size() - 2);
      const double place = x * cells - static_cast<double>(cell);
      const double mass = below[cell] + place * (below[cell + 1] - below[cell]);
      return quantileOf(g.Factors[a], mass) / cells;
    }));
    EXPECT_GE(cost, least);
    total += exact;
    right += cost;
    // Turned round, and into a corner.
    const double turned =
      costOf<D>(source, target, mapOf<D>(nodes, lengths, [](int, double x) { return 1.0 - x; }));
    EXPECT_GE(turned, least);
    EXPECT_LE(turned, diagonal);
    const double collapsed =
      costOf<D>(source, target, mapOf<D>(nodes, lengths, [](int, double) { return 0.0; }));
    EXPECT_GE(collapsed, least);
    EXPECT_LE(collapsed, diagonal);
  }
  EXPECT_LT(right, (D == 3 ? 1.2 : 1.1) * total);
}

TYPED_TEST(CouplingCosts, IsNearTheLeastForSmoothDensities)
{
  constexpr int D = TypeParam::value;
  const std::int64_t side = D == 1 ? 200 : D == 2 ? 80 : 24;
  const GridSize<D> size = evenSize<D>(side);
  SeparableDensity<D> f;
  SeparableDensity<D> g;
  double exact = 0.0;
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    for (std::int64_t i = 0; i < side; ++i)
    {
      const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(side);
      f.Factors[axis].push_back(0.3 + std::exp(-30.0 * (x - 0.3) * (x - 0.3)));
      g.Factors[axis].push_back(0.3 + std::exp(-20.0 * (x - 0.7) * (x - 0.7)));
    }
    exact += leastCost(f.Factors[axis], g.Factors[axis], 1.0);
  }
  const CellDensity<D> source = cellDensity(f.Density());
  const CellDensity<D> target = cellDensity(g.Density());
  const auto image = [&](int axis, double x) {
    const auto a = static_cast<std::size_t>(axis);
    const std::vector<double> below = massesBelow(f.Factors[a]);
    const auto cell = std::min(static_cast<std::size_t>(x * static_cast<double>(side) + 1e-9),
      static_cast<std::size_t>(side - 1));
    const double place = x * static_cast<double>(side) - static_cast<double>(cell);
    const double mass = below[cell] + place * (below[cell + 1] - below[cell]);
    return quantileOf(g.Factors[a], mass) / static_cast<double>(side);
  };
  const double cost = costOf<D>(source, target, mapOf<D>(size, evenPoint<D>(1.0), image));
  EXPECT_GE(cost, exact);
  EXPECT_LT(cost, (D == 3 ? 1.03 : 1.005) * exact);
  // The corrections take most of the errors of a map away.
  const double wrong =
    costOf<D>(source, target, mapOf<D>(size, evenPoint<D>(1.0), [&](int axis, double x) {
      return std::clamp(image(axis, x) + 0.02 * std::sin(6.0 * x), 0.0, 1.0);
    }));
  EXPECT_GE(wrong, exact);
  EXPECT_LT(wrong, (D == 3 ? 1.05 : 1.02) * exact);
}

// A translation by whole cells costs its squared length.
TYPED_TEST(CouplingCosts, OfATranslation)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = evenSize<D>(24);
  TestDensity<D> from = uniformDensity<D>(size, 0.0);
  TestDensity<D> to = from;
  const TestDensity<D> values = randomCells<D>(size, 0.1);
  for (std::int64_t cell = 0; cell < cellCount<D>(size); ++cell)
  {
    GridSize<D> place = cellAt<D>(cell, size);
    if (std::all_of(place.begin(), place.end(), [](std::int64_t x) { return x < 12; }))
    {
      from.Values[static_cast<std::size_t>(cell)] = values.Values[static_cast<std::size_t>(cell)];
      place[0] += 9;
      to.Values[static_cast<std::size_t>(cellIndex<D>(place, size))] =
        values.Values[static_cast<std::size_t>(cell)];
    }
  }
  const NodeMap<D> map = mapOf<D>(size, evenPoint<D>(1.0),
    [&](int axis, double x) { return axis == 0 ? std::min(x + 9.0 / 24.0, 1.0) : x; });
  const double exact = 9.0 / 24.0 * 9.0 / 24.0;
  EXPECT_NEAR(costOf<D>(cellDensity(from), cellDensity(to), map), exact, 1e-12);
}

TYPED_TEST(CouplingCosts, SameBitsForEveryNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 300 }, { 64, 48 }, { 20, 16, 18 });
  const CellDensity<D> source = cellDensity(discWithHole<D>(size));
  const CellDensity<D> target = cellDensity(randomCells<D>(size));
  const NodeMap<D> map = identity<D>(size, someLengths<D>());
  const double expected = costOf<D>(source, target, map);
  for (const int threads : { 1, 2, 3, 7 })
  {
    EXPECT_EQ(costOf<D>(source, target, map, ThreadsExecutor(threads)), expected) << threads;
  }
}

TYPED_TEST(CouplingCosts, RefusesDensitiesOfOtherSizes)
{
  constexpr int D = TypeParam::value;
  const CellDensity<D> source(evenSize<D>(8));
  const CellDensity<D> target(evenSize<D>(9));
  EXPECT_EQ(
    refusal([&]() { costOf<D>(source, target, identity<D>(evenSize<D>(8), evenPoint<D>(1.0))); }),
    "A coupling's cost needs densities of the same size.");
}

TYPED_TEST(CouplingCosts, ReportsAndCancels)
{
  constexpr int D = TypeParam::value;
  const GridSize<D> size = sizeFor<D>({ 40000 }, { 200, 200 }, { 34, 34, 34 });
  const CellDensity<D> source = cellDensity(twoGaussians<D>(size));
  const CellDensity<D> target = cellDensity(randomCells<D>(size));
  const NodeMap<D> map = identity<D>(size, someLengths<D>());
  const ThreadsExecutor threads(2);
  RecordingContext recording(threads);
  const auto run = [&]() {
    Progress progress(recording.Context());
    progress.Expect(source.NumberOfCells());
    couplingCost<D>(source, target, copyOf(map), progress);
  };
  run();
  recording.ExpectReported(0.0, 1.0);
  const int queries = recording.Queries;
  EXPECT_GT(queries, 20);
  for (const int most : { 0, queries / 4, queries / 2 })
  {
    recording.Queries = 0;
    recording.MaximumQueries = most;
    EXPECT_THROW(run(), Cancelled);
  }
}

} // namespace
} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
// The cost transform against minima over all pairs of nodes.
#include "Core/OptimalMap/Nodes/CostTransform.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/Progress.h"
#include "TestDimensions.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
using CostTransform = DimensionTest<T>;
TYPED_TEST_SUITE(CostTransform, Dimensions, );

template <int Dimension>
Point<Dimension> nodeAt(const NodeGrid<Dimension>& grid, std::int64_t node)
{
  Point<Dimension> point;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    point[axis] = static_cast<double>(node % (grid.Cells[axis] + 1)) * grid.Spacing[axis];
    node /= grid.Cells[axis] + 1;
  }
  return point;
}

template <int Dimension>
double costBetween(const NodeGrid<Dimension>& grid, std::int64_t x, std::int64_t y)
{
  const Point<Dimension> a = nodeAt<Dimension>(grid, x);
  const Point<Dimension> b = nodeAt<Dimension>(grid, y);
  double sum = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  }
  return 0.5 * sum;
}

// For one y: the least value, and the first x that has it.
struct Least
{
  double Value = infinity;
  std::int64_t Node = -1;
};

template <int Dimension>
Least leastOfAll(const NodeGrid<Dimension>& grid, const std::vector<double>& from, std::int64_t y)
{
  Least least;
  for (std::int64_t x = 0; x < grid.NumberOfNodes(); ++x)
  {
    const double value = costBetween<Dimension>(grid, x, y) - from[static_cast<std::size_t>(x)];
    if (value < least.Value)
    {
      least = { value, x };
    }
  }
  return least;
}

double diagonalOf(const std::vector<double>& sides)
{
  double sum = 0.0;
  for (const double side : sides)
  {
    sum += side * side;
  }
  return sum;
}

template <int Dimension>
double squaredDiagonal(const NodeGrid<Dimension>& grid)
{
  std::vector<double> sides;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    sides.push_back(static_cast<double>(grid.Cells[axis]) * grid.Spacing[axis]);
  }
  return diagonalOf(sides);
}

std::vector<double> randomValues(std::int64_t count, double scale, std::uint64_t seed)
{
  std::vector<double> values;
  for (std::int64_t i = 0; i < count; ++i)
  {
    values.push_back(scale * unitReal(randomWord(seed, static_cast<std::uint64_t>(i))));
  }
  return values;
}

template <int Dimension>
std::vector<double> transformOf(const NodeGrid<Dimension>& grid, const std::vector<double>& from,
  const Context& context = Context(SerialExecutor()))
{
  Progress progress(context);
  progress.Expect(Dimension * grid.NumberOfNodes());
  std::vector<double> to(from.size());
  costTransform<Dimension>(grid, from.data(), to.data(), progress);
  return to;
}

template <int Dimension>
std::vector<std::int64_t> minimizersOf(
  const NodeGrid<Dimension>& grid, const std::vector<double>& from, const Context& context)
{
  Progress progress(context);
  progress.Expect(Dimension * grid.NumberOfNodes());
  std::vector<std::int64_t> minimizers(from.size());
  costMinimizers<Dimension>(grid, from.data(), minimizers.data(), progress);
  return minimizers;
}

// Smooth and rough, nearly concave and far from it, and the least grids.
template <int Dimension>
std::vector<NodeGrid<Dimension>> gridsOf()
{
  const Point<1> wide = { 0.3 };
  const Point<2> wide2 = { 0.3, 2.0 };
  const Point<3> wide3 = { 0.3, 2.0, 0.05 };
  const Point<Dimension> unequal = std::get<Point<Dimension>>(std::make_tuple(wide, wide2, wide3));
  Point<Dimension> unit;
  unit.fill(1.0);
  return { { sizeFor<Dimension>({ 40 }, { 12, 18 }, { 6, 10, 8 }), unequal },
    { sizeFor<Dimension>({ 2 }, { 2, 2 }, { 2, 2, 2 }), unequal },
    { sizeFor<Dimension>({ 200 }, { 2, 30 }, { 2, 12, 2 }), unit },
    { sizeFor<Dimension>({ 66 }, { 30, 2 }, { 10, 2, 6 }), unequal } };
}

template <int Dimension>
void expectLeast(const NodeGrid<Dimension>& grid, const std::vector<double>& from)
{
  double largest = squaredDiagonal<Dimension>(grid);
  for (const double value : from)
  {
    largest = std::max(largest, std::abs(value));
  }
  const std::vector<double> to = transformOf<Dimension>(grid, from);
  std::vector<double> inPlace = from;
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  costTransform<Dimension>(grid, inPlace.data(), inPlace.data(), progress);
  EXPECT_EQ(inPlace, to);
  for (std::int64_t y = 0; y < grid.NumberOfNodes(); ++y)
  {
    EXPECT_NEAR(
      to[static_cast<std::size_t>(y)], leastOfAll<Dimension>(grid, from, y).Value, 4e-16 * largest)
      << y;
  }
}

TYPED_TEST(CostTransform, IsTheLeastOfAll)
{
  constexpr int D = TypeParam::value;
  for (const NodeGrid<D>& grid : gridsOf<D>())
  {
    const double spacing = *std::min_element(grid.Spacing.begin(), grid.Spacing.end());
    const double own = spacing * spacing;
    // From the convexity of less than a cell to many nodes that serve nowhere.
    for (const double scale : { 0.0, 0.1 * own, own, 10.0 * own, squaredDiagonal<D>(grid), 1e6 })
    {
      SCOPED_TRACE(scale);
      expectLeast<D>(grid, randomValues(grid.NumberOfNodes(), scale, 1));
    }
    std::vector<double> smooth;
    for (std::int64_t node = 0; node < grid.NumberOfNodes(); ++node)
    {
      double sum = 0.0;
      for (const double x : nodeAt<D>(grid, node))
      {
        sum += std::cos(7.0 * x);
      }
      smooth.push_back(sum);
    }
    expectLeast<D>(grid, smooth);
    // Where one node serves all others, the transform of the result is of equal changes.
    std::vector<double> peak(smooth.size(), 0.0);
    peak[peak.size() / 3] = squaredDiagonal<D>(grid);
    expectLeast<D>(grid, peak);
    expectLeast<D>(grid, transformOf<D>(grid, peak));
  }
}

// Three transforms are one.
TYPED_TEST(CostTransform, TwiceIsTheLeastConcaveMajorant)
{
  constexpr int D = TypeParam::value;
  for (const NodeGrid<D>& grid : gridsOf<D>())
  {
    const double rounding = 1e-15 * squaredDiagonal<D>(grid);
    const auto from = randomValues(grid.NumberOfNodes(), 0.3 * squaredDiagonal<D>(grid), 2);
    const auto once = transformOf<D>(grid, from);
    const auto twice = transformOf<D>(grid, once);
    const auto thrice = transformOf<D>(grid, twice);
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      EXPECT_GE(twice[i], from[i] - rounding);
      EXPECT_NEAR(thrice[i], once[i], rounding);
    }
  }
}

TYPED_TEST(CostTransform, MinimizersAttainTheLeast)
{
  constexpr int D = TypeParam::value;
  const ThreadsExecutor threads(2);
  for (const NodeGrid<D>& grid : gridsOf<D>())
  {
    for (const std::uint64_t missing : { 0, 2, 9 })
    {
      auto from = randomValues(grid.NumberOfNodes(), 0.2 * squaredDiagonal<D>(grid), 3);
      for (std::size_t i = 0; i < from.size(); ++i)
      {
        if (i != 1 && randomWord(4, i) % 10 < missing)
        {
          from[i] = -infinity;
        }
      }
      const auto minimizers = minimizersOf<D>(grid, from, threads);
      for (std::int64_t y = 0; y < grid.NumberOfNodes(); ++y)
      {
        const std::int64_t x = minimizers[static_cast<std::size_t>(y)];
        EXPECT_NEAR(costBetween<D>(grid, x, y) - from[static_cast<std::size_t>(x)],
          leastOfAll<D>(grid, from, y).Value, 1e-15 * squaredDiagonal<D>(grid))
          << y;
      }
    }
  }
}

// Small whole numbers and powers of two, whose sums are exact.
TYPED_TEST(CostTransform, FirstOfSeveralMinimizers)
{
  constexpr int D = TypeParam::value;
  for (NodeGrid<D> grid : gridsOf<D>())
  {
    for (int axis = 0; axis < D; ++axis)
    {
      grid.Spacing[axis] = axis == 1 ? 0.5 : 1.0;
    }
    std::vector<double> from = randomValues(grid.NumberOfNodes(), 20.0, 5);
    for (double& value : from)
    {
      value = value < 4.0 ? -infinity : 0.5 * std::floor(value);
    }
    from[from.size() / 2] = 3.0;
    const auto minimizers = minimizersOf<D>(grid, from, Context());
    for (std::int64_t y = 0; y < grid.NumberOfNodes(); ++y)
    {
      EXPECT_EQ(minimizers[static_cast<std::size_t>(y)], leastOfAll<D>(grid, from, y).Node) << y;
    }
  }
}

TYPED_TEST(CostTransform, OneNodeServesAll)
{
  constexpr int D = TypeParam::value;
  for (const NodeGrid<D>& grid : gridsOf<D>())
  {
    for (const std::int64_t only : { std::int64_t{ 0 }, grid.NumberOfNodes() / 2 })
    {
      std::vector<double> from(static_cast<std::size_t>(grid.NumberOfNodes()), -infinity);
      from[static_cast<std::size_t>(only)] = 1.0;
      for (const std::int64_t x : minimizersOf<D>(grid, from, Context()))
      {
        EXPECT_EQ(x, only);
      }
    }
  }
}

TYPED_TEST(CostTransform, SameBitsOnEveryNumberOfThreads)
{
  constexpr int D = TypeParam::value;
  const NodeGrid<D> grid = { sizeFor<D>({ 70000 }, { 302, 270 }, { 42, 50, 38 }), { 0.25 } };
  NodeGrid<D> filled = grid;
  filled.Spacing.fill(0.25);
  const auto from = randomValues(grid.NumberOfNodes(), 10.0, 6);
  const auto expected = transformOf<D>(filled, from);
  const auto nodes = minimizersOf<D>(filled, from, Context());
  for (const int count : { 1, 2, 3 })
  {
    const ThreadsExecutor threads(count);
    EXPECT_EQ(transformOf<D>(filled, from, threads), expected) << count;
    EXPECT_EQ(minimizersOf<D>(filled, from, threads), nodes) << count;
  }
}

TYPED_TEST(CostTransform, FillsItsStageAndStops)
{
  constexpr int D = TypeParam::value;
  NodeGrid<D> grid = { sizeFor<D>({ 900 }, { 60, 80 }, { 20, 30, 40 }), {} };
  grid.Spacing.fill(1.0);
  const std::vector<double> from(static_cast<std::size_t>(grid.NumberOfNodes()), 0.0);
  std::vector<double> heard;
  const SerialExecutor serial;
  transformOf<D>(grid, from, Context(serial, [&](double done) { heard.push_back(done); }));
  EXPECT_EQ(heard.size(), static_cast<std::size_t>(D));
  EXPECT_EQ(heard.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  const Context cancelled(serial, {}, [] { return true; });
  EXPECT_THROW(transformOf<D>(grid, from, cancelled), Cancelled);
  EXPECT_THROW(minimizersOf<D>(grid, from, cancelled), Cancelled);
}

} // namespace
} // namespace RectifiedTransport

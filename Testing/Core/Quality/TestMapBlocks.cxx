// SPDX-License-Identifier: BSD-3-Clause
// The errors of blocks of maps that are known: against closed forms, and against sums over many
// points; the same for threads, ranks and densities in several layers.
#include "Core/Quality/MapBlocks.h"

#include "Core/Parallel/Progress.h"
#include "Core/Quality/BoundaryIntegrals.h"
#include "Core/Tables/DensityShare.h"

#include "TestDensities.h"
#include "TestDimensions.h"
#include "TestFlow.h"
#include "TestTiles.h"
#include "ThreadRanks.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
using Map = std::function<Point<Dimension>(const Point<Dimension>&)>;

template <int Dimension>
Points<Dimension> mapped(const GridSize<Dimension>& size, const GridSize<Dimension>& lattice,
  const NotDeduced<Map<Dimension>>& map)
{
  Points<Dimension> positions = latticePoints<Dimension>(size, lattice);
  std::transform(positions.begin(), positions.end(), positions.begin(), map);
  return positions;
}

template <int Dimension>
BlockErrors errorsOf(const DensitySource<Dimension>& density, double total,
  const MapSamples<Dimension>& samples, FlowDirection direction, const Context& context = Context())
{
  Progress progress(context);
  return measureBlocks<Dimension>(samples, density, total, direction, progress);
}

template <int Dimension>
BlockErrors errorsOf(const TestDensity<Dimension>& density, const GridSize<Dimension>& lattice,
  const NotDeduced<Map<Dimension>>& map, FlowDirection direction,
  const Context& context = Context())
{
  const auto whole = LatticePart<Dimension>::WholeOf(lattice);
  const Points<Dimension> positions = mapped<Dimension>(density.Size, lattice, map);
  return errorsOf<Dimension>(density.Source(),
    std::accumulate(density.Values.begin(), density.Values.end(), 0.0),
    { lattice, whole, whole, positions }, direction, context);
}

template <int Dimension>
TestDensity<Dimension> randomDensity(const GridSize<Dimension>& size, double least = 0.2)
{
  std::mt19937_64 engine(3);
  return sampleDensity<Dimension>(
    size, [&](const Point<Dimension>&) { return least + uniformNumber(engine); });
}

template <class T>
class MapBlocksTest : public testing::Test
{
};
TYPED_TEST_SUITE(MapBlocksTest, Dimensions);

TYPED_TEST(MapBlocksTest, BelongToOneRank)
{
  constexpr int D = TypeParam::value;
  const auto lattice = sizeFor<D>({ 30 }, { 30, 17 }, { 13, 9, 22 });
  const auto whole = LatticePart<D>::WholeOf(lattice);
  const LatticePart<D> all = MapBlocks<D>::Of(lattice, whole);
  EXPECT_EQ(
    all.Count(), (sizeFor<D>({ 7 }, { 7, 4 }, { 3, 2, 5 }) == all.Cells ? all.Count() : -1));
  for (const std::int64_t cut : { 1, 4, 5, 8 })
  {
    LatticePart<D> low = whole;
    LatticePart<D> high = whole;
    low.Cells[0] = cut;
    high.Low[0] = cut;
    high.Cells[0] -= cut;
    const LatticePart<D> below = MapBlocks<D>::Of(lattice, low);
    const LatticePart<D> above = MapBlocks<D>::Of(lattice, high);
    EXPECT_EQ(below.Count() + above.Count(), all.Count());
    EXPECT_EQ(above.Low[0], below.End(0));
    const LatticePart<D> samples = MapBlocks<D>::SamplesOf(below);
    EXPECT_EQ(samples.Cells[0], 4 * below.Cells[0] + 1);
    EXPECT_TRUE(whole.Contains(samples));
  }
}

// Half of the mass is in the image of each block of a uniform density, and twice its measure.
TYPED_TEST(MapBlocksTest, MapsThatScale)
{
  constexpr int D = TypeParam::value;
  const auto size = sizeFor<D>({ 40 }, { 24, 30 }, { 12, 9, 14 });
  const auto density = uniformDensity<D>(size);
  for (const auto& lattice : { size, sizeFor<D>({ 23 }, { 61, 17 }, { 9, 20, 5 }),
         sizeFor<D>({ 5 }, { 5, 5 }, { 5, 5, 5 }) })
  {
    for (const double factor : { 0.25, 0.5, 1.0 })
    {
      const Map<D> scale = [&](Point<D> x) {
        x[0] *= factor;
        return x;
      };
      for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
      {
        const BlockErrors found = errorsOf<D>(density, lattice, scale, direction);
        EXPECT_NEAR(found.Quantile, 1.0 - factor, 1e-12);
        EXPECT_NEAR(found.Largest, 1.0 - factor, 1e-12);
      }
    }
  }
}

// The identity leaves each block its measure.
TYPED_TEST(MapBlocksTest, MassesOfBlocks)
{
  constexpr int D = TypeParam::value;
  const auto size = sizeFor<D>({ 50 }, { 20, 26 }, { 11, 14, 10 });
  const auto lattice = sizeFor<D>({ 31 }, { 33, 14 }, { 14, 9, 12 });
  const auto density = randomDensity<D>(size);
  const double total = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  const auto blocks = MapBlocks<D>::Of(lattice, LatticePart<D>::WholeOf(lattice));
  const Point<D> step = latticeStep<D>(lattice, size);
  double backward = 0.0;
  double forward = 0.0;
  for (std::int64_t i = 0; i < blocks.Count(); ++i)
  {
    const GridSize<D> block = blocks.CellOf(i);
    Point<D> low;
    Point<D> high;
    double measure = 1.0;
    for (int a = 0; a < D; ++a)
    {
      low[a] = (4.0 * static_cast<double>(block[a]) + 0.5) * step[a];
      high[a] = low[a] + 4.0 * step[a];
      measure *= 4.0 * step[a] / static_cast<double>(size[a]);
    }
    const RectifiedFlow<D> flow(density.Source());
    const double share = flow.Share(low, high);
    backward = std::max(backward, std::abs(measure - share) / share);
    forward = std::max(forward, std::abs(share - measure) / measure);
  }
  const Map<D> identity = [](const Point<D>& x) { return x; };
  ASSERT_GT(total, 0.0);
  EXPECT_NEAR(
    errorsOf<D>(density, lattice, identity, FlowDirection::Backward).Largest, backward, 1e-11);
  EXPECT_NEAR(
    errorsOf<D>(density, lattice, identity, FlowDirection::Forward).Largest, forward, 1e-11);
}

// One thin cell takes its block out, not those beside it.
TYPED_TEST(MapBlocksTest, ThinBlocks)
{
  constexpr int D = TypeParam::value;
  const auto size = evenSize<D>(13);
  auto density = uniformDensity<D>(size);
  const Map<D> identity = [](const Point<D>& x) { return x; };
  const auto largest = [&](double value) {
    auto changed = density;
    changed.Values[static_cast<std::size_t>(cellIndex<D>(evenSize<D>(6), size))] = value;
    return errorsOf<D>(changed, size, identity, FlowDirection::Backward).Largest;
  };
  // The mean is nearly 1; of the other blocks the measure is off by that.
  const double cells = static_cast<double>(cellCount<D>(size));
  const double whole = std::pow(4.0, D);
  EXPECT_NEAR(largest(0.0), 1.0 / cells, 1e-9);
  EXPECT_NEAR(largest(0.045), 0.955 / cells, 1e-9);
  const double mean = (cells - 0.9) / cells;
  EXPECT_NEAR(largest(0.1), mean * whole / (whole - 0.9) - 1.0, 1e-9);
  // No block is left, or none fits.
  density.Values.assign(density.Values.size(), 0.0);
  density.Values[0] = 1.0;
  for (const BlockErrors& none : { errorsOf<D>(density, size, identity, FlowDirection::Backward),
         errorsOf<D>(density, evenSize<D>(4), identity, FlowDirection::Forward) })
  {
    EXPECT_TRUE(std::isnan(none.Quantile));
    EXPECT_TRUE(std::isnan(none.Largest));
  }
}

// A map that mirrors has the measures and masses of the identity, with the other sign.
TYPED_TEST(MapBlocksTest, MapsThatTurnOver)
{
  constexpr int D = TypeParam::value;
  const auto size = sizeFor<D>({ 40 }, { 24, 30 }, { 12, 9, 14 });
  const auto density = uniformDensity<D>(size);
  for (int axis = 0; axis < D; ++axis)
  {
    const Map<D> mirror = [&](Point<D> x) {
      x[axis] = static_cast<double>(size[axis]) - x[axis];
      return x;
    };
    for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
    {
      EXPECT_NEAR(errorsOf<D>(density, size, mirror, direction).Quantile, 2.0, 1e-12);
    }
  }
}

// An affine map takes a block to a parallelepiped; its mass by many points.
template <int Dimension>
void checkSkewBlocks(const GridSize<Dimension>& size, const GridSize<Dimension>& lattice,
  std::int64_t pointsAnAxis, double tolerance)
{
  const auto density = randomDensity<Dimension>(size, 0.05);
  const double total = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  const double turn[3][3] = { { 0.5, 0.17, -0.13 }, { -0.2, 0.55, 0.1 }, { 0.15, -0.12, 0.6 } };
  const Map<Dimension> skew = [&](const Point<Dimension>& x) {
    Point<Dimension> y;
    for (int a = 0; a < Dimension; ++a)
    {
      y[a] = 0.5 * static_cast<double>(size[a]);
      for (int b = 0; b < Dimension; ++b)
      {
        y[a] += turn[a][b] * (x[b] - 0.5 * static_cast<double>(size[b]));
      }
    }
    return y;
  };
  const double determinant = Dimension == 2
    ? turn[0][0] * turn[1][1] - turn[0][1] * turn[1][0]
    : turn[0][0] * (turn[1][1] * turn[2][2] - turn[1][2] * turn[2][1]) -
      turn[0][1] * (turn[1][0] * turn[2][2] - turn[1][2] * turn[2][0]) +
      turn[0][2] * (turn[1][0] * turn[2][1] - turn[1][1] * turn[2][0]);
  const auto blocks = MapBlocks<Dimension>::Of(lattice, LatticePart<Dimension>::WholeOf(lattice));
  const Point<Dimension> step = latticeStep<Dimension>(lattice, size);
  const auto inBlock = LatticePart<Dimension>::WholeOf(evenSize<Dimension>(pointsAnAxis));
  double largest = 0.0;
  for (std::int64_t i = 0; i < blocks.Count(); ++i)
  {
    const GridSize<Dimension> block = blocks.CellOf(i);
    double mean = 0.0;
    for (std::int64_t k = 0; k < inBlock.Count(); ++k)
    {
      const GridSize<Dimension> place = inBlock.CellOf(k);
      Point<Dimension> x;
      for (int a = 0; a < Dimension; ++a)
      {
        const double part =
          (static_cast<double>(place[a]) + 0.5) / static_cast<double>(pointsAnAxis);
        x[a] = (4.0 * (static_cast<double>(block[a]) + part) + 0.5) * step[a];
      }
      const GridSize<Dimension> cell = cellOf<Dimension>(skew(x), size);
      mean += density.Values[static_cast<std::size_t>(cellIndex<Dimension>(cell, size))] /
        static_cast<double>(inBlock.Count());
    }
    const double cells = static_cast<double>(cellCount<Dimension>(size));
    largest = std::max(largest, std::abs(mean * determinant * cells / total - 1.0));
  }
  EXPECT_NEAR(errorsOf<Dimension>(density, lattice, skew, FlowDirection::Forward).Largest, largest,
    tolerance);
}

TEST(MapBlocks, MassesInSkewBlocks)
{
  checkSkewBlocks<2>({ 23, 31 }, { 29, 18 }, 1000, 2e-4);
  checkSkewBlocks<2>({ 200, 150 }, { 9, 9 }, 2000, 2e-4);
  checkSkewBlocks<3>({ 13, 17, 11 }, { 5, 9, 5 }, 200, 5e-4);
  checkSkewBlocks<3>({ 33, 27, 38 }, { 5, 5, 5 }, 300, 5e-4);
}

// In all cells together as much as in one piece, and each part in its cell.
TEST(MapBlocks, TrianglesInCells)
{
  std::mt19937_64 engine(8);
  const GridSize<3> size{ 5, 4, 6 };
  for (int i = 0; i < 300; ++i)
  {
    SpacePolygon triangle;
    for (int k = 0; k < 3; ++k)
    {
      double x[3];
      for (int a = 0; a < 3; ++a)
      {
        x[a] = static_cast<double>(size[static_cast<std::size_t>(a)]) * uniformNumber(engine);
        x[a] = i % 3 == 0 ? std::round(x[a]) : x[a]; // on faces of cells, up to the border
      }
      triangle.Add(x);
    }
    const auto areaAlong = [](const SpacePolygon& polygon, int axis) {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      double area = 0.0;
      for (int k = 0; k < polygon.Count; ++k)
      {
        const double* a = polygon.Corners[k];
        const double* b = polygon.Corners[(k + 1) % polygon.Count];
        area += 0.5 * (a[u] * b[v] - a[v] * b[u]);
      }
      return area;
    };
    double sums[3] = { 0.0, 0.0, 0.0 };
    GridSize<3> cell{};
    visitCells<2>(triangle, size, cell, [&](const SpacePolygon& part, const GridSize<3>& at) {
      ASSERT_LE(part.Count, SpacePolygon::MostCorners);
      for (int axis = 0; axis < 3; ++axis)
      {
        sums[axis] += areaAlong(part, axis);
        const auto low = static_cast<double>(at[static_cast<std::size_t>(axis)]);
        for (int k = 0; k < part.Count; ++k)
        {
          EXPECT_GE(part.Corners[k][axis], low - 1e-12);
          EXPECT_LE(part.Corners[k][axis], low + 1.0 + 1e-12);
        }
      }
    });
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(sums[axis], areaAlong(triangle, axis), 1e-11);
    }
  }
}

void expectSame(const BlockErrors& found, const BlockErrors& expected)
{
  EXPECT_EQ(found.Quantile, expected.Quantile);
  EXPECT_EQ(found.Largest, expected.Largest);
}

// A bent map of a density, by its parts along the last axis on ranks that have no more of the
// density than they ask for.
template <int Dimension>
void checkInvariance(const GridSize<Dimension>& size, const GridSize<Dimension>& lattice)
{
  const auto density = randomDensity<Dimension>(size);
  const double total = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  const auto whole = LatticePart<Dimension>::WholeOf(lattice);
  const Points<Dimension> positions =
    mapped<Dimension>(size, lattice, [&](const Point<Dimension>& x) {
      Point<Dimension> y;
      for (int a = 0; a < Dimension; ++a)
      {
        const auto length = static_cast<double>(size[a]);
        const double other =
          x[(a + 1) % Dimension] / static_cast<double>(size[(a + 1) % Dimension]);
        y[a] = x[a] + 0.08 * length * std::sin(3.14159 * x[a] / length) * std::cos(5.0 * other);
      }
      return y;
    });
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const auto on = [&](const Context& context) {
      return errorsOf<Dimension>(
        density.Source(), total, { lattice, whole, whole, positions }, direction, context);
    };
    const SerialExecutor serial;
    const BlockErrors expected = on(Context(serial));
    EXPECT_GT(expected.Quantile, 0.01);
    for (const int threads : { 2, 3 })
    {
      const ThreadsExecutor executor(threads);
      expectSame(on(Context(executor)), expected);
    }
    for (const int count : { 2, 3 })
    {
      runOnRanks(count, [&](const Ranks& ranks) {
        LatticePart<Dimension> own = whole;
        own.Low[Dimension - 1] = whole.Cells[Dimension - 1] * ranks.Own() / count;
        own.Cells[Dimension - 1] =
          whole.Cells[Dimension - 1] * (ranks.Own() + 1) / count - own.Low[Dimension - 1];
        Context context(serial);
        context.Group = &ranks;
        const BoxesOfDensity<Dimension> boxes(density, ranks);
        expectSame(errorsOf<Dimension>(DensitySource<Dimension>(size, boxes), total,
                     { lattice, own, whole, positions }, direction, context),
          expected);
      });
    }
  }
}

TEST(MapBlocks, Invariance)
{
  checkInvariance<1>({ 500 }, { 300 });
  checkInvariance<2>({ 60, 71 }, { 60, 71 });
  checkInvariance<2>({ 60, 71 }, { 40, 12 });
  checkInvariance<3>({ 30, 22, 25 }, { 30, 22, 25 });
  // More than is taken at a time.
  checkInvariance<1>({ 5000011 }, { 2011 });
  checkInvariance<2>({ 2311, 2003 }, { 50, 61 });
  checkInvariance<3>({ 173, 181, 157 }, { 21, 18, 22 });
}

// Sums of these values pass the range of doubles, or lose all bits.
TEST(MapBlocks, ExtremeValues)
{
  const auto density = randomDensity<2>({ 20, 26 });
  const Map<2> skew = [](const Point<2>& x) {
    return Point<2>{ 0.7 * x[0], 0.2 * x[0] + x[1] / 2 };
  };
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const BlockErrors usual = errorsOf<2>(density, { 20, 26 }, skew, direction);
    for (const double factor : { 0x1p1010, 0x1p-1000 })
    {
      auto extreme = density;
      for (double& value : extreme.Values)
      {
        value *= factor;
      }
      EXPECT_NEAR(errorsOf<2>(extreme, { 20, 26 }, skew, direction).Largest, usual.Largest, 1e-12);
    }
  }
}

// What the flow leaves falls with the steps.
TYPED_TEST(MapBlocksTest, OfTheFlow)
{
  constexpr int D = TypeParam::value;
  const auto size = sizeFor<D>({ 200 }, { 60, 48 }, { 21, 25, 17 });
  const auto density = sampleDensity<D>(
    size, [](const Point<D>& p) { return 0.3 + std::exp(-8.0 * squaredDistance<D>(p, 0.45)); });
  const RectifiedFlow<D> flow(density.Source());
  const auto whole = LatticePart<D>::WholeOf(size);
  for (const FlowDirection direction : { FlowDirection::Forward, FlowDirection::Backward })
  {
    const auto after = [&](int steps) {
      FlowOptions options;
      options.NumberOfSteps = steps;
      Points<D> positions(static_cast<std::size_t>(whole.Count()));
      const auto seeds = FlowSeeds<D>::Lattice(size);
      direction == FlowDirection::Forward ? flow.Forward(seeds, positions, options)
                                          : flow.Backward(seeds, positions, options);
      return errorsOf<D>(
        density.Source(), flow.Total(), { size, whole, whole, positions }, direction);
    };
    const BlockErrors few = after(8);
    const BlockErrors many = after(256);
    EXPECT_LT(many.Quantile, 0.02);
    EXPECT_GT(few.Quantile, 2.0 * many.Quantile);
    EXPECT_GE(few.Largest, few.Quantile);
  }
}

template <int Dimension>
BlockErrors errorsBetween(const TestDensity<Dimension>& source,
  const TestDensity<Dimension>& target, const GridSize<Dimension>& lattice)
{
  const auto whole = LatticePart<Dimension>::WholeOf(lattice);
  const Points<Dimension> positions = latticePoints<Dimension>(target.Size, lattice);
  const auto sum = [](const TestDensity<Dimension>& density) {
    return std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  };
  Progress progress{ Context() };
  return measureBlocksBetween<Dimension>({ lattice, whole, whole, positions },
    { source.Source(), sum(source) }, { target.Source(), sum(target) }, progress);
}

// The identity, between densities of which one half of the box has another value.
TYPED_TEST(MapBlocksTest, BetweenDensities)
{
  constexpr int D = TypeParam::value;
  const auto size = sizeFor<D>({ 80 }, { 48, 30 }, { 24, 9, 14 });
  const auto finer = sizeFor<D>({ 160 }, { 96, 60 }, { 48, 18, 28 });
  const auto halves = [](const GridSize<D>& cells, double low, double high) {
    return sampleDensity<D>(cells, [=](const Point<D>& p) { return p[0] < 0.5 ? low : high; });
  };
  const auto same = errorsBetween<D>(halves(size, 1.0, 3.0), halves(finer, 5.0, 15.0), size);
  EXPECT_NEAR(same.Largest, 0.0, 1e-12);
  // Of the share 1/2 of a block's measure in the low half, its image has 1: 100 % more.
  const auto uniform = uniformDensity<D>(finer, 7.0);
  EXPECT_NEAR(errorsBetween<D>(halves(size, 1.0, 3.0), uniform, size).Largest, 1.0, 1e-12);
  // Where the source has less than 5 % of the mean, blocks do not count.
  EXPECT_NEAR(
    errorsBetween<D>(halves(size, 1.0, 99.0), uniform, size).Largest, 1.0 - 100.0 / 198.0, 1e-12);
  EXPECT_TRUE(std::isnan(errorsBetween<D>(uniform, uniform, evenSize<D>(4)).Largest));
}

} // namespace
} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
// Densities and seeds that break naive code: voids, huge and tiny values, degenerate grids, seeds
// on the border. No particle may end in an empty cell, outside or nowhere.
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{
namespace
{

// All integrators, both directions. Returns how many particles the default integrator had to put on
// the nearest mass.
template <int Dimension>
std::int64_t expectNoStrays(const TestDensity<Dimension>& density,
  const NotDeduced<Points<Dimension>>& seeds, const std::string& what, int stepCount = 32)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const TestDensity<Dimension> box = uniformDensity<Dimension>(density.Size);
  Points<Dimension> positions(seeds.size());
  std::int64_t movedToMass = 0;
  for (const TableLookup lookup : { TableLookup::Interpolated, TableLookup::Nearest })
  {
    for (const Integrator method : AllIntegrators)
    {
      const std::string name =
        what + ", " + nameOf(method) + (lookup == TableLookup::Nearest ? ", nearest" : "");
      FlowOptions options = steps(stepCount, method);
      options.Lookup = lookup;
      const FlowReport report = flow.Forward(seeds, positions, options);
      const Strays<Dimension> strays(positions, density);
      EXPECT_EQ(strays.Outside, 0) << name;
      if (lookup == TableLookup::Interpolated)
      {
        EXPECT_EQ(strays.InEmptyCells, 0) << name;
      }
      if (method == Integrator::Multistep && lookup == TableLookup::Interpolated)
      {
        movedToMass = report.MovedToMass;
      }
      const Points<Dimension> back = runBackward(flow, positions, options);
      EXPECT_EQ(Strays<Dimension>(back, box).Outside, 0) << name << ", backward";
      // Points of empty cells must be taken back as well.
      EXPECT_EQ(Strays<Dimension>(runBackward(flow, seeds, options), box).Outside, 0)
        << name << ", backward from anywhere";
    }
  }
  return movedToMass;
}

template <int Dimension>
std::int64_t expectNoStrays(
  const TestDensity<Dimension>& density, std::size_t count, const std::string& what)
{
  return expectNoStrays(density, randomPoints<Dimension>(density.Size, count), what);
}

TEST(Hard, DiscWithHole)
{
  EXPECT_EQ(expectNoStrays(discWithHole<1>({ 400 }), 2000, "1D"), 0);
  EXPECT_EQ(expectNoStrays(discWithHole<2>({ 256, 256 }), 8000, "2D"), 0);
  EXPECT_EQ(expectNoStrays(discWithHole<3>({ 48, 40, 44 }), 4000, "3D"), 0);
}

TEST(Hard, Checker)
{
  EXPECT_EQ(expectNoStrays(checker<1>({ 301 }, 7), 2000, "1D"), 0);
  EXPECT_LE(expectNoStrays(checker<2>({ 130, 97 }, 1), 4000, "2D, cells"), 4);
  EXPECT_EQ(expectNoStrays(checker<2>({ 256, 192 }, 16), 4000, "2D, blocks"), 0);
  EXPECT_EQ(expectNoStrays(checker<3>({ 24, 33, 20 }, 3), 2000, "3D"), 0);
}

// A few cells far apart hold everything.
TEST(Hard, ScatteredCells)
{
  TestDensity<2> density = uniformDensity<2>({ 300, 200 }, 0.0);
  for (const Point<2>& point : randomPoints<2>(density.Size, 40, 3))
  {
    density.Values[cellIndex<2>(cellOf<2>(point, density.Size), density.Size)] = 1.0;
  }
  expectNoStrays(density, 4000, "40 of 60000 cells");
}

// Four out of five cells empty, at random.
TEST(Hard, SparseNoise)
{
  TestDensity<2> density = randomCells<2>({ 160, 160 });
  TestDensity<3> volume = randomCells<3>({ 28, 28, 28 });
  for (double& value : density.Values)
  {
    value = std::max(0.0, value - 0.8);
  }
  for (double& value : volume.Values)
  {
    value = std::max(0.0, value - 0.8);
  }
  expectNoStrays(density, 4000, "2D");
  expectNoStrays(volume, 2000, "3D");
}

TEST(Hard, Dirac)
{
  for (const GridSize<2>& cell :
    { GridSize<2>{ 0, 0 }, GridSize<2>{ 199, 0 }, GridSize<2>{ 100, 149 }, GridSize<2>{ 57, 81 } })
  {
    expectNoStrays(dirac<2>({ 200, 150 }, cell), 1000, "2D");
  }
  expectNoStrays(dirac<1>({ 5000 }, { 1234 }), 1000, "1D");
  expectNoStrays(dirac<3>({ 40, 40, 40 }, { 39, 20, 0 }), 1000, "3D");
}

// Extreme units change nothing.
TEST(Hard, ExtremeValues)
{
  const TestDensity<2> density = discWithHole<2>({ 80, 60 });
  const Points<2> seeds = randomPoints<2>(density.Size, 2000);
  const Points<2> expected = runForward(makeFlow(density), seeds);
  const Points<2> expectedBack = runBackward(makeFlow(density), seeds);
  for (const double unit : { 1e-300, 1e300, 5e-324, 1e304 })
  {
    TestDensity<2> scaled = density;
    for (double& value : scaled.Values)
    {
      value *= unit;
    }
    const RectifiedFlow<2> flow = makeFlow(scaled);
    EXPECT_LT(largestDistance<2>(runForward(flow, seeds), expected), 1e-6) << unit;
    EXPECT_LT(largestDistance<2>(runBackward(flow, seeds), expectedBack), 1e-6) << unit;
    EXPECT_TRUE(std::isfinite(flow.Total())) << unit;
  }
}

// A cell so heavy that its moment passes the largest double where its mass does not.
template <int Dimension>
void expectSameFromAfar(const GridSize<Dimension>& size, const GridSize<Dimension>& cell)
{
  TestDensity<Dimension> density = dirac<Dimension>(size, cell);
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    density.Values[i] += 1e-6 * static_cast<double>(i % 13);
  }
  TestDensity<Dimension> heavy = density;
  for (double& value : heavy.Values)
  {
    value *= 0x1p1018;
  }
  const Points<Dimension> seeds = randomPoints<Dimension>(size, 500);
  EXPECT_TRUE(
    sameBits<Dimension>(runForward(makeFlow(heavy), seeds), runForward(makeFlow(density), seeds)))
    << Dimension << "D";
}

TEST(Hard, HeavyCellFarFromTheOrigin)
{
  expectSameFromAfar<1>({ 9000 }, { 8000 });
  expectSameFromAfar<2>({ 2000, 20 }, { 600, 11 });
  expectSameFromAfar<3>({ 10, 600, 10 }, { 5, 300, 5 });
}

// 16 decades between the cells: the light region gets its 1e-16 of the particles, that is none,
// and the heavy one is filled as if the light one were empty.
TEST(Hard, DynamicRange)
{
  TestDensity<2> density = discWithHole<2>({ 128, 96 });
  TestDensity<2> empty = density;
  std::mt19937_64 engine(5);
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    empty.Values[i] = density.Values[i] * 1e16;
    density.Values[i] = density.Values[i] > 0.0 ? 1e16 : uniformNumber(engine);
  }
  const Points<2> seeds = randomPoints<2>(density.Size, 4000);
  const Points<2> positions = runForward(makeFlow(density), seeds);
  EXPECT_EQ(Strays<2>(positions, density).Outside, 0);
  EXPECT_LT(comparePositions<2>(positions, runForward(makeFlow(empty), seeds)).Percentile95, 0.05);
  expectNoStrays(density, 2000, "16 decades");

  TestDensity<2> decades = randomCells<2>({ 100, 100 });
  for (double& value : decades.Values)
  {
    value = std::pow(10.0, 16.0 * value);
  }
  expectNoStrays(decades, 2000, "16 decades at random");
}

TEST(Hard, ExtremeAspect)
{
  expectNoStrays(twoGaussians<2>({ 40000, 4 }), 2000, "40000 x 4");
  expectNoStrays(discWithHole<2>({ 3, 20000 }), 2000, "3 x 20000");
  expectNoStrays(discWithHole<3>({ 2, 3000, 3 }), 1000, "2 x 3000 x 3");
  const SeparableDensity<2> separable = randomSeparable<2>({ 40000, 4 }, 0.2);
  const Points<2> seeds = randomPoints<2>({ 40000, 4 }, 2000);
  Points<2> truth = seeds;
  for (Point<2>& point : truth)
  {
    point = separable.Forward(point);
  }
  // 40000 cells on an axis: a step of 1/32 spans 1250 of them.
  const Points<2> positions = runForward(makeFlow(separable.Density()), seeds, steps(512));
  EXPECT_LT(comparePositions<2>(positions, truth).Mean, 4.0);
}

// One cell: there is nowhere else to go, and the map is the identity.
TEST(Hard, OneCell)
{
  const Points<1> seeds1 = randomPoints<1>({ 1 }, 200);
  const Points<2> seeds2 = randomPoints<2>({ 1, 1 }, 200);
  const Points<3> seeds3 = randomPoints<3>({ 1, 1, 1 }, 200);
  const auto flow1 = makeFlow(uniformDensity<1>({ 1 }, 7.0));
  const auto flow2 = makeFlow(uniformDensity<2>({ 1, 1 }, 7.0));
  const auto flow3 = makeFlow(uniformDensity<3>({ 1, 1, 1 }, 7.0));
  EXPECT_LT(largestDistance<1>(runForward(flow1, seeds1, steps(64)), seeds1), 1e-3);
  EXPECT_LT(largestDistance<2>(runForward(flow2, seeds2, steps(64)), seeds2), 1e-3);
  EXPECT_LT(largestDistance<3>(runForward(flow3, seeds3, steps(64)), seeds3), 1e-3);
  EXPECT_LT(largestDistance<2>(runBackward(flow2, seeds2, steps(64)), seeds2), 1e-2);
  EXPECT_LT(largestDistance<2>(runForward(flow2, seeds2, adaptive(1e-4)), seeds2), 1e-2);
  expectNoStrays(uniformDensity<2>({ 1, 1 }), 200, "one cell");
}

TEST(Hard, AxisOfOneCell)
{
  expectNoStrays(discWithHole<2>({ 1, 300 }), 1000, "1 x 300");
  expectNoStrays(discWithHole<2>({ 300, 1 }), 1000, "300 x 1");
  expectNoStrays(discWithHole<3>({ 90, 1, 80 }), 1000, "90 x 1 x 80");
  expectNoStrays(discWithHole<3>({ 1, 1, 200 }), 1000, "1 x 1 x 200");
  // Along the axis of one cell nothing happens.
  const Points<2> seeds = randomPoints<2>({ 300, 1 }, 500);
  const Points<2> positions = runForward(makeFlow(twoGaussians<2>({ 300, 1 })), seeds, steps(128));
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    EXPECT_NEAR(positions[i][1], seeds[i][1], 1e-3);
  }
}

TEST(Hard, TwoCells)
{
  expectNoStrays<1>({ { 2 }, { 0.0, 1.0 } }, 500, "1D");
  expectNoStrays<2>({ { 2, 2 }, { 0.0, 1.0, 1.0, 0.0 } }, 500, "2D");
  expectNoStrays<3>({ { 2, 1, 2 }, { 1.0, 0.0, 0.0, 1.0 } }, 500, "3D");
}

// All corners, middles of edges and faces, and points next to them.
template <int Dimension>
Points<Dimension> borderPoints(const GridSize<Dimension>& size)
{
  const double shares[] = { 0.0, 5e-324, 1e-16, 1e-9, 0.5, 1.0 - 1e-9, 1.0 - 1.2e-16, 1.0 };
  constexpr int Shares = 8;
  const auto choices = evenSize<Dimension>(Shares);
  Points<Dimension> points(cellCount<Dimension>(choices));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const GridSize<Dimension> choice = cellAt<Dimension>(static_cast<std::int64_t>(i), choices);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      points[i][axis] = shares[choice[axis]] * static_cast<double>(size[axis]);
    }
  }
  return points;
}

TEST(Hard, SeedsOnTheBorder)
{
  expectNoStrays(discWithHole<1>({ 100 }), borderPoints<1>({ 100 }), "1D");
  expectNoStrays(discWithHole<2>({ 100, 70 }), borderPoints<2>({ 100, 70 }), "2D");
  expectNoStrays(discWithHole<3>({ 20, 30, 25 }), borderPoints<3>({ 20, 30, 25 }), "3D");
  expectNoStrays(twoGaussians<2>({ 100, 70 }), borderPoints<2>({ 100, 70 }), "2D, smooth");
}

// On grid planes and nodes, where the boxes begin and end on cell faces.
TEST(Hard, SeedsOnNodes)
{
  const TestDensity<2> density = discWithHole<2>({ 64, 64 });
  Points<2> nodes;
  for (int y = 0; y <= 64; y += 4)
  {
    for (int x = 0; x <= 64; x += 2)
    {
      nodes.push_back({ static_cast<double>(x), static_cast<double>(y) });
    }
  }
  expectNoStrays(density, nodes, "nodes");
}

// Seeds on the border of a positive density stay on it; that is where the flow is steepest.
TEST(Hard, BorderStaysBorder)
{
  const TestDensity<2> density = twoGaussians<2>({ 100, 70 });
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> seeds = { { 0.0, 31.0 }, { 100.0, 8.0 }, { 44.0, 0.0 }, { 3.0, 70.0 },
    { 0.0, 0.0 }, { 100.0, 70.0 } };
  const Points<2> truth = Oracle<2>(density.Values, density.Size).Forward(seeds);
  EXPECT_LT(largestDistance<2>(runForward(flow, seeds, steps(64)), truth), 1.0);
  EXPECT_LT(largestDistance<2>(runForward(flow, seeds, steps(512)), truth), 0.05);
}

// Seeds outside are taken from the border.
TEST(Hard, SeedsOutside)
{
  const TestDensity<2> density = twoGaussians<2>({ 100, 70 });
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> outside = { { -3.0, 31.0 }, { 1e300, 8.0 }, { 44.0, -1e-300 }, { 1e308, -1e308 },
    { -1e308, 1e308 }, { 50.0, 70.000001 } };
  const Points<2> border = { { 0.0, 31.0 }, { 100.0, 8.0 }, { 44.0, 0.0 }, { 100.0, 0.0 },
    { 0.0, 70.0 }, { 50.0, 70.0 } };
  for (const Integrator method : AllIntegrators)
  {
    const FlowOptions options = steps(32, method);
    EXPECT_TRUE(sameBits<2>(runForward(flow, outside, options), runForward(flow, border, options)))
      << nameOf(method);
    EXPECT_TRUE(
      sameBits<2>(runBackward(flow, outside, options), runBackward(flow, border, options)))
      << nameOf(method);
  }
}

// The state that filters ask for.
TEST(Hard, HasMass)
{
  const TestDensity<2> density = checker<2>({ 4, 3 }, 1);
  const RectifiedFlow<2> flow = makeFlow(density);
  EXPECT_FALSE(flow.HasMass({ 0.5, 0.5 }));
  EXPECT_TRUE(flow.HasMass({ 1.5, 0.5 }));
  EXPECT_TRUE(flow.HasMass({ 1.0, 0.5 })) << "a face with mass on one side";
  EXPECT_TRUE(flow.HasMass({ 1.0, 1.0 })) << "a node between empty and full cells";
  EXPECT_FALSE(flow.HasMass({ 0.0, 0.0 }));
  EXPECT_TRUE(flow.HasMass({ 4.0, 0.5 })) << "the upper border";
  EXPECT_FALSE(flow.HasMass({ 4.0, 1.5 }));
  const RectifiedFlow<2> tiny = makeFlow(dirac<2>({ 5, 5 }, { 2, 2 }, 1e-300));
  EXPECT_TRUE(tiny.HasMass({ 2.5, 2.5 }));
  EXPECT_FALSE(tiny.HasMass({ 3.5, 2.5 }));
}

// With many steps the last boxes are so small that the rounding of the sums hides their mass.
TEST(Hard, BoxesBelowRoundingAreNoVoids)
{
  const TestDensity<3> density = twoGaussians<3>({ 20, 18, 16 });
  const RectifiedFlow<3> flow = makeFlow(density);
  const Points<3> seeds = randomPoints<3>(density.Size, 300);
  const Points<3> exact = runForward(flow, seeds, steps(300));
  Points<3> positions(seeds.size());
  const FlowReport report = flow.Forward(seeds, positions, steps(1000));
  EXPECT_EQ(report.Redone, 0);
  EXPECT_LE(report.Evaluations, 1000 * 300);
  EXPECT_LT(largestDistance<3>(exact, positions), 0.02);
}

} // namespace
} // namespace RectifiedTransport

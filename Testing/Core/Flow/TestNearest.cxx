// SPDX-License-Identifier: BSD-3-Clause
// The paper's ablation: boxes rounded to whole cells (Figure 4). Coarse, but never NaN.
#include "TestFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace RectifiedTransport
{
namespace
{

FlowOptions nearest(int count)
{
  FlowOptions options = steps(count);
  options.Lookup = TableLookup::Nearest;
  return options;
}

// The paper's velocity (PaperTransport.h) with both sides of the box at the nearest nodes, where
// tables need no interpolation.
template <std::size_t Dimension>
Paper::Vector<Dimension> nearestVelocity(
  const Paper::Tables<Dimension>& tables, const Paper::Vector<Dimension>& x, double t)
{
  if (t >= 1.0)
  {
    return Paper::velocity(tables, x, t, Paper::FinalVelocity::Limit);
  }
  Paper::Vector<Dimension> low;
  Paper::Vector<Dimension> high;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    const auto side = static_cast<double>(tables.Cells[axis]);
    low[axis] = std::round(std::clamp(side - (side - x[axis]) / t, 0.0, side));
    high[axis] = std::round(std::clamp(x[axis] / t, 0.0, side));
  }
  const Paper::Integrals<Dimension> box = Paper::integrate(tables, low, high);
  Paper::Vector<Dimension> v;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
  {
    v[axis] = (box.Moment[axis] / box.Mass - x[axis]) / (1.0 - t);
  }
  return v;
}

// Steps of Euler, so few that no box is narrower than a cell.
template <int Dimension>
void expectTranscription(const TestDensity<Dimension>& density, int count)
{
  FlowOptions options = nearest(count);
  options.Integrator = Integrator::Euler;
  const Paper::Tables<Dimension> tables = Paper::buildTables(density.Values, density.Size);
  Points<Dimension> points = randomPoints<Dimension>(density.Size, 1000);
  const Points<Dimension> actual = runForward(makeFlow(density), points, options);
  for (Point<Dimension>& x : points)
  {
    for (int step = 0; step < count; ++step)
    {
      const auto v = nearestVelocity(tables, x, static_cast<double>(step) / count);
      for (int axis = 0; axis < Dimension; ++axis)
      {
        x[axis] += v[axis] / count;
      }
    }
  }
  EXPECT_LT(largestDistance<Dimension>(actual, points), 1e-7);
}

TEST(Nearest, IsThePapersAlgorithmAtNodes)
{
  expectTranscription<1>(randomCells<1>({ 100 }, 0.2), 50);
  expectTranscription<2>(randomCells<2>({ 90, 70 }, 0.2), 50);
  expectTranscription<3>(randomCells<3>({ 40, 46, 38 }, 0.2), 25);
}

// On a fine grid it is half a cell off; on a coarse grid it is worse, as published.
TEST(Nearest, IsCoarseButClose)
{
  const TestDensity<2> density = twoGaussians<2>({ 160, 120 });
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 2000);
  const Points<2> interpolated = runForward(flow, seeds, steps(64));
  const PositionErrors difference =
    comparePositions<2>(runForward(flow, seeds, nearest(64)), interpolated);
  EXPECT_LT(difference.Mean, 0.75);
  EXPECT_GT(difference.Mean, 1e-3) << "the option has no effect";
}

TEST(Nearest, NeverNaNOnCoarseGrids)
{
  for (const std::int64_t side : { 1, 2, 3, 5, 8 })
  {
    const TestDensity<2> flat = randomCells<2>({ side, side });
    const TestDensity<3> solid = randomCells<3>({ side, side, side });
    const Points<2> positions2 =
      runForward(makeFlow(flat), randomPoints<2>(flat.Size, 2000), nearest(32));
    const Points<3> positions3 =
      runForward(makeFlow(solid), randomPoints<3>(solid.Size, 2000), nearest(32));
    EXPECT_EQ(Strays<2>(positions2, flat).Outside, 0) << side;
    EXPECT_EQ(Strays<3>(positions3, solid).Outside, 0) << side;
  }
}

} // namespace
} // namespace RectifiedTransport

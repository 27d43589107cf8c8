// SPDX-License-Identifier: BSD-3-Clause
// The paper's ablation: boxes rounded to whole cells (Figure 4). Coarse, but never NaN.
#include "TestFlow.h"

#include <gtest/gtest.h>

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

// On a fine grid it is a cell or two off; on a coarse grid it is worse, as published.
TEST(Nearest, IsCoarseButClose)
{
  const TestDensity<2> density = twoGaussians<2>({ 160, 120 });
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> seeds = randomPoints<2>(density.Size, 2000);
  const Points<2> interpolated = runForward(flow, seeds, steps(64));
  const PositionErrors difference =
    comparePositions<2>(runForward(flow, seeds, nearest(64)), interpolated);
  EXPECT_LT(difference.Mean, 3.0);
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

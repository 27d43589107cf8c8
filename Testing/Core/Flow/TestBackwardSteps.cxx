// SPDX-License-Identifier: BSD-3-Clause
// How the error of the way back falls with the steps: of positions, and of the areas of images of
// cells, where the density jumps.
#include "AreaErrors.h"
#include "TestFlow.h"
#include "TestTiles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace RectifiedTransport
{
namespace
{

// The mean errors of 16, 32 ... 1024 steps.
template <class Error>
void expectOrders(const Error& error, int last, double least, const char* what)
{
  const double first = error(16);
  double before = first;
  int doublings = 0;
  for (int count = 32; count <= last; count *= 2)
  {
    const double here = error(count);
    EXPECT_LT(here, 0.7 * before) << what << ", " << count << " steps";
    before = here;
    ++doublings;
  }
  EXPECT_GT(std::log2(first / before), least * doublings) << what;
}

template <int Dimension>
void expectConvergence(const TestDensity<Dimension>& density, const TileLimits& limits)
{
  const RectifiedFlow<Dimension> flow = makeFlow(density);
  const Points<Dimension> points =
    runForward(flow, randomPoints<Dimension>(density.Size, 300), steps(1024));
  const Points<Dimension> exact = runBackward(flow, points, with(FlowMaps::Off, steps(4096)));
  const TiledRun<Dimension> tiled(density, limits);
  // Tables of graded nodes and lattices of floats have errors of their own.
  const int tileSteps = Dimension == 3 ? 64 : 128;
  const auto errorOf = [&](const RectifiedFlow<Dimension>& those, FlowMaps maps) {
    return [&, maps](int count) {
      return comparePositions<Dimension>(
        runBackward(those, points, with(maps, steps(count))), exact)
        .Mean;
    };
  };
  expectOrders(errorOf(flow, FlowMaps::Off), 1024, 1.5, "no maps");
  expectOrders(errorOf(flow, FlowMaps::On), 256, 1.3, "maps");
  expectOrders(errorOf(tiled.Flow, FlowMaps::Off), tileSteps, 1.3, "tiles");
  expectOrders(errorOf(tiled.Flow, FlowMaps::On), tileSteps, 1.3, "tiles and maps");
}

TEST(BackwardSteps, Order2D)
{
  expectConvergence<2>(twoGaussians<2>({ 400, 380 }), tileLimits<2>(60000, 0, 128));
}

TEST(BackwardSteps, Order3D)
{
  expectConvergence<3>(twoGaussians<3>({ 100, 91, 93 }), tileLimits<3>(0, 400000, 48));
}

TEST(BackwardSteps, AreasAroundADenseDisc)
{
  const TestDensity<2> density = denseBall<2>(128, 100.0);
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> corners = cornerLattice<2>(density.Size);
  const auto areasOf = [&](int count) {
    return measureAreas<2>(density, runBackward(flow, corners, steps(count)));
  };
  EXPECT_LT(areasOf(32).Folded, 1000);
  const AreaErrors found = areasOf(64);
  EXPECT_LT(found.Quantile999, 0.3);
  EXPECT_LT(found.Folded, 10);
  EXPECT_EQ(areasOf(96).Folded, 0);
}

} // namespace
} // namespace RectifiedTransport

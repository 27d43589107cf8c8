// SPDX-License-Identifier: BSD-3-Clause
// How the error of the way back falls with the steps: of positions, and of the areas of images of
// cells, where the density jumps.
#include "TestFlow.h"
#include "TestTiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

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
    runForward(flow, randomPoints<Dimension>(density.Size, 500), steps(1024));
  const Points<Dimension> exact = runBackward(flow, points, with(FlowMaps::Off, steps(8192)));
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
  expectConvergence<3>(twoGaussians<3>({ 140, 121, 133 }), tileLimits<3>(0, 1000000, 64));
}

// A disc in the plane, a ball in space, whose density is `ratio` times that of the rest.
template <int Dimension>
TestDensity<Dimension> denseBall(std::int64_t side, double ratio)
{
  return sampleDensity<Dimension>(evenSize<Dimension>(side), [&](const Point<Dimension>& p) {
    return squaredDistance<Dimension>(p, 0.47) < 0.15 * 0.15 ? ratio : 1.0;
  });
}

struct Areas
{
  double Largest = 0.0; // error of a block of 4 x 4 cells, in shares of its mass
  std::int64_t Folded = 0;
};

Areas areasOf(const TestDensity<2>& density, const FlowOptions& options)
{
  const std::int64_t side = density.Size[0];
  const std::int64_t corners = side + 1;
  Points<2> lattice;
  for (std::int64_t j = 0; j < corners; ++j)
  {
    for (std::int64_t i = 0; i < corners; ++i)
    {
      lattice.push_back({ static_cast<double>(i), static_cast<double>(j) });
    }
  }
  const RectifiedFlow<2> flow = makeFlow(density);
  const Points<2> images = runBackward(flow, lattice, options);
  const double mean = flow.Total() / static_cast<double>(side * side);
  constexpr std::int64_t block = 4;
  Areas found;
  for (std::int64_t low = 0; low < side * side; low += block)
  {
    const std::int64_t x = low % side;
    const std::int64_t y = low / side * block;
    if (y >= side)
    {
      break;
    }
    double area = 0.0;
    double mass = 0.0;
    for (std::int64_t j = y; j < y + block; ++j)
    {
      for (std::int64_t i = x; i < x + block; ++i)
      {
        const auto at = [&](std::int64_t u, std::int64_t v) {
          return images[static_cast<std::size_t>((j + v) * corners + i + u)];
        };
        const Point<2> a = at(0, 0);
        const Point<2> b = at(1, 0);
        const Point<2> c = at(1, 1);
        const Point<2> d = at(0, 1);
        const double cell = 0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]));
        area += cell;
        mass += density.Values[static_cast<std::size_t>(j * side + i)] / mean;
        found.Folded += cell <= 0.0 ? 1 : 0;
      }
    }
    found.Largest = std::max(found.Largest, std::abs(area / mass - 1.0));
  }
  return found;
}

TEST(BackwardSteps, AreasAroundADenseDisc)
{
  const TestDensity<2> density = denseBall<2>(128, 100.0);
  EXPECT_LT(areasOf(density, steps(32)).Folded, 1000);
  const Areas found = areasOf(density, steps(64));
  EXPECT_LT(found.Largest, 0.3);
  EXPECT_LT(found.Folded, 10);
  EXPECT_EQ(areasOf(density, steps(96)).Folded, 0);
}

} // namespace
} // namespace RectifiedTransport

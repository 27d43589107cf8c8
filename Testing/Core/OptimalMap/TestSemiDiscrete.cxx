// SPDX-License-Identifier: BSD-3-Clause
// The optimal map between two densities against the optimal transport to points, which power cells
// of equal masses are.
//
// Let n sites have equal masses and be the centroids of cells that divide the target into equal
// masses. C is the cost of the source's power cells, the least cost from the source to the sites.
// E is the mean squared distance of the target's mass to the sites of its cells, a cost of a
// transport from the target to the sites. Then, for the bounds D and U of the two densities:
// * D <= C + E. Compose the transport from the source to the sites with the one that spreads each
//   site's mass over its cell, independently of where in the source it came from. As sites are
//   centroids, the two displacements are not correlated, and their squares add up. Its cost C + E
//   is that of a coupling of the two densities, which is not below D.
// * sqrt(C) <= sqrt(U) + sqrt(E), as the square root of the least cost is a distance.
// E falls with the area of the cells, like 1/n, so C tends to the least cost between the densities.
#include "Core/OptimalMap/OptimalMap.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/SiteCells/PowerSiteCells.h"

#include "TestDensities.h"
#include "TestGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr double massTolerance = 1e-6; // relative, of the power cells

using Sites = std::vector<Point<3>>;

// The unit square.
ImageGrid squareGrid(const GridSize<2>& size)
{
  return makeGrid<2>(
    size, { 1.0 / static_cast<double>(size[0]), 1.0 / static_cast<double>(size[1]), 1.0 });
}

struct CellFigures
{
  double Cost; // the mean squared distance of mass to its site
  Sites Centroids;
  double Spread; // the same to the centroid of its cell
};

CellFigures measureCells(const Sites& sites, const TestDensity<2>& density)
{
  const auto values = density.Source();
  const PowerSiteCells cells(sites, squareGrid(density.Size), values, 1.0);
  const std::size_t count = sites.size();
  std::vector<double> masses(count);
  std::vector<double> costs(count);
  CellFigures figures{ 0.0, Sites(count), 0.0 };
  figures.Cost = cells.Measure({ masses.data(), figures.Centroids, costs.data() });
  figures.Spread = figures.Cost;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const double way = figures.Centroids[i][axis] - sites[i][axis];
      figures.Spread -= way * way / static_cast<double>(count);
    }
  }
  return figures;
}

// Samples of a density: where the flow takes the points of a lattice.
Sites samplesOf(const TestDensity<2>& density, std::int64_t side)
{
  const auto values = density.Source();
  const auto count = static_cast<std::size_t>(side * side);
  std::vector<Point<2>> points(count);
  RectifiedFlow<2>(values).Forward(FlowSeeds<2>::Lattice(evenSize<2>(side)), points);
  Sites sites(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    sites[i] = { points[i][0] / static_cast<double>(density.Size[0]),
      points[i][1] / static_cast<double>(density.Size[1]), 0.0 };
  }
  return sites;
}

TestDensity<2> waves(const GridSize<2>& size)
{
  return sampleDensity<2>(size, [](const Point<2>& p) {
    return 0.2 + std::exp(-30.0 * squaredDistance<2>({ p[0], 2.0 * p[1] - 0.9 }, 0.5)) +
      0.3 * std::pow(std::sin(7.0 * p[0] + 4.0 * p[1]), 2.0);
  });
}

void expectPowerCellsTendToTheLeastCost(const TestDensity<2>& source, const TestDensity<2>& target)
{
  const Point<2> unit = evenPoint<2>(1.0);
  const auto from = source.Source();
  const auto to = target.Source();
  OptimalMap<2> map({ DensitySource<2>(source.Size, from), {}, unit },
    { DensitySource<2>(target.Size, to), {}, unit });
  map.Solve();
  const double lower = map.LowerBound();
  const double upper = map.UpperBound();
  ASSERT_GT(lower, 0.0);
  ASSERT_LE(lower, upper);

  CellFigures before{};
  for (const std::int64_t side : { 8, 16, 32, 64 })
  {
    SCOPED_TRACE(side * side);
    const CellFigures targets = measureCells(samplesOf(target, side), target);
    const double spread = targets.Spread;
    const double cost = measureCells(targets.Centroids, source).Cost;
    EXPECT_LE(lower, (cost + spread) * (1.0 + massTolerance));
    EXPECT_LE(std::sqrt(cost), (std::sqrt(upper) + std::sqrt(spread)) * (1.0 + massTolerance));
    if (side > 8)
    {
      EXPECT_LT(cost, before.Cost);
      EXPECT_NEAR(spread / before.Spread, 0.25, 0.05);
    }
    if (side == 64)
    {
      EXPECT_NEAR(cost, lower, 1.2 * spread + upper - lower);
      // On a line through the last two, as cells become points.
      const double part = spread / before.Spread;
      const double limit = (cost - part * before.Cost) / (1.0 - part);
      EXPECT_GT(limit, lower);
      EXPECT_LT(limit, upper);
    }
    before = { cost, {}, spread };
  }
}

TEST(SemiDiscrete, PowerCellsTendToTheLeastCostBetweenDensities)
{
  const GridSize<2> size = { 128, 128 };
  expectPowerCellsTendToTheLeastCost(twoGaussians<2>(size), waves(size));
  expectPowerCellsTendToTheLeastCost(waves(size), twoGaussians<2>(size));
  expectPowerCellsTendToTheLeastCost(uniformDensity<2>(size), waves(size));
}

} // namespace
} // namespace RectifiedTransport

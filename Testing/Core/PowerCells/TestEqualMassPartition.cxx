// SPDX-License-Identifier: BSD-3-Clause
// Partitions into cells of equal mass: the masses, known solutions, and the cost, which by duality
// no other partition can undercut.
#include "Core/PowerCells/EqualMassPartition.h"

#include "TestPowerCells.h"

#include <gtest/gtest.h>

#include <numeric>

namespace RectifiedTransport
{
namespace
{

constexpr double tolerance = EqualMassPartition::massTolerance;

double totalCost(const EqualMassPartition& partition)
{
  double cost = 0.0;
  for (std::int64_t i = 0; i < partition.Diagram().NumberOfCells(); ++i)
  {
    cost += partition.Cost(i);
  }
  return cost;
}

PolygonMoments momentsOf(const EqualMassPartition& partition, std::size_t site)
{
  const auto cell = partition.Integrals(static_cast<std::int64_t>(site));
  return PolygonMoments{ cell.Mass, {}, cell.Spread }.Translated(cell.Centroid);
}

// The masses by cutting the cells, not by the sums that the solver looks at.
void expectEqualMasses(const EqualMassPartition& partition, const TestDensity<2>& density,
  const Point<2>& scale = { 1.0, 1.0 })
{
  const std::int64_t count = partition.Diagram().NumberOfCells();
  for (std::int64_t i = 0; i < count; ++i)
  {
    const PolygonMoments cell =
      clippedMoments(density, scale, static_cast<double>(count), cornersOf(partition.Diagram()[i]));
    EXPECT_NEAR(cell.Mass, 1.0, tolerance) << i;
    expectMoments(momentsOf(partition, static_cast<std::size_t>(i)), cell, 1e-7);
  }
}

// The weights of the sites, up to a constant, by the sides of the cells alone.
std::vector<double> weightsOf(const EqualMassPartition& partition, const Points<2>& sites)
{
  std::vector<double> weights(sites.size(), 0.0);
  std::vector<bool> isKnown(sites.size(), false);
  std::vector<std::size_t> queue{ 0 };
  isKnown[0] = true;
  for (std::size_t head = 0; head < queue.size(); ++head)
  {
    const std::size_t i = queue[head];
    const PowerDiagram::Cell cell = partition.Diagram()[static_cast<std::int64_t>(i)];
    for (std::int64_t k = 0; k < cell.Count; ++k)
    {
      const std::int64_t neighbour = cell[k].Neighbour;
      if (neighbour >= 0 && !isKnown[static_cast<std::size_t>(neighbour)])
      {
        const auto j = static_cast<std::size_t>(neighbour);
        const Point<2>& x = cell[k].X;
        weights[j] = weights[i] + (x[0] - sites[j][0]) * (x[0] - sites[j][0]) +
          (x[1] - sites[j][1]) * (x[1] - sites[j][1]) -
          (x[0] - sites[i][0]) * (x[0] - sites[i][0]) - (x[1] - sites[i][1]) * (x[1] - sites[i][1]);
        isKnown[j] = true;
        queue.push_back(j);
      }
    }
  }
  EXPECT_EQ(queue.size(), sites.size());
  return weights;
}

// Kantorovich's dual function at the weights, on points in each cell of the grid: below the cost of
// every partition into equal masses, but for the error of the sum over the points.
double dualValue(const TestDensity<2>& density, const Point<2>& scale, const Points<2>& sites,
  const std::vector<double>& weights, int perAxis)
{
  const double all = std::accumulate(density.Values.begin(), density.Values.end(), 0.0);
  const double mass = static_cast<double>(sites.size()) / all / (perAxis * perAxis);
  double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    const auto cell = cellAt<2>(static_cast<std::int64_t>(i), density.Size);
    for (int k = 0; k < perAxis * perAxis; ++k)
    {
      const double x = (static_cast<double>(cell[0]) + (k % perAxis + 0.5) / perAxis) * scale[0];
      const double y = (static_cast<double>(cell[1]) + (k / perAxis + 0.5) / perAxis) * scale[1];
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < sites.size(); ++j)
      {
        const double dx = x - sites[j][0];
        const double dy = y - sites[j][1];
        least = std::min(least, dx * dx + dy * dy - weights[j]);
      }
      sum += mass * density.Values[i] * least;
    }
  }
  return sum;
}

TEST(EqualMassPartition, MassesOfAPhotograph)
{
  const TestDensity<2> density = spots({ 40, 32 });
  for (const std::size_t count : { 3u, 50u, 400u })
  {
    const Points<2> sites = randomPoints<2>(density.Size, count, 17);
    expectEqualMasses(solved(density, sites), density);
  }
}

TEST(EqualMassPartition, IsOptimal)
{
  const Point<2> scale = { 0.5, 1.5 };
  const TestDensity<2> density = spots({ 24, 20 });
  const Points<2> sites = scaled(randomPoints<2>(density.Size, 30, 4), scale);
  const EqualMassPartition partition = solved(density, sites, scale);
  expectEqualMasses(partition, density, scale);
  const double cost = totalCost(partition);
  const std::vector<double> weights = weightsOf(partition, sites);
  // The sum over points is not exact; it converges to the cost.
  const double coarse = dualValue(density, scale, sites, weights, 4) - cost;
  const double fine = dualValue(density, scale, sites, weights, 16) - cost;
  EXPECT_LT(std::abs(fine), 2e-3 * cost);
  EXPECT_LT(std::abs(fine), 0.2 * std::abs(coarse));
  // Away from these weights the dual function falls.
  std::vector<double> other = weights;
  other[3] += 1.0;
  other[20] -= 0.7;
  EXPECT_LT(dualValue(density, scale, sites, other, 16), cost - 0.1);
}

// Of other partitions into equal masses: the same cells, given to other sites, and strips.
TEST(EqualMassPartition, OtherPartitionsCostMore)
{
  const TestDensity<2> density = spots({ 30, 30 });
  const Points<2> sites = randomPoints<2>(density.Size, 25, 8);
  const EqualMassPartition partition = solved(density, sites);
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const PolygonMoments first = momentsOf(partition, i);
      const PolygonMoments second = momentsOf(partition, j);
      EXPECT_GT(costOf(first, sites[j]) + costOf(second, sites[i]),
        costOf(first, sites[i]) + costOf(second, sites[j]) - 1e-4);
    }
  }
  // Upright strips, in the order of the sites.
  const RowMoments rows = makeRows(density, { 1.0, 1.0 }, 25.0);
  Points<2> ordered = sites;
  std::sort(ordered.begin(), ordered.end());
  const auto below = [&](double x) {
    return rowMomentsOf(rows, { { 0, 0 }, { x, 0 }, { x, 30 }, { 0, 30 } });
  };
  double strips = 0.0;
  double left = 0.0;
  for (std::size_t i = 0; i < ordered.size(); ++i)
  {
    double low = left;
    double high = 30.0;
    for (int k = 0; k < 60; ++k)
    {
      const double middle = (low + high) / 2.0;
      (below(middle).Mass < static_cast<double>(i + 1) ? low : high) = middle;
    }
    const double right = i + 1 < ordered.size() ? low : 30.0;
    const PolygonMoments strip =
      rowMomentsOf(rows, { { left, 0 }, { right, 0 }, { right, 30 }, { left, 30 } });
    EXPECT_NEAR(strip.Mass, 1.0, 1e-9);
    strips += costOf(strip, ordered[i]);
    left = right;
  }
  EXPECT_GT(strips, 1.5 * totalCost(partition));
}

TEST(EqualMassPartition, OneSite)
{
  const TestDensity<2> density = uniformDensity<2>({ 6, 4 });
  const EqualMassPartition partition = solved(density, { { 1.0, 1.0 } });
  EXPECT_EQ(partition.NewtonSteps(), 0);
  EXPECT_EQ(partition.Diagram()[0].Count, 4);
  EXPECT_NEAR(partition.Centroid(0)[0], 3.0, 1e-14);
  EXPECT_NEAR(partition.Centroid(0)[1], 2.0, 1e-14);
  // 6^2/12 + 4^2/12, and from the middle to the site 2^2 + 1^2.
  EXPECT_NEAR(partition.Cost(0), 3.0 + 16.0 / 12.0 + 5.0, 1e-13);
}

// All mass is in the right half but for a part: the line between two sites on an axis is upright.
TEST(EqualMassPartition, TwoSitesOnAHalfPlane)
{
  const TestDensity<2> density =
    sampleDensity<2>({ 40, 10 }, [](const Point<2>& p) { return p[0] > 0.5 ? 1.0 : 0.25; });
  // 20 columns of 1/4 and 20 of 1 have 25; half of it is at x = 20 + 7.5.
  for (const double x : { 1.0, 10.0, 30.0 })
  {
    const EqualMassPartition partition = solved(density, { { x, 3.0 }, { x + 0.5, 3.0 } });
    const Points<2> cell = cornersOf(partition.Diagram()[0]);
    ASSERT_EQ(cell.size(), 4u);
    EXPECT_NEAR(cell[1][0], 27.5, 1e-5);
    EXPECT_NEAR(cell[2][0], 27.5, 1e-5);
    // 20 columns of 0.25, 7.5 of 1: their centroid.
    EXPECT_NEAR(partition.Centroid(0)[0], (5.0 * 10.0 + 7.5 * 23.75) / 12.5, 1e-5);
    EXPECT_NEAR(partition.Centroid(1)[0], 33.75, 1e-5);
    EXPECT_NEAR(partition.Centroid(1)[1], 5.0, 1e-5);
  }
  // Nearly at one point: what damps the linear system is lost in its rounding at first.
  for (const double apart : { 1e-3, 1e-5 })
  {
    const EqualMassPartition near =
      solved(uniformDensity<2>({ 2, 2 }), { { 0.5, 1.5 }, { 0.5, 1.5 + apart } });
    EXPECT_NEAR(near.Centroid(1)[0], 1.0, 1e-5);
    EXPECT_NEAR(near.Centroid(1)[1], 1.5, 1e-5);
  }
  // Along the diagonal of a square: a half of an even density each, a triangle with its centroid.
  const EqualMassPartition halves =
    solved(uniformDensity<2>({ 6, 6 }), { { 1.0, 5.0 }, { 1.5, 4.5 } });
  EXPECT_NEAR(halves.Centroid(0)[0], 2.0, 1e-5);
  EXPECT_NEAR(halves.Centroid(0)[1], 4.0, 1e-5);
}

// A density of columns, and sites on a row: intervals between the quantiles, in their order.
TEST(EqualMassPartition, ColumnsAreQuantiles)
{
  const std::int64_t width = 60;
  std::mt19937_64 engine(6);
  std::vector<double> columns;
  for (std::int64_t i = 0; i < width; ++i)
  {
    columns.push_back(0.05 + uniformNumber(engine));
  }
  TestDensity<2> density = uniformDensity<2>({ width, 5 });
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    density.Values[i] = columns[i % static_cast<std::size_t>(width)];
  }
  Points<2> sites;
  for (int i = 0; i < 12; ++i)
  {
    sites.push_back({ 60.0 * std::pow(uniformNumber(engine), 3), 2.0 }); // crowded on the left
  }
  const EqualMassPartition partition = solved(density, sites);
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sites[a] < sites[b]; });
  const double share = std::accumulate(columns.begin(), columns.end(), 0.0) / 12.0;
  const auto quantile = [&](std::size_t rank) {
    double rest = share * static_cast<double>(rank);
    std::size_t i = 0;
    while (i + 1 < columns.size() && rest > columns[i])
    {
      rest -= columns[i++];
    }
    return static_cast<double>(i) + rest / columns[i];
  };
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    const Points<2> cell = cornersOf(partition.Diagram()[static_cast<std::int64_t>(order[rank])]);
    const auto range = std::minmax_element(cell.begin(), cell.end());
    EXPECT_NEAR((*range.first)[0], quantile(rank), 1e-4);
    EXPECT_NEAR((*range.second)[0], quantile(rank + 1), 1e-4);
  }
}

// A density that falls apart: no weights of Voronoi cells give each site some mass.
TEST(EqualMassPartition, DiscsThatDoNotTouch)
{
  const TestDensity<2> density = sampleDensity<2>({ 48, 32 }, [](const Point<2>& p) {
    const double x = 1.5 * p[0];
    const bool isInLarge = std::hypot(x - 0.4, p[1] - 0.5) < 0.3;
    return isInLarge || std::hypot(x - 1.2, p[1] - 0.6) < 0.12 ? 1.0 : 0.0;
  });
  for (const std::uint64_t seed : { 1u, 2u })
  {
    const Points<2> sites = randomPoints<2>(density.Size, 60, seed);
    expectEqualMasses(solved(density, sites), density);
  }
  // All of them in the empty corner.
  Points<2> corner = randomPoints<2>({ 6, 6 }, 60, 3);
  expectEqualMasses(solved(density, corner), density);
}

TEST(EqualMassPartition, HolesUnderAllSites)
{
  const GridSize<2> size = { 32, 32 };
  const Points<2> sites = latticePoints<2>(size, { 8, 8 });
  TestDensity<2> density = uniformDensity<2>(size);
  for (const Point<2>& site : sites)
  {
    const auto cell = cellOf<2>({ site[0] - 0.5, site[1] - 0.5 }, size);
    for (std::int64_t k = 0; k < 4; ++k)
    {
      density.Values[cellIndex<2>({ cell[0] + k % 2, cell[1] + k / 2 }, size)] = 0.0;
    }
  }
  const EqualMassPartition partition = solved(density, sites);
  expectEqualMasses(partition, density);
  EXPECT_NEAR(partition.Centroid(20)[0], sites[20][0], 1e-6);
  // One cell of the grid has all the mass.
  const TestDensity<2> point = dirac<2>(size, { 20, 9 });
  expectEqualMasses(solved(point, sites), point);
}

// Most sites have to share one cell of the density, far from where they are: long steps would leave
// many of them without mass.
TEST(EqualMassPartition, NarrowPeaks)
{
  for (const double background : { 1e-2, 1e-6, 0.0 })
  {
    TestDensity<2> density = uniformDensity<2>({ 32, 32 }, background);
    density.Values[10 * 32 + 20] = 1.0;
    density.Values[25 * 32 + 3] = 0.4;
    const Points<2> sites = randomPoints<2>(density.Size, 80, 5);
    const EqualMassPartition partition = solved(density, sites);
    expectEqualMasses(partition, density);
    EXPECT_LT(partition.NewtonSteps(), 100) << background;
  }
}

TEST(EqualMassPartition, CollinearSitesHaveStrips)
{
  const TestDensity<2> density = spots({ 30, 30 });
  Points<2> sites;
  for (int i = 0; i < 20; ++i)
  {
    sites.push_back({ 2.0 + 1.2 * i, 5.0 + 0.6 * i });
  }
  expectEqualMasses(solved(density, sites), density);
  // Hardly apart.
  for (Point<2>& site : sites)
  {
    site = { 15.0 + 1e-4 * site[0], 15.0 + 1e-4 * site[1] };
  }
  expectEqualMasses(solved(density, sites), density);
}

// Without weights the cells of most of these sites would be empty.
TEST(EqualMassPartition, SitesOutsideOfTheDomain)
{
  const TestDensity<2> density = spots({ 30, 30 });
  const Points<2> inside = randomPoints<2>(density.Size, 40, 21);
  for (const Point<2>& by : { Point<2>{ -30.0, -30.0 }, { 200.0, 0.0 }, { 1e5, -1e5 } })
  {
    Points<2> sites = inside;
    for (Point<2>& site : sites)
    {
      site = { 3.0 * site[0] + by[0], 3.0 * site[1] + by[1] };
    }
    expectEqualMasses(solved(density, sites), density);
  }
  // Along a line beyond the border; and one alone.
  Points<2> line;
  for (int i = 0; i < 15; ++i)
  {
    line.push_back({ -7.0, 31.0 * (i * 0.618 - std::floor(i * 0.618)) });
  }
  expectEqualMasses(solved(density, line), density);
  expectEqualMasses(solved(density, { { 40.0, -3.0 } }), density);
}

// Most sites are near each other, and a domain away from the mass.
TEST(EqualMassPartition, ClustersOfSites)
{
  const TestDensity<2> density = uniformDensity<2>({ 20, 20 });
  Points<2> sites = randomPoints<2>(density.Size, 200, 23);
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    const double corner = i % 4 == 0 ? 1.0 : 16.0;
    sites[i] = { corner + 1e-3 * sites[i][0], corner + 1e-3 * sites[i][1] };
  }
  expectEqualMasses(solved(density, sites), density);
}

// A lattice of sites for an even density: their cells at once.
TEST(EqualMassPartition, Lattice)
{
  const TestDensity<2> density = uniformDensity<2>({ 4, 4 });
  const Points<2> sites = latticePoints<2>(density.Size, { 20, 10 });
  const EqualMassPartition partition = solved(density, sites);
  EXPECT_EQ(partition.NewtonSteps(), 0);
  // (0.2^2 + 0.4^2) / 12
  EXPECT_NEAR(totalCost(partition) / 200.0, 0.2 / 12.0, 1e-12);
}

// The next solution begins from the last one, and is that of a fresh partition.
TEST(EqualMassPartition, MovedSitesAreAsIfFresh)
{
  const TestDensity<2> density = spots({ 32, 32 });
  Points<2> sites = randomPoints<2>(density.Size, 150, 2);
  EqualMassPartition partition = solved(density, sites);
  const int first = partition.NewtonSteps();
  for (int round = 0; round < 3; ++round)
  {
    for (std::size_t i = 0; i < sites.size(); ++i)
    {
      sites[i] = partition.Centroid(static_cast<std::int64_t>(i));
    }
    ASSERT_TRUE(solve(partition, sites));
    EXPECT_LT(partition.NewtonSteps(), first);
    const EqualMassPartition fresh = solved(density, sites);
    EXPECT_NEAR(totalCost(partition), totalCost(fresh), 1e-5 * totalCost(fresh));
    expectEqualMasses(partition, density);
  }
  // Wholly other ones.
  sites = randomPoints<2>(density.Size, 150, 3);
  ASSERT_TRUE(solve(partition, sites));
  EXPECT_NEAR(totalCost(partition), totalCost(solved(density, sites)), 1e-5 * totalCost(partition));
}

TEST(EqualMassPartition, UnitsAndMirrors)
{
  const TestDensity<2> density = spots({ 28, 28 });
  const Points<2> sites = randomPoints<2>(density.Size, 60, 30);
  const EqualMassPartition partition = solved(density, sites);
  for (const double unit : { 1e-9, 1e-3, 1e3, 1e9 })
  {
    const Point<2> scale = { unit, unit };
    const EqualMassPartition other = solved(density, scaled(sites, scale), scale);
    EXPECT_NEAR(totalCost(other) / (unit * unit), totalCost(partition), 1e-5 * totalCost(partition))
      << unit;
    EXPECT_LT(other.NewtonSteps(), 2 * partition.NewtonSteps()) << unit;
  }
  TestDensity<2> mirrored = density;
  for (std::size_t i = 0; i < density.Values.size(); ++i)
  {
    mirrored.Values[i] = density.Values[i / 28 * 28 + 27 - i % 28];
  }
  Points<2> images = sites;
  for (Point<2>& site : images)
  {
    site[0] = 28.0 - site[0];
  }
  const EqualMassPartition mirror = solved(mirrored, images);
  for (std::int64_t i = 0; i < 60; ++i)
  {
    EXPECT_NEAR(mirror.Centroid(i)[0], 28.0 - partition.Centroid(i)[0], 1e-4);
    EXPECT_NEAR(mirror.Centroid(i)[1], partition.Centroid(i)[1], 1e-4);
  }
}

} // namespace
} // namespace RectifiedTransport

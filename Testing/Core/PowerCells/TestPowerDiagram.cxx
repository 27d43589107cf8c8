// SPDX-License-Identifier: BSD-3-Clause
// Power diagrams: against the definition at random points, and by the sum of the areas. A cell is
// cut by some of the bisectors, so it has at least the points that it should; where the areas add
// up to the rectangle's, no cell has more.
#include "Core/PowerCells/PowerDiagram.h"

#include "RecordingContext.h"
#include "TestPowerCells.h"
#include "ThreadsExecutor.h"

#include <gtest/gtest.h>

#include <numeric>

namespace RectifiedTransport
{
namespace
{

const Point<2> lengths = { 3.0, 2.0 };

void setSites(PowerDiagram& diagram, const Points<2>& sites, const Context& context = Context())
{
  Progress progress(context);
  diagram.SetSites(sites, progress);
}

void update(
  PowerDiagram& diagram, const std::vector<double>& weights, const Context& context = Context())
{
  Progress progress(context);
  diagram.Update(weights.data(), progress);
}

PowerDiagram makeDiagram(const Points<2>& sites, const std::vector<double>& weights)
{
  PowerDiagram diagram(lengths);
  setSites(diagram, sites);
  update(diagram, weights);
  return diagram;
}

Points<2> randomSites(std::size_t count, std::uint64_t seed)
{
  Points<2> sites = randomPoints<2>({ 3, 2 }, count, seed);
  return sites;
}

std::vector<double> randomWeights(std::size_t count, double largest, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  std::vector<double> weights(count);
  for (double& weight : weights)
  {
    weight = largest * uniformNumber(engine);
  }
  return weights;
}

double power(const Point<2>& x, const Point<2>& site, double weight)
{
  return (x[0] - site[0]) * (x[0] - site[0]) + (x[1] - site[1]) * (x[1] - site[1]) - weight;
}

// How far a point is outside of a convex cell; infinite for an empty one.
double distanceOutside(const PowerDiagram::Cell& cell, const Point<2>& x)
{
  double outside = cell.Count == 0 ? std::numeric_limits<double>::infinity() : 0.0;
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    const Point<2>& a = cell[k].X;
    const Point<2>& b = cell.After(k).X;
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (length > 1e-12)
    {
      outside =
        std::max(outside, ((b[1] - a[1]) * (x[0] - a[0]) - (b[0] - a[0]) * (x[1] - a[1])) / length);
    }
  }
  return outside;
}

// All that a diagram must be.
void expectDiagram(
  const PowerDiagram& diagram, const Points<2>& sites, const std::vector<double>& weights)
{
  double area = 0.0;
  std::vector<std::int64_t> visits(sites.size(), 0);
  for (std::int64_t place = 0; place < diagram.NumberOfCells(); ++place)
  {
    ++visits.at(static_cast<std::size_t>(diagram.SiteAt(place)));
  }
  EXPECT_EQ(visits, std::vector<std::int64_t>(sites.size(), 1));
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    const PowerDiagram::Cell cell = diagram[static_cast<std::int64_t>(i)];
    EXPECT_TRUE(cell.Count == 0 || cell.Count >= 3);
    const double own = fanMoments(cornersOf(cell)).Mass;
    EXPECT_GE(own, -1e-15);
    area += own;
    for (std::int64_t k = 0; k < cell.Count; ++k)
    {
      const std::int64_t j = cell[k].Neighbour;
      for (const Point<2>& x : { cell[k].X, cell.After(k).X })
      {
        if (j >= 0)
        {
          const auto other = static_cast<std::size_t>(j);
          EXPECT_NEAR(
            power(x, sites[i], weights[i]), power(x, sites[other], weights[other]), 1e-11);
        }
        else
        {
          const double border =
            std::min({ x[0], lengths[0] - x[0], x[1], lengths[1] - x[1] }, std::less<>());
          EXPECT_NEAR(border, 0.0, 1e-14);
        }
      }
    }
  }
  EXPECT_NEAR(area, lengths[0] * lengths[1], 1e-11);
  for (const Point<2>& x : randomPoints<2>({ 3, 2 }, 200, 99))
  {
    std::size_t least = 0;
    for (std::size_t i = 1; i < sites.size(); ++i)
    {
      if (power(x, sites[i], weights[i]) < power(x, sites[least], weights[least]))
      {
        least = i;
      }
    }
    EXPECT_LT(distanceOutside(diagram[static_cast<std::int64_t>(least)], x), 1e-12) << least;
  }
}

std::vector<std::int64_t> emptyCells(const PowerDiagram& diagram)
{
  std::vector<std::int64_t> empty;
  for (std::int64_t i = 0; i < diagram.NumberOfCells(); ++i)
  {
    if (diagram[i].Count == 0)
    {
      empty.push_back(i);
    }
  }
  return empty;
}

TEST(PowerDiagram, RandomSitesAndWeights)
{
  for (const std::size_t count : { 1u, 2u, 3u, 7u, 64u, 65u, 600u })
  {
    // Up to weights that hide most sites.
    for (const double spread : { 0.0, 0.3, 1.0, 20.0 })
    {
      const Points<2> sites = randomSites(count, count);
      const std::vector<double> weights =
        randomWeights(count, spread * 6.0 / static_cast<double>(count), count + 1);
      expectDiagram(makeDiagram(sites, weights), sites, weights);
    }
  }
}

TEST(PowerDiagram, EqualWeightsAreNoWeights)
{
  const Points<2> sites = randomSites(120, 5);
  const PowerDiagram voronoi = makeDiagram(sites, std::vector<double>(120, 0.0));
  const PowerDiagram raised = makeDiagram(sites, std::vector<double>(120, 1024.0));
  for (std::int64_t i = 0; i < 120; ++i)
  {
    EXPECT_EQ(cornersOf(voronoi[i]), cornersOf(raised[i]));
    EXPECT_LE(distanceOutside(voronoi[i], sites[static_cast<std::size_t>(i)]), 0.0);
  }
}

// Four cells meet at each node, and the diagonal neighbours touch there.
TEST(PowerDiagram, LatticeOfRectangles)
{
  Points<2> sites = latticePoints<2>({ 3, 2 }, { 24, 16 });
  const std::vector<double> weights(sites.size(), 0.0);
  const PowerDiagram diagram = makeDiagram(sites, weights);
  expectDiagram(diagram, sites, weights);
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    const PolygonMoments cell = fanMoments(cornersOf(diagram[static_cast<std::int64_t>(i)]));
    EXPECT_NEAR(cell.Mass, 1.0 / 64.0, 1e-15);
    EXPECT_NEAR(cell.First[0] / cell.Mass, sites[i][0], 1e-13);
  }
}

TEST(PowerDiagram, SitesOnACircleAndALine)
{
  Points<2> circle;
  Points<2> line;
  for (int i = 0; i < 40; ++i)
  {
    const double angle = 6.283185307179586 * i / 40.0;
    circle.push_back({ 1.5 + 0.7 * std::cos(angle), 1.0 + 0.7 * std::sin(angle) });
    line.push_back({ 0.05 + 0.07 * i, 0.05 + 0.04 * i });
  }
  const std::vector<double> none(40, 0.0);
  expectDiagram(makeDiagram(circle, none), circle, none);
  expectDiagram(makeDiagram(line, none), line, none);
  const std::vector<double> some = randomWeights(40, 0.005, 3);
  expectDiagram(makeDiagram(circle, some), circle, some);
  expectDiagram(makeDiagram(line, some), line, some);
}

TEST(PowerDiagram, TwoSites)
{
  // The bisector of power: x = 1 + (w0 - w1) / (2 distance) here.
  const Points<2> sites = { { 0.5, 1.0 }, { 1.5, 1.0 } };
  const PowerDiagram diagram = makeDiagram(sites, { 0.5, 0.0 });
  EXPECT_NEAR(fanMoments(cornersOf(diagram[0])).Mass, 2.0 * 1.25, 1e-14);
  EXPECT_NEAR(fanMoments(cornersOf(diagram[1])).Mass, 2.0 * 1.75, 1e-14);
  // At a weight that reaches to the border the other has nothing.
  EXPECT_EQ(makeDiagram(sites, { 4.5, 0.0 })[1].Count, 0);
  EXPECT_EQ(makeDiagram(sites, { 0.0, 4.0 })[0].Count, 0);
}

// Weights that differ much over little way make planes through them steep.
TEST(PowerDiagram, NearbySitesOfOtherWeights)
{
  for (std::uint64_t seed = 0; seed < 60; ++seed)
  {
    Points<2> sites = randomSites(160, seed);
    const Points<2> offsets = randomSites(160, seed + 100);
    std::vector<double> weights = randomWeights(160, 1.0, seed + 200);
    for (std::size_t i = 0; i < sites.size(); ++i)
    {
      const std::size_t other = i % 4 == 0 ? i : i / 3;
      sites[i] = { sites[other][0] + 1e-7 * offsets[i][0], sites[other][1] + 1e-7 * offsets[i][1] };
      weights[i] = weights[i] < 0.4 ? 0.0 : weights[i] < 0.7 ? -6.0 : -0.006;
    }
    double area = 0.0;
    const PowerDiagram diagram = makeDiagram(sites, weights);
    for (std::int64_t i = 0; i < diagram.NumberOfCells(); ++i)
    {
      area += fanMoments(cornersOf(diagram[i])).Mass;
    }
    EXPECT_NEAR(area, lengths[0] * lengths[1], 1e-7) << seed;
  }
}

TEST(PowerDiagram, SitesOutsideOfTheRectangle)
{
  Points<2> sites = randomSites(60, 8);
  for (Point<2>& site : sites)
  {
    site = { 4.0 * site[0] - 4.0, 5.0 * site[1] - 4.0 };
  }
  const std::vector<double> weights = randomWeights(60, 1.0, 4);
  expectDiagram(makeDiagram(sites, weights), sites, weights);
  for (Point<2>& site : sites)
  {
    site[0] += 50.0; // all of them
  }
  expectDiagram(makeDiagram(sites, std::vector<double>(60, 0.0)), sites, std::vector<double>(60));
}

TEST(PowerDiagram, HiddenSitesHaveNoCell)
{
  Points<2> sites = latticePoints<2>({ 3, 2 }, { 6, 4 });
  std::vector<double> weights(sites.size(), 0.0);
  weights[8] = -0.5; // 1/4 from its neighbours in squares
  const PowerDiagram diagram = makeDiagram(sites, weights);
  EXPECT_EQ(emptyCells(diagram), std::vector<std::int64_t>{ 8 });
  expectDiagram(diagram, sites, weights);
  // One that lies at another's place has the cell alone if its weight is larger.
  sites[9] = sites[10];
  weights[10] = 0.001;
  weights[8] = 0.0;
  expectDiagram(makeDiagram(sites, weights), sites, weights);
  EXPECT_EQ(emptyCells(makeDiagram(sites, weights)), std::vector<std::int64_t>{ 9 });
}

void expectEqualCells(const PowerDiagram& found, const PowerDiagram& fresh, double tolerance)
{
  for (std::int64_t i = 0; i < fresh.NumberOfCells(); ++i)
  {
    expectMoments(fanMoments(cornersOf(found[i])), fanMoments(cornersOf(fresh[i])), tolerance);
  }
}

TEST(PowerDiagram, UpdatesAreAsIfFresh)
{
  PowerDiagram diagram(lengths);
  Points<2> sites = randomSites(300, 6);
  setSites(diagram, sites);
  std::mt19937_64 engine(2);
  for (int round = 0; round < 8; ++round)
  {
    // Weights and sites change a little, then wholly; at last the sites are fewer, then more.
    const double step = round < 5 ? 1e-3 : 1.0;
    std::vector<double> weights = randomWeights(sites.size(), 0.02, 40 + round / 3);
    if (round % 2 == 1)
    {
      for (Point<2>& site : sites)
      {
        site[0] += step * (uniformNumber(engine) - 0.5);
        site[1] += step * (uniformNumber(engine) - 0.5);
      }
      setSites(diagram, sites);
    }
    if (round == 6 || round == 7)
    {
      sites = randomSites(round == 6 ? 90 : 500, 33);
      weights = randomWeights(sites.size(), 0.02, 5);
      setSites(diagram, sites);
    }
    update(diagram, weights);
    expectDiagram(diagram, sites, weights);
    expectEqualCells(diagram, makeDiagram(sites, weights), 1e-12);
  }
}

// Two of the sites know each other only, and so do the two others, once they have moved: each
// pair's cells fit together and fill the rectangle.
TEST(PowerDiagram, CellsThatCoverTheRectangleTwice)
{
  PowerDiagram diagram(lengths);
  const std::vector<double> none(4, 0.0);
  setSites(diagram, { { 0.5, 1.0 }, { 1.0, 1.0 }, { 1.5, 1.0 }, { 2.0, 1.0 } });
  update(diagram, none);
  const Points<2> sites = { { 2.5, 1.0 }, { 0.5, 1.0 }, { 2.6, 1.0 }, { 0.6, 1.0 } };
  setSites(diagram, sites);
  update(diagram, none);
  expectDiagram(diagram, sites, none);
  EXPECT_NEAR(fanMoments(cornersOf(diagram[0])).Mass, 2.0 * (2.55 - 1.55), 1e-12);
}

TEST(PowerDiagram, HiddenSitesReturn)
{
  PowerDiagram diagram(lengths);
  const Points<2> sites = randomSites(200, 16);
  setSites(diagram, sites);
  std::vector<double> weights(sites.size(), 0.0);
  for (const std::size_t every : { 3u, 2u, 1000u, 1u, 3u })
  {
    for (std::size_t i = 0; i < sites.size(); ++i)
    {
      weights[i] = i % every == 1 ? -1.0 : 0.0;
    }
    update(diagram, weights);
    expectDiagram(diagram, sites, weights);
    expectEqualCells(diagram, makeDiagram(sites, weights), 1e-12);
  }
}

TEST(PowerDiagram, OneCellWithAnotherWeight)
{
  const Points<2> sites = randomSites(40, 8);
  std::vector<double> weights = randomWeights(40, 0.1, 9);
  const PowerDiagram diagram = makeDiagram(sites, weights);
  std::vector<PowerDiagram::Corner> corners;
  for (const std::size_t site : { 0u, 17u, 39u })
  {
    for (const double change : { -10.0, -0.03, 0.0, 0.2, 5.0 })
    {
      std::vector<double> changed = weights;
      changed[site] += change;
      const PowerDiagram expected = makeDiagram(sites, changed);
      const auto id = static_cast<std::int64_t>(site);
      diagram.CutCell(id, changed[site], corners);
      const PowerDiagram::Cell found = { corners.data(),
        static_cast<std::int64_t>(corners.size()) };
      EXPECT_EQ(found.Count == 0, change == -10.0);
      expectMoments(fanMoments(cornersOf(found)), fanMoments(cornersOf(expected[id])), 1e-12);
    }
  }
}

TEST(PowerDiagram, ThreadsDoNotMatter)
{
  const Points<2> sites = randomSites(1000, 12);
  const std::vector<double> weights = randomWeights(1000, 0.005, 13);
  const auto corners = [&](const Executor& threads) {
    PowerDiagram diagram(lengths);
    setSites(diagram, sites, threads);
    std::vector<Points<2>> all;
    for (const double factor : { 0.0, 1.0 })
    {
      std::vector<double> scaled = weights;
      for (double& weight : scaled)
      {
        weight *= factor;
      }
      update(diagram, scaled, threads);
      for (std::int64_t i = 0; i < 1000; ++i)
      {
        all.push_back(cornersOf(diagram[i]));
      }
    }
    return all;
  };
  const std::vector<Points<2>> serial = corners(SerialExecutor());
  for (const int threads : { 1, 2, 3 })
  {
    EXPECT_EQ(corners(ThreadsExecutor(threads)), serial) << threads;
  }
}

TEST(PowerDiagram, IsCancelled)
{
  PowerDiagram diagram(lengths);
  const SerialExecutor threads;
  RecordingContext recording(threads);
  recording.MaximumQueries = 0;
  const Points<2> sites = randomSites(70000, 12);
  setSites(diagram, randomSites(4000, 1));
  EXPECT_THROW(update(diagram, std::vector<double>(4000), recording.Context()), Cancelled);
  EXPECT_THROW(setSites(diagram, sites, recording.Context()), Cancelled);
}

// Whatever an update had done until it ended; before and after it there are whole ones.
TEST(PowerDiagram, IsUsedAgainAfterItWasCancelled)
{
  constexpr std::size_t count = 1500;
  PowerDiagram diagram(lengths);
  const SerialExecutor threads;
  int cancelled = 0;
  for (int queries = 0; queries < 16; ++queries)
  {
    const auto seed = static_cast<std::uint64_t>(queries);
    const Points<2> sites = randomSites(count, seed);
    std::vector<double> weights = randomWeights(count, 0.001, seed);
    setSites(diagram, sites);
    RecordingContext recording(threads);
    recording.MaximumQueries = queries;
    try
    {
      update(diagram, weights, recording.Context());
    }
    catch (const Cancelled&)
    {
      ++cancelled;
    }
    weights = randomWeights(count, 0.001, seed + 50);
    update(diagram, weights);
    expectEqualCells(diagram, makeDiagram(sites, weights), 1e-12);
  }
  EXPECT_GT(cancelled, 5);
}

// The hidden cells fit each other; doubt begins at one end and would go on from cell to cell.
TEST(PowerDiagram, HalfOfALineIsHidden)
{
  constexpr std::size_t count = 4000;
  PowerDiagram diagram(lengths);
  Points<2> sites(count);
  std::vector<double> weights(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    sites[i] = { 3.0 * (static_cast<double>(i) + 0.5) / count, 1.0 };
  }
  setSites(diagram, sites);
  update(diagram, weights);
  std::fill(weights.begin() + count / 2, weights.end(), -30.0);
  const SerialExecutor threads;
  RecordingContext recording(threads);
  update(diagram, weights, recording.Context());
  EXPECT_EQ(emptyCells(diagram).size(), count / 2);
  expectEqualCells(diagram, makeDiagram(sites, weights), 1e-12);
  EXPECT_LT(recording.Queries, 1000);
}

// The weights of a million sites take longer than a stop may.
TEST(PowerDiagram, WeightsAreCancelled)
{
  const SerialExecutor threads;
  const Points<2> sites = randomSites(70000, 12);
  SiteTree tree;
  Progress building(threads);
  tree.Build(sites, building);
  const std::vector<double> weights(sites.size(), 0.0);
  RecordingContext whole(threads);
  Progress progress(whole.Context());
  tree.SetWeights(weights.data(), progress);
  EXPECT_GT(whole.Queries, 5);
  for (int most = 0; most < 5; ++most)
  {
    RecordingContext stopped(threads);
    stopped.MaximumQueries = most;
    Progress cancelled(stopped.Context());
    EXPECT_THROW(tree.SetWeights(weights.data(), cancelled), Cancelled);
    EXPECT_EQ(stopped.Queries, most + 1);
  }
}

} // namespace
} // namespace RectifiedTransport

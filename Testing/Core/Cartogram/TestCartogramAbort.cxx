// SPDX-License-Identifier: BSD-3-Clause
// How often the parts of a cartogram look whether they are to end, counted in work instead of
// seconds: a poll stands for 2^16 edges, cells or shares, a slice or a region at most.
#include "Core/Cartogram/RegionRaster.h"
#include "Core/Cartogram/RegionValues.h"
#include "MapSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>

namespace RectifiedTransport
{
namespace
{

constexpr std::int64_t unitsOfPoll = std::int64_t{ 1 } << 16;

// Counts polls, and cancels from one of them on.
struct Polls
{
  explicit Polls(std::int64_t last)
    : Last(last)
  {
    this->Work.IsCancelled = [this]() { return this->Count++ >= this->Last; };
    this->Work.Report = [this](double progress) { this->Reports.push_back(progress); };
  }

  std::int64_t Last;
  std::int64_t Count = 0;
  std::vector<double> Reports;
  Context Work;
};

constexpr std::int64_t never = std::int64_t{ 1 } << 60;

// Runs without an abort. Returns the polls.
std::int64_t pollsOf(const std::function<void(const Context&)>& run)
{
  Polls polls(never);
  run(polls.Work);
  EXPECT_TRUE(std::is_sorted(polls.Reports.begin(), polls.Reports.end()));
  return polls.Count;
}

// Wherever it is cancelled it ends at once, but for loops that poll `loops` times as they end.
void expectToEnd(const std::function<void(const Context&)>& run, std::int64_t loops = 0)
{
  // Slices grow with the speed, so that runs in memory that is there have fewer polls.
  std::int64_t all = pollsOf(run);
  for (int warm = 0; warm < 2; ++warm)
  {
    all = std::min(all, pollsOf(run));
  }
  for (const std::int64_t last : { std::int64_t{ 0 }, all / 3, all / 2, all - 1 })
  {
    Polls polls(last);
    EXPECT_THROW(run(polls.Work), Cancelled) << last << " of " << all;
    EXPECT_LE(polls.Count, last + 2 + loops);
  }
}

Ring circle(double x, double y, double radius, int count)
{
  Ring ring;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 6.283185307179586 * i / count;
    ring.push_back({ x + radius * std::cos(angle), y + radius * std::sin(angle) });
  }
  return ring;
}

// side^2 lakes of a land, in its index space of 100 x 100.
RegionMap lakes(int side, int around)
{
  RegionMap map;
  addRing(map, 0, circle(50.0, 50.0, 49.0, around));
  for (int i = 0; i < side * side; ++i)
  {
    const double space = 60.0 / side;
    addRing(map, 0,
      circle(20.0 + space * (i % side + 0.5), 20.0 + space * (i / side + 0.5), 0.3 * space, 8));
  }
  return map;
}

TEST(CartogramAbort, HolesTakeAsMuchWorkAsEdges)
{
  RegionMap map = lakes(60, 300000);
  const std::int64_t polls = pollsOf([&](const Context& context) { map.FindHoles(context); });
  // 3600 lakes times 300,000 edges would be 16,000.
  EXPECT_GE(polls, map.Edges() / unitsOfPoll);
  EXPECT_LE(polls, 20 * map.Edges() / unitsOfPoll);
  EXPECT_FALSE(map.IsHole(0));
  for (std::int64_t ring = 1; ring < map.Rings(); ++ring)
  {
    EXPECT_TRUE(map.IsHole(ring)) << ring;
  }
  constexpr std::int64_t mergesOfSweep = 3; // of 300,000 heights, sorted 65,536 at once
  expectToEnd([&](const Context& context) { map.FindHoles(context); }, mergesOfSweep);
}

TEST(CartogramAbort, Divides)
{
  RegionMap map = lakes(10, 400000);
  map.FindHoles();
  const auto longest = [](const Point<2>& place) { return 1e-4 + (place[0] > 60.0 ? 1.0 : 0.0); };
  expectToEnd([&](const Context& context) {
    RegionMap copy = map;
    copy.Divide(longest, context);
  });
  EXPECT_GE(pollsOf([&](const Context& context) { map.Divide(longest, context); }), 6);
}

TEST(CartogramAbort, RastersAndTheirValues)
{
  constexpr std::int64_t side = 1500;
  RegionMap map = lakes(10, 200000);
  for (std::int32_t region = 1; region < 20; ++region)
  {
    addRing(map, region, circle(5.0 * region, 1.0, 0.5, 10));
  }
  for (Point<2>& place : map.Points())
  {
    place = { 15.0 * place[0], 15.0 * place[1] };
  }
  map.FindHoles();
  expectToEnd([&](const Context& context) { RegionRaster(map, 20, side, context); });
  const RegionRaster raster(map, 20, side);
  std::vector<double> cells;
  const std::vector<double> values(20, 1.0);
  expectToEnd([&](const Context& context) { raster.Fill(values, 1.0, cells, context); });
  const std::vector<double> areas = map.Areas(20);
  expectToEnd([&](const Context& context) {
    findRegionValues(raster, { areas, areas, 1.0, 1e-4, 1.0 }, context);
  });
}

// The whole run: progress rises, and stands still for no more than a part of the processors' time.
TEST(CartogramAbort, WholeRuns)
{
  const std::vector<double> masses{ 1.0, 5.0, 2.0, 0.1, 3.0, 1.0, 1.0, 9.0, 0.5 };
  CartogramOptions options;
  options.Resolution = 256;
  const auto run = [&](const Context& context) {
    RegionMap map = squares(3);
    const CartogramBox box = boxAround(map, options);
    for (Point<2>& place : map.Points())
    {
      place = box.ToIndex(place);
    }
    OverlayPoints overlays(5000, { 100.0, 120.0 });
    CartogramStart start;
    runCartogram(map, masses, box, options, overlays, start, context);
  };
  Polls polls(never);
  std::vector<double> atPolls;
  std::vector<std::clock_t> times;
  polls.Work.IsCancelled = [&]() {
    times.push_back(std::clock());
    atPolls.push_back(polls.Reports.empty() ? 0.0 : polls.Reports.back());
    return false;
  };
  run(polls.Work);
  EXPECT_TRUE(std::is_sorted(polls.Reports.begin(), polls.Reports.end()));
  EXPECT_LT(polls.Reports.back(), 1.0 + 1e-12);
  std::clock_t longest = 0;
  for (std::size_t i = 0, first = 0; i < atPolls.size(); ++i)
  {
    first = atPolls[i] > atPolls[first] ? i : first;
    longest = std::max(longest, times[i] - times[first]);
  }
  EXPECT_LE(4 * longest, times.back() - times.front());
  // Threads that come late poll less often: another run may have a few polls less.
  const auto all = static_cast<std::int64_t>(atPolls.size());
  for (std::int64_t last = 0; last < all - all / 10; last += std::max<std::int64_t>(1, all / 40))
  {
    Polls some(last);
    EXPECT_THROW(run(some.Work), Cancelled) << last << " of " << all;
    EXPECT_LE(some.Count, last + all / 20); // a slice's ranges
  }
}

} // namespace
} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
// Regions with long outlines on a grid: points of the outline x cells along an axis.
#include "BenchmarkInputs.h"

#include "Core/Overlap/RegionCoverage.h"
#include "Core/Overlap/RegionOutlines.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace RectifiedTransport
{
namespace
{

using Ring = std::vector<Point<2>>;

// In the unit square: points at random angles and distances, in the order of the angles.
Ring spikyRing(std::int64_t points)
{
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> angles(static_cast<std::size_t>(points));
  std::generate(
    angles.begin(), angles.end(), [&]() { return 2.0 * std::acos(-1.0) * unit(engine); });
  std::sort(angles.begin(), angles.end());
  Ring ring;
  for (const double angle : angles)
  {
    const double radius = (1.0 + 0.3 * unit(engine)) / 2.6;
    ring.push_back({ 0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle) });
  }
  return ring;
}

// A square whose sides are divided at their middles, moved at random, again and again.
Ring coastRing(std::int64_t points)
{
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> unit(-0.15, 0.15);
  Ring ring{ { 0.2, 0.2 }, { 0.8, 0.2 }, { 0.8, 0.8 }, { 0.2, 0.8 } };
  while (static_cast<std::int64_t>(ring.size()) < points)
  {
    Ring finer;
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      const Point<2>& a = ring[i];
      const Point<2>& b = ring[(i + 1) % ring.size()];
      const double off = unit(engine);
      finer.push_back(a);
      finer.push_back(
        { 0.5 * (a[0] + b[0]) - off * (b[1] - a[1]), 0.5 * (a[1] + b[1]) + off * (b[0] - a[0]) });
    }
    ring = finer;
  }
  return ring;
}

void fillRegion(benchmark::State& state, const Ring& ring)
{
  const std::int64_t cells = state.range(1);
  std::vector<double> sums(static_cast<std::size_t>(cells * cells), 0.0);
  const GridSlab<2> slab{ { cells, cells }, 0, cells, sums.data() };
  for (auto _ : state)
  {
    Rings rings;
    for (const Point<2>& x : ring)
    {
      rings.Add({ x[0] * static_cast<double>(cells), x[1] * static_cast<double>(cells) });
    }
    rings.EndRing();
    Progress progress{ Context() };
    RegionCoverage coverage(slab);
    for (const OutlineEdge& edge : regionOutlines(rings, { 1.0 }, progress))
    {
      coverage.Add(edge.From, edge.To);
    }
    coverage.Finish(1.0);
    benchmark::DoNotOptimize(sums.data());
  }
  state.counters["points"] = static_cast<double>(ring.size());
}

void spikyRegion(benchmark::State& state)
{
  fillRegion(state, spikyRing(state.range(0)));
}

void coastRegion(benchmark::State& state)
{
  fillRegion(state, coastRing(state.range(0)));
}

void outlines(benchmark::internal::Benchmark* of)
{
  for (const std::int64_t points : { 5000, 20000, 80000 })
  {
    for (const std::int64_t cells : { 256, 1024 })
    {
      of->Args({ points, cells });
    }
  }
  of->ArgNames({ "points", "cells" })->Unit(benchmark::kMillisecond);
}

BENCHMARK(spikyRegion)->Apply(outlines);
BENCHMARK(coastRegion)->Apply(outlines);

} // namespace
} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
// The relaxation of blue noise on the photograph: what an iteration costs over numbers of points,
// from the flow's particles and from random points (paper, Section 5.1, Figure 10).
#include "PhotographInput.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Relaxation/BlueNoiseRelaxation.h"

#include <map>
#include <memory>
#include <utility>

namespace RectifiedTransport
{
namespace
{

const RectifiedFlow<2>& flow()
{
  static const RectifiedFlow<2> made(Photograph::Instance().Density.Source());
  return made;
}

const Particles<2>& startOf(std::int64_t count, bool random)
{
  static std::map<std::pair<std::int64_t, bool>, Particles<2>> starts;
  Particles<2>& points = starts[{ count, random }];
  if (points.empty())
  {
    points.resize(static_cast<std::size_t>(count));
    generateSeeds<2>(
      random ? SeedPattern::Random : SeedPattern::BlueNoise, { 1.0, 1.0 }, 1, points);
    for (Point<2>& point : points)
    {
      point = { PhotographSide * point[0], PhotographSide * point[1] };
    }
    if (!random)
    {
      flow().Forward(points, points);
    }
  }
  return points;
}

template <bool ByTransport, bool Random>
void relaxation(benchmark::State& state)
{
  const Particles<2>& start = startOf(state.range(0), Random);
  const auto density = Photograph::Instance().Density.Source();
  RelaxationOptions options;
  options.MaximumIterations = static_cast<int>(state.range(1));
  Particles<2> points;
  RelaxationReport report;
  for (auto _ : state)
  {
    points = start;
    report = ByTransport
      ? relaxByTransport(density, { 1.0, 1.0 }, points, options, SerialExecutor())
      : relaxByRepulsion<2>(density, flow(), { 1.0, 1.0 }, points, options, SerialExecutor());
  }
  state.counters["energy"] = report.Energy.back();
  state.counters["energy_before"] = report.Energy.front();
  state.counters["iterations"] = static_cast<double>(report.Energy.size()) - 1.0;
}

// Pairs of numbers of points and of iterations.
void sizes(benchmark::internal::Benchmark* b)
{
  b->Unit(benchmark::kMillisecond);
  for (const std::int64_t points : { 2048, 8192, 32768 })
  {
    b->Args({ points, 0 })->Args({ points, 10 });
  }
  b->Args({ 8192, 50 });
}

BENCHMARK(relaxation<true, false>)->Name("Relaxation/transport/flow")->Apply(sizes);
BENCHMARK(relaxation<true, true>)->Name("Relaxation/transport/random")->Apply(sizes);
BENCHMARK(relaxation<false, false>)->Name("Relaxation/repulsion/flow")->Apply(sizes);
BENCHMARK(relaxation<false, true>)->Name("Relaxation/repulsion/random")->Apply(sizes);

} // namespace
} // namespace RectifiedTransport

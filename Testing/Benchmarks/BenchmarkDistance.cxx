// SPDX-License-Identifier: BSD-3-Clause
// The distances of Transport Distance on one thread: a map of Linearized, the comparison of two
// maps, and the bracket of a pair of Certified and its lower bound alone, with how far they are
// from the bound of many iterations ("low", "high", "over": parts of the squared distance).
#include "BenchmarkInputs.h"
#include "OptimalPairs.h"

#include "Core/Distance/CertifiedDistance.h"
#include "Core/Distance/ReferenceImages.h"
#include "Core/OptimalMap/OptimalMap.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <int D>
struct DistancePair
{
  DistancePair(const std::string& name, std::int64_t side)
  {
    const OptimalPair<D> pair = optimalPair<D>(name, side);
    this->From = pair.Source();
    this->To = pair.Target();
  }

  // The lower bound of many iterations.
  double Best() const { return this->Lower({}); }

  double Lower(OptimalMapOptions options, int iterations = 20) const
  {
    options.LeastIterations = options.MostIterations = iterations;
    const auto source = this->From.Source();
    const auto target = this->To.Source();
    OptimalMap<D> map({ DensitySource<D>(this->From.Size, source), {}, this->Unit },
      { DensitySource<D>(this->To.Size, target), {}, this->Unit }, options);
    map.Solve();
    return map.LowerBound();
  }

  TestDensity<D> From;
  TestDensity<D> To;
  Point<D> Unit = evenPoint<D>(1.0);
};

template <int D>
void mapDistance(benchmark::State& state, const std::string& name)
{
  const DistancePair<D> pair(name, state.range(0));
  const OpenMPThreads threads(1);
  ReferenceImages images;
  for (auto _ : state)
  {
    images = mapReference<D>(pair.From.Source(), pair.Unit);
  }
  const double square =
    meanSquaredDistance<D>(images, mapReference<D>(pair.To.Source(), pair.Unit));
  state.counters["over"] = square / pair.Best() - 1.0;
}

template <int D>
void compareMaps(benchmark::State& state, const std::string& name)
{
  const DistancePair<D> pair(name, state.range(0));
  const OpenMPThreads threads(1);
  const ReferenceImages a = mapReference<D>(pair.From.Source(), pair.Unit);
  const ReferenceImages b = mapReference<D>(pair.To.Source(), pair.Unit);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(meanSquaredDistance<D>(a, b));
  }
}

template <int D>
void bracketPair(benchmark::State& state, const std::string& name)
{
  const DistancePair<D> pair(name, state.range(0));
  const OpenMPThreads threads(1);
  SquaredBracket bracket;
  for (auto _ : state)
  {
    bracket = bracketDistance<D>(pair.From.Source(), pair.To.Source(), pair.Unit);
  }
  const double best = pair.Best();
  state.counters["low"] = 1.0 - bracket.Lower / best;
  state.counters["high"] = bracket.Upper / best - 1.0;
}

template <int D>
void boundPair(benchmark::State& state, const std::string& name)
{
  const DistancePair<D> pair(name, state.range(0));
  const OpenMPThreads threads(1);
  OptimalMapOptions options;
  options.ForBounds = true;
  double bound = 0.0;
  for (auto _ : state)
  {
    bound = pair.Lower(options, 1);
  }
  state.counters["low"] = 1.0 - bound / pair.Best();
}

template <int D>
void addDistances(const std::string& name, const std::vector<std::int64_t>& sides)
{
  const std::string start = "Distance" + std::to_string(D) + "D/";
  for (const std::int64_t side : sides)
  {
    const auto add = [=](const char* what, void (*run)(benchmark::State&, const std::string&)) {
      benchmark::RegisterBenchmark(
        (start + what + "/" + name).c_str(), [=](benchmark::State& state) { run(state, name); })
        ->Args({ side })
        ->Unit(benchmark::kMillisecond);
    };
    add("map", mapDistance<D>);
    add("compare", compareMaps<D>);
    add("bracket", bracketPair<D>);
    add("lower_bound", boundPair<D>);
  }
}

const bool areRegistered = []() {
  addDistances<2>("blobs", { 64, 128, 256 });
  addDistances<2>("star_ring", { 64, 128, 256 });
  addDistances<3>("blobs", { 64 });
  addDistances<3>("animal_ring", { 64 });
  return true;
}();

} // namespace
} // namespace RectifiedTransport

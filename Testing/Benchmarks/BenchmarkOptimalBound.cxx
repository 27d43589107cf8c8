// SPDX-License-Identifier: BSD-3-Clause
// The certified lower bound of the least cost: its time, and how far it is below the bound of many
// iterations.
#include "BenchmarkInputs.h"
#include "OptimalPairs.h"
#include "PhotographInput.h"

#include "Core/OptimalMap/OptimalMap.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

TestDensity<2> photographOf(std::int64_t side)
{
  const std::vector<double>& pixels = Photograph::Instance().Density.Values;
  TestDensity<2> density = uniformDensity<2>({ side, side }, 0.0);
  const std::int64_t factor = PhotographSide / side;
  for (std::int64_t y = 0; y < PhotographSide; ++y)
  {
    for (std::int64_t x = 0; x < PhotographSide; ++x)
    {
      density.Values[static_cast<std::size_t>(y / factor * side + x / factor)] +=
        pixels[static_cast<std::size_t>(y * PhotographSide + x)];
    }
  }
  return density;
}

template <int D>
OptimalPair<D> pairNamed(const std::string& name, const std::vector<OptimalPair<D>>& pairs)
{
  return *std::find_if(
    pairs.begin(), pairs.end(), [&](const OptimalPair<D>& pair) { return pair.Name == name; });
}

template <int D>
OptimalPair<D> pairOf(const std::string& name, std::int64_t side)
{
  if constexpr (D == 2)
  {
    if (name == "uniform_photograph")
    {
      return { name,
        [=]() {
          return uniformDensity<2>({ side, side });
        },
        [=]() { return photographOf(side); } };
    }
    return pairNamed<2>(name, optimalPairs2D(side));
  }
  else
  {
    return pairNamed<3>(name, optimalPairs3D(side));
  }
}

template <int D>
double boundOf(const TestDensity<D>& from, const TestDensity<D>& to, int iterations)
{
  OptimalMapOptions options;
  options.LeastIterations = iterations;
  options.MostIterations = iterations;
  const auto source = from.Source();
  const auto target = to.Source();
  const Point<D> unit = evenPoint<D>(1.0);
  OptimalMap<D> map({ DensitySource<D>(from.Size, source), {}, unit },
    { DensitySource<D>(to.Size, target), {}, unit }, options);
  map.Solve();
  return map.LowerBound();
}

template <int D>
void solveBound(benchmark::State& state, const std::string& name)
{
  const OptimalPair<D> pair = pairOf<D>(name, state.range(0));
  const TestDensity<D> from = pair.Source();
  const TestDensity<D> to = pair.Target();
  const OpenMPThreads threads(static_cast<int>(state.range(2)));
  double bound = 0.0;
  for (auto _ : state)
  {
    bound = boundOf<D>(from, to, static_cast<int>(state.range(1)));
  }
  state.counters["bound"] = bound;
}

template <int D>
void addBounds(const std::string& name, const std::vector<std::int64_t>& sides)
{
  constexpr int many = 20;
  for (const std::int64_t side : sides)
  {
    for (const int iterations : { 0, 1, 5, many })
    {
      for (const int threads : { 1, 2 })
      {
        if (iterations < many || threads == 2)
        {
          benchmark::RegisterBenchmark(("OptimalBound" + std::to_string(D) + "D/" + name).c_str(),
            [=](benchmark::State& state) { solveBound<D>(state, name); })
            ->Args({ side, iterations, threads })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
        }
      }
    }
  }
}

const bool areRegistered = []() {
  addBounds<2>("uniform_photograph", { 64, 256, 1024 });
  addBounds<2>("star_ring", { 256, 1024 });
  addBounds<3>("blobs", { 64, 128 });
  addBounds<3>("animal_ring", { 64, 128 });
  return true;
}();

} // namespace
} // namespace RectifiedTransport

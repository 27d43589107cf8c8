// SPDX-License-Identifier: BSD-3-Clause
// Flows with tiles: one sample a cell against whole tables, and grids for which these are too
// large. On two threads; memory beyond the density, in single precision, and the positions.
#include "BenchmarkInputs.h"
#include "PeakMemory.h"

#include <cmath>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// As texturedGaussians: a product of lines, and noise.
std::vector<float> largeDensity(std::int64_t side)
{
  const auto lines = [side](double centre, double width) {
    std::vector<double> line;
    for (std::int64_t i = 0; i < side; ++i)
    {
      const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(side) - centre;
      line.push_back(std::exp(-width * x * x));
    }
    return line;
  };
  const std::vector<double> first = lines(0.3, 20.0);
  const std::vector<double> second = lines(0.72, 60.0);
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(side * side * side));
  std::mt19937_64 engine(1);
  for (std::int64_t k = 0; k < side; ++k)
  {
    for (std::int64_t j = 0; j < side; ++j)
    {
      const auto y = static_cast<std::size_t>(j);
      const auto z = static_cast<std::size_t>(k);
      for (std::size_t x = 0; x < first.size(); ++x)
      {
        const double value =
          0.05 + first[x] * first[y] * first[z] + 0.6 * second[x] * second[y] * second[z];
        values.push_back(static_cast<float>(value * (0.7 + 0.6 * uniformNumber(engine))));
      }
    }
  }
  return values;
}

// Of `particles` random seeds, or of 0 the centres of all cells.
void run(benchmark::State& state, FlowTables tables, FlowDirection direction, int steps,
  std::int64_t particles)
{
  const std::int64_t side = state.range(0);
  const GridSize<3> size = evenSize<3>(side);
  const std::vector<float> values = largeDensity(side);
  const DensityArray<3, float> density(values.data(), size);
  const bool isLattice = particles == 0;
  const bool isForward = direction == FlowDirection::Forward;
  FlowOptions options;
  options.NumberOfSteps = steps;
  std::vector<Point<3>> positions(
    static_cast<std::size_t>(isLattice ? side * side * side : particles));
  std::mt19937_64 engine(7);
  for (Point<3>& point : positions)
  {
    for (double& coordinate : point)
    {
      coordinate = isLattice ? 0.0 : uniformNumber(engine) * static_cast<double>(side);
    }
  }
  const OpenMPThreads threads(2);
  for (auto _ : state)
  {
    resetPeakMemory();
    const double before = peakMemory();
    const RectifiedFlow<3> flow(density, tables);
    isLattice&& isForward ? flow.Forward(FlowSeeds<3>::Lattice(size), positions, options)
      : isLattice         ? flow.Backward(FlowSeeds<3>::Lattice(size), positions, options)
      : isForward         ? flow.Forward(positions, positions, options)
                          : flow.Backward(positions, positions, options);
    state.counters["peak_bytes"] = peakMemory() - before;
  }
  state.counters["foretold_bytes"] = tables == FlowTables::Tiled
    ? RectifiedFlow<3>::TiledMemoryFor(
        size, options, direction, static_cast<double>(positions.size()), isLattice)
    : RectifiedFlow<3>::MemoryFor(size);
}

void once(benchmark::internal::Benchmark* b)
{
  b->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);
}

BENCHMARK_CAPTURE(run, whole, FlowTables::Whole, FlowDirection::Forward, 32, 0)
  ->Name("Tiles/forward/whole/32")
  ->Arg(256)
  ->Apply(once);
BENCHMARK_CAPTURE(run, tiled, FlowTables::Tiled, FlowDirection::Forward, 32, 0)
  ->Name("Tiles/forward/tiled/32")
  ->Arg(256)
  ->Arg(512)
  ->Apply(once);
BENCHMARK_CAPTURE(run, accurate, FlowTables::Tiled, FlowDirection::Forward, 48, 0)
  ->Name("Tiles/forward/tiled/48")
  ->Arg(512)
  ->Apply(once);
BENCHMARK_CAPTURE(run, whole_back, FlowTables::Whole, FlowDirection::Backward, 32, 0)
  ->Name("Tiles/backward/whole/32")
  ->Arg(256)
  ->Apply(once);
BENCHMARK_CAPTURE(run, tiled_back, FlowTables::Tiled, FlowDirection::Backward, 32, 0)
  ->Name("Tiles/backward/tiled/32")
  ->Arg(256)
  ->Arg(512)
  ->Apply(once);
BENCHMARK_CAPTURE(run, points, FlowTables::Tiled, FlowDirection::Forward, 64, 10000000)
  ->Name("Tiles/points/tiled/64")
  ->Arg(1024)
  ->Apply(once);

} // namespace
} // namespace RectifiedTransport

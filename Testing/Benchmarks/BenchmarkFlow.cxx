// SPDX-License-Identifier: BSD-3-Clause
// The flow on tables that are there: cost a velocity and a particle, the flow maps, the sort,
// threads.
#include "BenchmarkInputs.h"

#include "Core/Flow/Particles/ParticleOrder.h"
#include "PaperTransport.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

// A share of the lattice of one particle a cell, the same for both.
constexpr std::int64_t ShareRuns = 16;

void reportCost(benchmark::State& state, std::size_t particles, double evaluations)
{
  using benchmark::Counter;
  const auto rate = Counter::kIsIterationInvariantRate | Counter::kInvert;
  state.counters["per_particle"] = Counter(static_cast<double>(particles), rate);
  state.counters["per_velocity"] = Counter(evaluations, rate);
}

template <int Dimension>
void paperFlow(benchmark::State& state)
{
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  const auto tables = Paper::buildTables(density.Values, density.Size);
  const Particles<Dimension> seeds = latticeParticles<Dimension>(density.Size, ShareRuns);
  for (auto _ : state)
  {
    Particles<Dimension> particles = seeds;
    Paper::advect(tables, particles, PaperSteps, Paper::FinalVelocity::Zero);
    benchmark::DoNotOptimize(particles.data());
  }
  reportCost(state, seeds.size(), 4.0 * PaperSteps * static_cast<double>(seeds.size()));
}

// With tables and flow maps that are there; of so many runs of 1024 particles.
template <int Dimension>
void coreFlow(benchmark::State& state, int threadCount, FlowMaps maps, std::int64_t runs)
{
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  const Particles<Dimension> seeds = latticeParticles<Dimension>(density.Size, runs);
  const OpenMPThreads threads(threadCount);
  const OpenMPExecutor executor;
  Particles<Dimension> particles;
  FlowReport report;
  timeFlow(state, density, Tables::Kept, executor, [&](const RectifiedFlow<Dimension>& flow) {
    particles = seeds;
    report = moveForward(flow, particles, executor, maps);
  });
  reportCost(state, seeds.size(), static_cast<double>(report.Evaluations));
}

template <int Dimension>
void makeMaps(benchmark::State& state, int threadCount)
{
  const OpenMPThreads threads(threadCount);
  timeMaps<Dimension>(state, texturedGaussians<Dimension>(state.range(0)));
}

// `few` particles are so many runs of 1024, fewer than flow maps pay for.
template <int Dimension>
void addAll(const std::vector<std::int64_t>& sides, std::int64_t sideOfFew, std::int64_t few)
{
  const std::string group = "Flow" + std::to_string(Dimension) + "D/";
  addBenchmark(group + "paper", sides, paperFlow<Dimension>);
  for (const int threads : { 1, 2 })
  {
    const auto add = [&](const std::string& kind, auto run) {
      auto* added = addBenchmark(group + kind + (threads == 2 ? "_2_threads" : ""), sides, run);
      if (threads == 2)
      {
        added->UseRealTime();
      }
    };
    add("core", [threads](benchmark::State& state) {
      coreFlow<Dimension>(state, threads, FlowMaps::On, 4 * ShareRuns);
    });
    add("core_off", [threads](benchmark::State& state) {
      coreFlow<Dimension>(state, threads, FlowMaps::Off, 4 * ShareRuns);
    });
    add("maps", [threads](benchmark::State& state) { makeMaps<Dimension>(state, threads); });
  }
  addBenchmark(group + "few", { sideOfFew },
    [few](benchmark::State& state) { coreFlow<Dimension>(state, 1, FlowMaps::Auto, few); });
  addBenchmark(group + "few_off", { sideOfFew },
    [few](benchmark::State& state) { coreFlow<Dimension>(state, 1, FlowMaps::Off, few); });
}

const bool added = []() {
  addAll<2>({ 256, 512, 1024, 2048, 4096 }, 1024, 1);
  addAll<3>({ 64, 128, 256 }, 256, 8);
  return true;
}();

// Particles in random order, the hardest for the sort's memory traffic.
template <int Dimension>
void sortParticles(benchmark::State& state)
{
  std::mt19937_64 engine(1);
  Particles<Dimension> particles(static_cast<std::size_t>(state.range(0)));
  for (Point<Dimension>& particle : particles)
  {
    for (double& coordinate : particle)
    {
      coordinate = 256.0 * uniformNumber(engine);
    }
  }
  ParticleOrder<Dimension> order;
  for (auto _ : state)
  {
    order.Sort(particles, 0, state.range(0), 64);
    benchmark::DoNotOptimize(order.Order());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void counts(benchmark::internal::Benchmark* b)
{
  b->Arg(40000)->Arg(1000000)->Unit(benchmark::kMillisecond);
}

BENCHMARK(sortParticles<2>)->Name("Sort2D/core")->Apply(counts);
BENCHMARK(sortParticles<3>)->Name("Sort3D/core")->Apply(counts);

} // namespace
} // namespace RectifiedTransport

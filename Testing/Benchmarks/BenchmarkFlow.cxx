// SPDX-License-Identifier: BSD-3-Clause
// The flow on tables that are there: cost a velocity and a particle, the sort, threads.
#include "BenchmarkInputs.h"

#include "Core/Flow/ParticleOrder.h"
#include "PaperTransport.h"

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

template <int Dimension, int ThreadCount>
void coreFlow(benchmark::State& state)
{
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  const RectifiedFlow<Dimension> flow(density.Source());
  const Particles<Dimension> seeds = latticeParticles<Dimension>(density.Size, 4 * ShareRuns);
  const OpenMPThreads threads(ThreadCount);
  FlowReport report;
  for (auto _ : state)
  {
    Particles<Dimension> particles = seeds;
    report = moveForward(flow, particles, OpenMPExecutor());
    benchmark::DoNotOptimize(particles.data());
  }
  reportCost(state, seeds.size(), static_cast<double>(report.Evaluations));
}

void sides2D(benchmark::internal::Benchmark* b)
{
  b->RangeMultiplier(2)->Range(256, 4096)->Unit(benchmark::kMillisecond);
}

void sides3D(benchmark::internal::Benchmark* b)
{
  b->RangeMultiplier(2)->Range(64, 256)->Unit(benchmark::kMillisecond);
}

BENCHMARK(paperFlow<2>)->Name("Flow2D/paper")->Apply(sides2D);
BENCHMARK(paperFlow<3>)->Name("Flow3D/paper")->Apply(sides3D);
BENCHMARK(coreFlow<2, 1>)->Name("Flow2D/core")->Apply(sides2D);
BENCHMARK(coreFlow<3, 1>)->Name("Flow3D/core")->Apply(sides3D);
BENCHMARK(coreFlow<2, 2>)->Name("Flow2D/core_2_threads")->Apply(sides2D)->UseRealTime();
BENCHMARK(coreFlow<3, 2>)->Name("Flow3D/core_2_threads")->Apply(sides3D)->UseRealTime();

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

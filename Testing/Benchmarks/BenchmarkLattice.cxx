// SPDX-License-Identifier: BSD-3-Clause
// One particle a cell: the order that a lattice has by itself against the sort, alone and with the
// flow, in either direction.
#include "BenchmarkInputs.h"

#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Flow/Particles/ParticleOrder.h"

namespace RectifiedTransport
{
namespace
{

void reportCost(benchmark::State& state, std::size_t particles)
{
  state.counters["per_particle"] = benchmark::Counter(static_cast<double>(particles),
    benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <int Dimension, bool Backward, bool Sorted>
void latticeFlow(benchmark::State& state)
{
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  const RectifiedFlow<Dimension> flow(density.Source());
  const Particles<Dimension> seeds = latticeParticles<Dimension>(density.Size);
  Particles<Dimension> positions(seeds.size());
  const SerialExecutor serial;
  for (auto _ : state)
  {
    if (Sorted)
    {
      Backward ? flow.Backward(seeds, positions, {}, serial)
               : flow.Forward(seeds, positions, {}, serial);
    }
    else
    {
      Backward ? flow.Backward(FlowSeeds<Dimension>::Lattice(density.Size), positions, {}, serial)
               : flow.Forward(FlowSeeds<Dimension>::Lattice(density.Size), positions, {}, serial);
    }
    benchmark::DoNotOptimize(positions.data());
  }
  reportCost(state, seeds.size());
}

// The order alone, with the seeds that the flow then finds in it.
template <int Dimension>
void latticeOrder(benchmark::State& state)
{
  constexpr int grain = 1024;
  const GridSize<Dimension> size = evenSize<Dimension>(state.range(0));
  const LatticeOrder<Dimension> order(size, size);
  std::int64_t index[grain];
  double points[grain * Dimension];
  for (auto _ : state)
  {
    for (std::int64_t first = 0; first < order.Count(); first += grain)
    {
      order.Fill(first, static_cast<int>(std::min<std::int64_t>(grain, order.Count() - first)),
        index, points);
      benchmark::DoNotOptimize(points);
    }
  }
  reportCost(state, static_cast<std::size_t>(order.Count()));
}

template <int Dimension>
void sortedOrder(benchmark::State& state)
{
  constexpr std::int64_t chunk = std::int64_t{ 1 } << 20; // as the flow takes them
  const Particles<Dimension> seeds =
    latticeParticles<Dimension>(evenSize<Dimension>(state.range(0)));
  const auto count = static_cast<std::int64_t>(seeds.size());
  for (auto _ : state)
  {
    ParticleOrder<Dimension> order;
    for (std::int64_t first = 0; first < count; first += chunk)
    {
      order.Sort(seeds, first, std::min(chunk, count - first), 8);
      benchmark::DoNotOptimize(order.Order());
    }
  }
  reportCost(state, seeds.size());
}

void sides2D(benchmark::internal::Benchmark* b)
{
  b->Arg(512)->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond);
}

void sides3D(benchmark::internal::Benchmark* b)
{
  b->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond);
}

BENCHMARK(latticeOrder<2>)->Name("Lattice2D/order")->Apply(sides2D);
BENCHMARK(sortedOrder<2>)->Name("Lattice2D/sort")->Apply(sides2D);
BENCHMARK(latticeFlow<2, false, false>)->Name("Lattice2D/forward")->Apply(sides2D);
BENCHMARK(latticeFlow<2, false, true>)->Name("Lattice2D/forward_sorted")->Apply(sides2D);
BENCHMARK(latticeFlow<2, true, false>)->Name("Lattice2D/backward")->Apply(sides2D);
BENCHMARK(latticeFlow<2, true, true>)->Name("Lattice2D/backward_sorted")->Apply(sides2D);
BENCHMARK(latticeOrder<3>)->Name("Lattice3D/order")->Apply(sides3D);
BENCHMARK(sortedOrder<3>)->Name("Lattice3D/sort")->Apply(sides3D);
BENCHMARK(latticeFlow<3, false, false>)->Name("Lattice3D/forward")->Apply(sides3D);
BENCHMARK(latticeFlow<3, false, true>)->Name("Lattice3D/forward_sorted")->Apply(sides3D);
BENCHMARK(latticeFlow<3, true, false>)->Name("Lattice3D/backward")->Apply(sides3D);
BENCHMARK(latticeFlow<3, true, true>)->Name("Lattice3D/backward_sorted")->Apply(sides3D);

} // namespace
} // namespace RectifiedTransport

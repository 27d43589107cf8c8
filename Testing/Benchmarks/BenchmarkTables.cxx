// SPDX-License-Identifier: BSD-3-Clause
// Summed-area tables: allocation and construction from doubles in memory.
#include "BenchmarkInputs.h"

#include "FreshMemory.h"
#include "PaperTransport.h"

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
void paperTables(benchmark::State& state)
{
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(Paper::buildTables(density.Values, density.Size));
  }
}

template <int Dimension, int ThreadCount>
void coreTables(benchmark::State& state)
{
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  const OpenMPThreads threads(ThreadCount);
  for (auto _ : state)
  {
    const RectifiedFlow<Dimension> flow(density.Source(), OpenMPExecutor());
    benchmark::DoNotOptimize(flow.Total());
  }
}

// As above, in memory that earlier builds have left. The allocator needs a few until a free block
// fits.
constexpr int EarlierBuilds = 3;

template <int Dimension>
void paperTablesReused(benchmark::State& state)
{
  const ReusedMemory reused;
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  const auto build = [&]() {
    benchmark::DoNotOptimize(Paper::buildTables(density.Values, density.Size));
  };
  for (int i = 0; i < EarlierBuilds; ++i)
  {
    build();
  }
  for (auto _ : state)
  {
    build();
  }
}

template <int Dimension>
void coreTablesReused(benchmark::State& state)
{
  const ReusedMemory reused;
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(state.range(0));
  const auto build = [&]() {
    const RectifiedFlow<Dimension> flow(density.Source(), SerialExecutor());
    benchmark::DoNotOptimize(flow.Total());
  };
  for (int i = 0; i < EarlierBuilds; ++i)
  {
    build();
  }
  for (auto _ : state)
  {
    build();
  }
}

void sides2D(benchmark::internal::Benchmark* b)
{
  b->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);
}

void sides3D(benchmark::internal::Benchmark* b)
{
  b->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond);
}

BENCHMARK(paperTables<2>)->Name("Tables2D/paper")->Apply(sides2D);
BENCHMARK(paperTables<3>)->Name("Tables3D/paper")->Apply(sides3D);
BENCHMARK(paperTablesReused<2>)->Name("Tables2D/paper_reused")->Apply(sides2D);
BENCHMARK(paperTablesReused<3>)->Name("Tables3D/paper_reused")->Apply(sides3D);
BENCHMARK(coreTablesReused<2>)->Name("Tables2D/core_reused")->Apply(sides2D);
BENCHMARK(coreTablesReused<3>)->Name("Tables3D/core_reused")->Apply(sides3D);
BENCHMARK(coreTables<2, 1>)->Name("Tables2D/core")->Apply(sides2D);
BENCHMARK(coreTables<3, 1>)->Name("Tables3D/core")->Apply(sides3D);
BENCHMARK(coreTables<2, 2>)->Name("Tables2D/core_2_threads")->Apply(sides2D)->UseRealTime();
BENCHMARK(coreTables<3, 2>)->Name("Tables3D/core_2_threads")->Apply(sides3D)->UseRealTime();

} // namespace
} // namespace RectifiedTransport

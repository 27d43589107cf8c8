// SPDX-License-Identifier: BSD-3-Clause
// Summed-area tables: allocation and construction from doubles in memory.
#include "BenchmarkInputs.h"

#include "FreshMemory.h"
#include "PaperTransport.h"

#include <cstddef>

namespace RectifiedTransport
{
namespace
{

template <int Dimension>
void buildPaper(std::int64_t side)
{
  const TestDensity<Dimension>& density = texturedGaussians<Dimension>(side);
  benchmark::DoNotOptimize(Paper::buildTables(density.Values, density.Size));
}

template <int Dimension>
void buildCore(std::int64_t side)
{
  const RectifiedFlow<Dimension> flow(
    texturedGaussians<Dimension>(side).Source(), OpenMPExecutor());
  benchmark::DoNotOptimize(flow.Total());
}

// In pages that are new to the process. One build goes before, so that in a virtual machine the
// host has found its pages: what that takes changes twentyfold from minute to minute.
template <void (*Build)(std::int64_t), int ThreadCount>
void fresh(benchmark::State& state)
{
  const OpenMPThreads threads(ThreadCount);
  Build(state.range(0));
  for (auto _ : state)
  {
    Build(state.range(0));
  }
}

// In memory that earlier builds have left. The allocator needs some until a free block fits, how
// many depends on what ran before.
template <void (*Build)(std::int64_t), int ThreadCount>
void reused(benchmark::State& state)
{
  const ReusedMemory memory;
  const OpenMPThreads threads(ThreadCount);
  constexpr int most = 100;
  std::size_t before = 0;
  for (int i = 0; i < most && (i < 3 || memory.Size() != before); ++i)
  {
    before = memory.Size();
    Build(state.range(0));
  }
  for (auto _ : state)
  {
    Build(state.range(0));
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

BENCHMARK(fresh<buildPaper<2>, 1>)->Name("Tables2D/paper")->Apply(sides2D);
BENCHMARK(fresh<buildPaper<3>, 1>)->Name("Tables3D/paper")->Apply(sides3D);
BENCHMARK(reused<buildPaper<2>, 1>)->Name("Tables2D/paper_reused")->Apply(sides2D);
BENCHMARK(reused<buildPaper<3>, 1>)->Name("Tables3D/paper_reused")->Apply(sides3D);
BENCHMARK(reused<buildCore<2>, 1>)->Name("Tables2D/core_reused")->Apply(sides2D);
BENCHMARK(reused<buildCore<3>, 1>)->Name("Tables3D/core_reused")->Apply(sides3D);
BENCHMARK(fresh<buildCore<2>, 1>)->Name("Tables2D/core")->Apply(sides2D);
BENCHMARK(fresh<buildCore<3>, 1>)->Name("Tables3D/core")->Apply(sides3D);
BENCHMARK(fresh<buildCore<2>, 2>)->Name("Tables2D/core_2_threads")->Apply(sides2D)->UseRealTime();
BENCHMARK(reused<buildCore<2>, 2>)
  ->Name("Tables2D/core_reused_2_threads")
  ->Apply(sides2D)
  ->UseRealTime();
BENCHMARK(fresh<buildCore<3>, 2>)->Name("Tables3D/core_2_threads")->Apply(sides3D)->UseRealTime();
BENCHMARK(reused<buildCore<3>, 2>)
  ->Name("Tables3D/core_reused_2_threads")
  ->Apply(sides3D)
  ->UseRealTime();

} // namespace
} // namespace RectifiedTransport

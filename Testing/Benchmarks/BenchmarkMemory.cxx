// SPDX-License-Identifier: BSD-3-Clause
// What the core holds beyond its input and the particles; and how fast the machine moves memory, on
// one thread and on two, which bounds what a second thread can gain in the tables and the splat.
#include "BenchmarkInputs.h"
#include "PeakMemory.h"

#include "Core/Parallel/LargeBuffer.h"

#include <algorithm>
#include <cstring>
#include <memory>

namespace RectifiedTransport
{
namespace
{

// The flow maps are made for one particle. Then a step of all is enough, as it has none of its own.
void memory(benchmark::State& state, FlowMaps maps)
{
  const TestDensity<3>& density = texturedGaussians<3>(state.range(0));
  Particles<3> particle{ evenPoint<3>(1.0) };
  Particles<3> particles = latticeParticles<3>(density.Size);
  FlowOptions options;
  options.NumberOfSteps = 1;
  for (auto _ : state)
  {
    resetPeakMemory();
    const double before = peakMemory();
    const RectifiedFlow<3> flow(density.Source());
    const std::int64_t tables = flow.MemorySize();
    moveForward(flow, particle, OpenMPExecutor(), maps);
    flow.Forward(particles, particles, options);
    state.counters["peak_bytes"] = peakMemory() - before;
    state.counters["table_bytes"] = static_cast<double>(tables);
    state.counters["map_bytes"] = static_cast<double>(flow.MemorySize() - tables);
  }
}

// Memory that is passed over, beyond all caches, and the part of it that a range takes. Threads
// that write to one new huge page at a time each clear a page, and one of the two is thrown away.
constexpr std::int64_t passed = std::int64_t{ 1 } << 28;
constexpr std::int64_t hugePage = std::int64_t{ 1 } << 21;

double sumOf(const double* from, std::int64_t count)
{
  double sums[8] = {};
  for (std::int64_t i = 0; i < count; i += 8)
  {
    for (int lane = 0; lane < 8; ++lane)
    {
      sums[lane] += from[i + lane];
    }
  }
  return sums[0] + sums[1] + sums[2] + sums[3] + sums[4] + sums[5] + sums[6] + sums[7];
}

// By plain stores, for which the processor first reads what is overwritten.
void writeTo(double* to, std::int64_t count)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    to[i] = 1.0;
  }
}

enum class Pass
{
  Read,
  Write,
  Add,  // reads and writes the same
  Copy, // by the C library
  Clear // by the C library
};

template <Pass Kind>
void passRange(double* to, const double* from, std::int64_t count)
{
  if (Kind == Pass::Read)
  {
    benchmark::DoNotOptimize(sumOf(from, count));
  }
  else if (Kind == Pass::Write)
  {
    writeTo(to, count);
  }
  else if (Kind == Pass::Add)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      to[i] += 1.0;
    }
  }
  else if (Kind == Pass::Copy)
  {
    std::memcpy(to, from, static_cast<std::size_t>(count) * sizeof(double));
  }
  else
  {
    std::memset(to, 0, static_cast<std::size_t>(count) * sizeof(double));
  }
  benchmark::ClobberMemory();
}

template <Pass Kind>
void passOver(double* to, const double* from, std::int64_t grain = hugePage)
{
  constexpr auto each = static_cast<std::int64_t>(sizeof(double));
  OpenMPExecutor().For(
    passed / each, grain / each, [to, from](std::int64_t first, std::int64_t last) {
      passRange<Kind>(to + first, from + first, last - first);
    });
}

// In memory that has been written before. The bytes that are stated are those that the loop reads
// and writes.
template <Pass Kind, int ThreadCount>
void bandwidth(benchmark::State& state)
{
  constexpr auto count = passed / static_cast<std::int64_t>(sizeof(double));
  const OpenMPThreads threads(ThreadCount);
  LargeBuffer<double> to(count);
  LargeBuffer<double> from(count);
  passOver<Pass::Write>(to.data(), nullptr);
  passOver<Pass::Write>(from.data(), nullptr);
  for (auto _ : state)
  {
    passOver<Kind>(to.data(), from.data());
  }
  constexpr int directions = Kind == Pass::Add || Kind == Pass::Copy ? 2 : 1;
  state.SetBytesProcessed(state.iterations() * directions * passed);
}

// In pages that are new to the process, huge ones or small ones. The host has found them before, as
// in BenchmarkTables.cxx.
template <bool IsHuge, int ThreadCount, std::int64_t Grain = hugePage>
void firstWrite(benchmark::State& state)
{
  constexpr auto count = passed / static_cast<std::int64_t>(sizeof(double));
  const OpenMPThreads threads(ThreadCount);
  for (int i = 0; i < 2; ++i)
  {
    LargeBuffer<double> to(count);
    passOver<Pass::Write>(to.data(), nullptr, Grain);
  }
  for (auto _ : state)
  {
    if (IsHuge)
    {
      LargeBuffer<double> to(count);
      passOver<Pass::Write>(to.data(), nullptr, Grain);
    }
    else
    {
      const std::unique_ptr<double[]> to(new double[count]);
      passOver<Pass::Write>(to.get(), nullptr, Grain);
    }
  }
  state.SetBytesProcessed(state.iterations() * passed);
}

// Sums within the first cache of each processor: what two threads gain without memory.
template <int ThreadCount>
void arithmetic(benchmark::State& state)
{
  const OpenMPThreads threads(ThreadCount);
  for (auto _ : state)
  {
    OpenMPExecutor().For(64, 1, [](std::int64_t first, std::int64_t last) {
      double values[1024];
      std::fill(values, values + 1024, 1.0);
      for (std::int64_t i = 256 * first; i < 256 * last; ++i)
      {
        benchmark::DoNotOptimize(sumOf(values, 1024));
        benchmark::ClobberMemory();
      }
    });
  }
}

// The time of a loop that does nothing, on two threads: of a start and a barrier.
void emptyLoop(benchmark::State& state)
{
  const OpenMPThreads threads(2);
  for (auto _ : state)
  {
    OpenMPExecutor().For(2, 1, [](std::int64_t, std::int64_t) {});
  }
}

void inRealTime(benchmark::internal::Benchmark* b)
{
  b->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(memory, on, FlowMaps::On)
  ->Name("Memory/core")
  ->Arg(256)
  ->Iterations(1)
  ->Repetitions(1);
BENCHMARK_CAPTURE(memory, off, FlowMaps::Off)
  ->Name("Memory/core_off")
  ->Arg(256)
  ->Iterations(1)
  ->Repetitions(1);
BENCHMARK(bandwidth<Pass::Read, 1>)->Name("Bandwidth/read")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Read, 2>)->Name("Bandwidth/read_2_threads")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Write, 1>)->Name("Bandwidth/write")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Write, 2>)->Name("Bandwidth/write_2_threads")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Add, 1>)->Name("Bandwidth/add")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Add, 2>)->Name("Bandwidth/add_2_threads")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Copy, 1>)->Name("Bandwidth/copy")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Copy, 2>)->Name("Bandwidth/copy_2_threads")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Clear, 1>)->Name("Bandwidth/clear")->Apply(inRealTime);
BENCHMARK(bandwidth<Pass::Clear, 2>)->Name("Bandwidth/clear_2_threads")->Apply(inRealTime);
BENCHMARK(firstWrite<true, 1>)->Name("Bandwidth/first_write")->Apply(inRealTime);
BENCHMARK(firstWrite<true, 2>)->Name("Bandwidth/first_write_2_threads")->Apply(inRealTime);
BENCHMARK(firstWrite<true, 2, hugePage / 8>)
  ->Name("Bandwidth/first_write_shared_pages_2_threads")
  ->Apply(inRealTime);
BENCHMARK(firstWrite<false, 1>)->Name("Bandwidth/first_write_small_pages")->Apply(inRealTime);
BENCHMARK(firstWrite<false, 2>)
  ->Name("Bandwidth/first_write_small_pages_2_threads")
  ->Apply(inRealTime);
BENCHMARK(arithmetic<1>)->Name("Bandwidth/none")->Apply(inRealTime);
BENCHMARK(arithmetic<2>)->Name("Bandwidth/none_2_threads")->Apply(inRealTime);
BENCHMARK(emptyLoop)->Name("Bandwidth/empty_loop_2_threads")->Apply(inRealTime);

} // namespace
} // namespace RectifiedTransport

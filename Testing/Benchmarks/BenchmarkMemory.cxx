// SPDX-License-Identifier: BSD-3-Clause
// What the core holds beyond its input and the particles.
#include "BenchmarkInputs.h"

#include <cstdio>

namespace RectifiedTransport
{
namespace
{

// The largest resident size since the last reset, in bytes; 0 where the system does not tell.
double peakMemory()
{
  double kilobytes = 0.0;
  if (std::FILE* status = std::fopen("/proc/self/status", "r"))
  {
    char line[256];
    while (std::fgets(line, sizeof(line), status))
    {
      std::sscanf(line, "VmHWM: %lf", &kilobytes);
    }
    std::fclose(status);
  }
  return 1024.0 * kilobytes;
}

void resetPeakMemory()
{
  if (std::FILE* references = std::fopen("/proc/self/clear_refs", "w"))
  {
    std::fputs("5", references);
    std::fclose(references);
  }
}

void memory(benchmark::State& state)
{
  const TestDensity<3>& density = texturedGaussians<3>(state.range(0));
  Particles<3> particles = latticeParticles<3>(density.Size);
  FlowOptions options;
  options.NumberOfSteps = 1;
  for (auto _ : state)
  {
    resetPeakMemory();
    const double before = peakMemory();
    const RectifiedFlow<3> flow(density.Source());
    flow.Forward(particles, particles, options);
    state.counters["peak_bytes"] = peakMemory() - before;
    state.counters["table_bytes"] = static_cast<double>(flow.MemorySize());
  }
}

BENCHMARK(memory)->Name("Memory/core")->Arg(256)->Iterations(1)->Repetitions(1);

} // namespace
} // namespace RectifiedTransport

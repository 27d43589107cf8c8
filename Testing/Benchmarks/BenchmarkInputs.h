// SPDX-License-Identifier: BSD-3-Clause
// What the benchmarks share. Everything is measured on one thread, in processor time, unless its
// name says otherwise; the core and the literal transcription of the paper in one process, on the
// same densities and particles.
#ifndef RectifiedTransport_BenchmarkInputs_h
#define RectifiedTransport_BenchmarkInputs_h

#include "../Core/Oracle.h"
#include "../Core/TestDensities.h"
#include "Core/Flow/RectifiedFlow.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace RectifiedTransport
{

// What the paper settles on.
constexpr int PaperSteps = 50;

template <int Dimension>
using Particles = std::vector<Point<Dimension>>;

// Two Gaussians with a texture of noise; made once a size and kept.
template <int Dimension>
const TestDensity<Dimension>& texturedGaussians(std::int64_t side)
{
  static std::map<std::int64_t, TestDensity<Dimension>> densities;
  TestDensity<Dimension>& density = densities[side];
  if (density.Values.empty())
  {
    density = twoGaussians<Dimension>(evenSize<Dimension>(side));
    std::mt19937_64 engine(1);
    for (double& value : density.Values)
    {
      value *= 0.7 + 0.6 * uniformNumber(engine);
    }
  }
  return density;
}

// One particle at every cell's centre, in the order of the cells; or, of `runs` > 0, the share that
// consists of so many runs of 1024 consecutive particles, evenly spaced: neighbours in memory are
// then neighbours in space, as in the whole lattice.
template <int Dimension>
Particles<Dimension> latticeParticles(const GridSize<Dimension>& size, std::int64_t runs = 0)
{
  const std::int64_t cells = cellCount<Dimension>(size);
  const std::int64_t length = runs > 0 ? 1024 : cells;
  runs = runs > 0 ? runs : 1;
  Particles<Dimension> particles;
  particles.reserve(static_cast<std::size_t>(runs * length));
  for (std::int64_t run = 0; run < runs; ++run)
  {
    const std::int64_t first = (2 * run + 1) * cells / (2 * runs) - length / 2;
    for (std::int64_t index = first; index < first + length; ++index)
    {
      const GridSize<Dimension> cell = cellAt<Dimension>(index, size);
      Point<Dimension> particle;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        particle[axis] = static_cast<double>(cell[axis]) + 0.5;
      }
      particles.push_back(particle);
    }
  }
  return particles;
}

inline FlowOptions withMaps(FlowMaps maps)
{
  FlowOptions options;
  options.Maps = maps;
  return options;
}

// Moves particles from time 0 to time 1 in place.
template <int Dimension>
FlowReport moveForward(const RectifiedFlow<Dimension>& flow,
  std::vector<std::array<double, static_cast<std::size_t>(Dimension)>>& particles,
  const Executor& executor = SerialExecutor(), FlowMaps maps = FlowMaps::Auto)
{
  return flow.Forward(particles, particles, withMaps(maps), executor);
}

// Whether each iteration makes tables and flow maps, or finds them.
enum class Tables
{
  New,
  Kept
};

// Times move(flow), and the making of the flow where it is new. Memory is used once before the
// clock starts, as in BenchmarkTables.cxx.
template <int Dimension, class Move>
void timeFlow(benchmark::State& state, const TestDensity<Dimension>& density, Tables tables,
  const Executor& executor, const Move& move)
{
  std::optional<RectifiedFlow<Dimension>> flow(std::in_place, density.Source(), executor);
  if (tables == Tables::Kept)
  {
    move(*flow);
  }
  for (auto _ : state)
  {
    if (tables == Tables::New)
    {
      flow.reset();
      flow.emplace(density.Source(), executor);
    }
    move(*flow);
  }
}

// The making of the flow maps for tables that are there: the flow of one particle, with the tables
// made anew between the iterations, as the flow keeps its maps.
template <int Dimension>
void timeMaps(benchmark::State& state, const TestDensity<Dimension>& density)
{
  const OpenMPExecutor executor;
  RectifiedFlow<Dimension> flow(density.Source(), executor);
  const std::int64_t tableBytes = flow.MemorySize();
  for (auto _ : state)
  {
    state.PauseTiming();
    flow = RectifiedFlow<Dimension>(density.Source(), std::move(flow), executor);
    Particles<Dimension> particle{ evenPoint<Dimension>(1.0) };
    state.ResumeTiming();
    moveForward(flow, particle, executor, FlowMaps::On);
  }
  state.counters["table_bytes"] = static_cast<double>(tableBytes);
  state.counters["map_bytes"] = static_cast<double>(flow.MemorySize() - tableBytes);
}

// Processor time of the process: other programs on the machine count little.
class Stopwatch
{
public:
  double Seconds() const
  {
    return static_cast<double>(std::clock() - this->Start) / CLOCKS_PER_SEC;
  }

private:
  std::clock_t Start = std::clock();
};

// Limits OpenMP for the life of the object.
class OpenMPThreads
{
public:
#ifdef _OPENMP
  explicit OpenMPThreads(int threads)
    : Before(omp_get_max_threads())
  {
    omp_set_num_threads(threads);
  }
  ~OpenMPThreads()
  {
    omp_set_num_threads(this->Before);
  }

private:
  int Before;
#else
  explicit OpenMPThreads(int) {}
#endif
};

// Not outside and not NaN.
template <int Dimension>
bool isInside(const std::array<double, static_cast<std::size_t>(Dimension)>& particle,
  const GridSize<Dimension>& size)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    if (!(particle[axis] >= 0.0 && particle[axis] <= static_cast<double>(size[axis])))
    {
      return false;
    }
  }
  return true;
}

// A benchmark whose name and parameters are known at run time, for each side.
template <class Run>
benchmark::internal::Benchmark* addBenchmark(
  const std::string& name, const std::vector<std::int64_t>& sides, Run run)
{
  benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(name.c_str(), run);
  added->Unit(benchmark::kMillisecond);
  for (const std::int64_t side : sides)
  {
    added->Arg(side);
  }
  return added;
}

// Where an evenly spaced sample of particles truly goes.
template <int Dimension>
class SampleTruth
{
public:
  SampleTruth(const TestDensity<Dimension>& density, const Particles<Dimension>& seeds,
    std::size_t count, bool backward = false)
    : Size(density.Size)
    , Stride(std::max(seeds.size() / count, std::size_t{ 1 }))
  {
    const Oracle<Dimension> oracle(density.Values, density.Size);
    const Particles<Dimension> chosen = this->Choose(seeds);
    this->Truth = backward ? oracle.Backward(chosen) : oracle.Forward(chosen);
  }

  // States the errors of the positions of all particles that are not lost, in cells.
  void Report(benchmark::State& state, const Particles<Dimension>& positions) const
  {
    Particles<Dimension> found;
    Particles<Dimension> truth;
    const Particles<Dimension> chosen = this->Choose(positions);
    for (std::size_t i = 0; i < chosen.size(); ++i)
    {
      if (isInside<Dimension>(chosen[i], this->Size))
      {
        found.push_back(chosen[i]);
        truth.push_back(this->Truth[i]);
      }
    }
    const PositionErrors errors = comparePositions<Dimension>(found, truth);
    state.counters["error_mean"] = errors.Mean;
    state.counters["error_95"] = errors.Percentile95;
    state.counters["error_999"] = errors.Percentile999;
  }

private:
  Particles<Dimension> Choose(const Particles<Dimension>& particles) const
  {
    Particles<Dimension> chosen;
    for (std::size_t i = this->Stride / 2; i < particles.size(); i += this->Stride)
    {
      chosen.push_back(particles[i]);
    }
    return chosen;
  }

  GridSize<Dimension> Size;
  std::size_t Stride;
  Particles<Dimension> Truth;
};

} // namespace RectifiedTransport

#endif

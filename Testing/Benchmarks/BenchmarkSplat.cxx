// SPDX-License-Identifier: BSD-3-Clause
// Particles to a grid of as many cells, beside the time that it takes to read the particles'
// coordinates and to write the grid once.
#include "BenchmarkInputs.h"

#include "FreshMemory.h"

#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Splat/Splat.h"

#include <algorithm>

namespace RectifiedTransport
{
namespace
{

enum class Order
{
  Tiles, // the lattice's own, each particle up to 0.4 cells from a cell's centre
  Random
};

template <int D>
struct SplatInput
{
  GridSize<D> Size;
  std::int64_t Count;
  LargeBuffer<double> Points;

  SplatInput(std::int64_t side, Order order)
  {
    this->Size.fill(side);
    const LatticeOrder<D> lattice(this->Size, this->Size);
    this->Count = lattice.Count();
    this->Points = LargeBuffer<double>(3 * this->Count);
    constexpr int block = 64;
    std::int64_t index[block];
    double centres[D * block];
    for (std::int64_t first = 0; first < this->Count; first += block)
    {
      const int count = static_cast<int>(std::min<std::int64_t>(block, this->Count - first));
      lattice.Fill(first, count, index, centres);
      for (int i = 0; i < count; ++i)
      {
        for (int a = 0; a < 3; ++a)
        {
          const auto word = static_cast<std::uint64_t>(3 * (first + i) + a);
          const double u = unitReal(randomWord(1, word));
          const double near = centres[D * i + std::min(a, D - 1)] + 0.8 * (u - 0.5);
          const double x = order == Order::Tiles ? near : static_cast<double>(side) * u;
          this->Points.data()[3 * (first + i) + a] = a < D ? x : 0.0;
        }
      }
    }
  }
};

template <int D>
const SplatInput<D>& splatInput(std::int64_t side, Order order)
{
  static std::unique_ptr<SplatInput<D>> kept;
  static Order keptOrder;
  if (!kept || kept->Size[0] != side || keptOrder != order)
  {
    kept.reset();
    kept = std::make_unique<SplatInput<D>>(side, order);
    keptOrder = order;
  }
  return *kept;
}

template <int D>
void splatInto(const SplatInput<D>& input, SplatKernel kernel, double* cells)
{
  SplatParticles<D, double> particles{ { input.Points.data(), input.Count }, nullptr, 1.0, {} };
  for (int a = 0; a < 3; ++a)
  {
    particles.ToIndex.Matrix[a][a] = 1.0;
    particles.ToIndex.Tolerance[a] = 1e-6;
  }
  SplatOptions options;
  options.Kernel = kernel;
  splatMass<D, double>(particles, input.Size, options, 1.0, cells);
}

// What no splat can do without.
template <int D>
void readAndWrite(const SplatInput<D>& input, double* cells)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 16;
  const OpenMPExecutor executor;
  const double* points = input.Points.data();
  executor.For(3 * input.Count, grain, [points](std::int64_t first, std::int64_t last) {
    double sums[8] = {};
    for (; first + 8 <= last; first += 8)
    {
      for (int i = 0; i < 8; ++i)
      {
        sums[i] += points[first + i];
      }
    }
    benchmark::DoNotOptimize(sums);
  });
  const std::int64_t count = static_cast<std::int64_t>(numberOfCells<D>(input.Size));
  executor.For(count, grain, [cells](std::int64_t first, std::int64_t last) {
    std::fill(cells + first, cells + last, 1.0);
  });
}

// In cells that have been written before.
template <int D, SplatKernel Kernel, Order InOrder, int ThreadCount>
void splatReused(benchmark::State& state)
{
  const OpenMPThreads threads(ThreadCount);
  const SplatInput<D>& input = splatInput<D>(state.range(0), InOrder);
  LargeBuffer<double> cells(static_cast<std::int64_t>(numberOfCells<D>(input.Size)));
  splatInto(input, Kernel, cells.data());
  for (auto _ : state)
  {
    splatInto(input, Kernel, cells.data());
  }
  state.SetItemsProcessed(state.iterations() * input.Count);
}

// In pages that are new to the process.
template <int D, SplatKernel Kernel, Order InOrder, int ThreadCount>
void splatFresh(benchmark::State& state)
{
  const OpenMPThreads threads(ThreadCount);
  const SplatInput<D>& input = splatInput<D>(state.range(0), InOrder);
  for (auto _ : state)
  {
    LargeBuffer<double> cells(static_cast<std::int64_t>(numberOfCells<D>(input.Size)));
    splatInto(input, Kernel, cells.data());
  }
  state.SetItemsProcessed(state.iterations() * input.Count);
}

template <int D, bool IsFresh, int ThreadCount>
void floorOfSplat(benchmark::State& state)
{
  const OpenMPThreads threads(ThreadCount);
  const SplatInput<D>& input = splatInput<D>(state.range(0), Order::Tiles);
  const auto count = static_cast<std::int64_t>(numberOfCells<D>(input.Size));
  LargeBuffer<double> cells(count);
  readAndWrite(input, cells.data());
  for (auto _ : state)
  {
    if (IsFresh)
    {
      LargeBuffer<double> fresh(count);
      readAndWrite(input, fresh.data());
    }
    else
    {
      readAndWrite(input, cells.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * input.Count);
}

void sides2D(benchmark::internal::Benchmark* b)
{
  b->Arg(256)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void sides3D(benchmark::internal::Benchmark* b)
{
  b->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();
}

constexpr SplatKernel cic = SplatKernel::CloudInCell;
constexpr SplatKernel ngp = SplatKernel::NearestCell;
constexpr SplatKernel tsc = SplatKernel::TriangularShapedCloud;
constexpr SplatKernel gauss = SplatKernel::Gaussian;
constexpr Order tiles = Order::Tiles;
constexpr Order random = Order::Random;

BENCHMARK(splatReused<2, cic, tiles, 1>)->Name("Splat2D/CloudInCell")->Apply(sides2D);
BENCHMARK(splatReused<2, cic, tiles, 2>)->Name("Splat2D/CloudInCell_2_threads")->Apply(sides2D);
BENCHMARK(splatReused<2, cic, random, 1>)->Name("Splat2D/CloudInCell_random")->Apply(sides2D);
BENCHMARK(floorOfSplat<3, false, 1>)->Name("Splat3D/read_and_write")->Apply(sides3D);
BENCHMARK(floorOfSplat<3, false, 2>)->Name("Splat3D/read_and_write_2_threads")->Apply(sides3D);
BENCHMARK(floorOfSplat<3, true, 1>)->Name("Splat3D/read_and_write_fresh")->Apply(sides3D);
BENCHMARK(splatReused<3, cic, tiles, 1>)->Name("Splat3D/CloudInCell")->Apply(sides3D);
BENCHMARK(splatReused<3, cic, tiles, 2>)->Name("Splat3D/CloudInCell_2_threads")->Apply(sides3D);
BENCHMARK(splatFresh<3, cic, tiles, 1>)->Name("Splat3D/CloudInCell_fresh")->Apply(sides3D);
BENCHMARK(splatReused<3, ngp, tiles, 1>)->Name("Splat3D/NearestCell")->Apply(sides3D);
BENCHMARK(splatReused<3, tsc, tiles, 1>)->Name("Splat3D/TriangularShapedCloud")->Apply(sides3D);
BENCHMARK(splatReused<3, gauss, tiles, 1>)->Name("Splat3D/Gaussian")->Apply(sides3D);
BENCHMARK(splatReused<3, cic, random, 1>)->Name("Splat3D/CloudInCell_random")->Apply(sides3D);
BENCHMARK(splatReused<3, cic, random, 2>)
  ->Name("Splat3D/CloudInCell_random_2_threads")
  ->Apply(sides3D);

} // namespace
} // namespace RectifiedTransport

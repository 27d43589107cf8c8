// SPDX-License-Identifier: BSD-3-Clause
// 0/1 shapes with holes: how many particles end in empty cells or get lost.
#include "BenchmarkInputs.h"

#include "PaperTransport.h"

namespace RectifiedTransport
{
namespace
{

// Particles that end where there is no mass, or nowhere.
template <int Dimension>
void reportStrays(benchmark::State& state, const RectifiedFlow<Dimension>& flow,
  const Particles<Dimension>& particles)
{
  std::int64_t empty = 0;
  std::int64_t lost = 0;
  for (const Point<Dimension>& particle : particles)
  {
    bool inside = true;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      inside =
        inside && particle[axis] >= 0.0 && particle[axis] <= static_cast<double>(flow.Size()[axis]);
    }
    lost += inside ? 0 : 1;
    empty += inside && !flow.HasMass(particle) ? 1 : 0;
  }
  state.counters["particles"] = static_cast<double>(particles.size());
  state.counters["in_empty_cells"] = static_cast<double>(empty);
  state.counters["lost"] = static_cast<double>(lost);
}

// Calls move(density, flow, particles).
template <int Dimension, class Move>
void countStrays(benchmark::State& state, const Move& move)
{
  const TestDensity<Dimension> density =
    discWithHole<Dimension>(evenSize<Dimension>(state.range(0)));
  const RectifiedFlow<Dimension> flow(density.Source());
  Particles<Dimension> particles = latticeParticles<Dimension>(density.Size);
  for (auto _ : state)
  {
    move(density, flow, particles);
  }
  reportStrays<Dimension>(state, flow, particles);
}

template <int Dimension>
void paperStrays(benchmark::State& state)
{
  countStrays<Dimension>(state, [](const auto& density, const auto&, auto& particles) {
    Paper::advect(Paper::buildTables(density.Values, density.Size), particles, PaperSteps,
      Paper::FinalVelocity::Zero);
  });
}

template <int Dimension>
void coreStrays(benchmark::State& state)
{
  countStrays<Dimension>(state, [](const auto&, const auto& flow, auto& particles) {
    moveForward(flow, particles, OpenMPExecutor());
  });
}

void once(benchmark::internal::Benchmark* b)
{
  b->Iterations(1)->Repetitions(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK(paperStrays<2>)->Name("Holes2D/paper")->Arg(256)->Apply(once);
BENCHMARK(coreStrays<2>)->Name("Holes2D/core")->Arg(256)->Apply(once);
BENCHMARK(paperStrays<3>)->Name("Holes3D/paper")->Arg(64)->Apply(once);
BENCHMARK(coreStrays<3>)->Name("Holes3D/core")->Arg(64)->Apply(once);

} // namespace
} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
// The parts of the optimal map on grids of nodes.
#include "BenchmarkInputs.h"

#include "Core/Grid/NodePoisson.h"
#include "Core/OptimalMap/Nodes/CostTransform.h"
#include "Core/Parallel/Progress.h"

#include <cmath>

namespace RectifiedTransport
{
namespace
{

// Potentials that are nearly concave, as in the iterations, and a difference of two densities.
template <int D>
struct NodeInput
{
  NodeGrid<D> Grid;
  NodeValues Potential;
  NodeValues Excess;
  NodeValues Density;

  explicit NodeInput(std::int64_t side)
  {
    this->Grid.Cells.fill(side);
    this->Grid.Spacing.fill(1.0 / static_cast<double>(side));
    const std::int64_t count = this->Grid.NumberOfNodes();
    this->Potential = NodeValues(count);
    this->Excess = NodeValues(count);
    this->Density = NodeValues(count);
    for (std::int64_t node = 0; node < count; ++node)
    {
      double potential = 0.0;
      double wave = 1.0;
      std::int64_t rest = node;
      for (int axis = 0; axis < D; ++axis)
      {
        const double x = static_cast<double>(rest % (side + 1)) / static_cast<double>(side);
        rest /= side + 1;
        potential += 0.03 * std::cos(5.0 * x + axis) + 0.0001 * std::cos(90.0 * x * x);
        wave *= 1.0 + 0.9 * std::cos(20.0 * x);
      }
      const auto at = static_cast<std::size_t>(node);
      this->Potential.data()[at] = potential;
      this->Density.data()[at] = wave / static_cast<double>(count);
      this->Excess.data()[at] = (wave - 1.0) / static_cast<double>(count);
    }
  }
};

template <int D, int ThreadCount>
void transformCosts(benchmark::State& state)
{
  const OpenMPThreads threads(ThreadCount);
  const NodeInput<D> input(state.range(0));
  NodeValues once(input.Grid.NumberOfNodes());
  NodeValues twice(input.Grid.NumberOfNodes());
  Progress progress{ Context() };
  for (auto _ : state)
  {
    // As in an iteration: that of a potential which is not concave, and of one which is.
    costTransform<D>(input.Grid, input.Potential.data(), once.data(), progress);
    costTransform<D>(input.Grid, once.data(), twice.data(), progress);
  }
  state.SetItemsProcessed(state.iterations() * 2 * input.Grid.NumberOfNodes());
}

template <int D>
void findMinimizers(benchmark::State& state)
{
  const OpenMPThreads threads(1);
  const NodeInput<D> input(state.range(0));
  LargeBuffer<std::int64_t> minimizers(input.Grid.NumberOfNodes());
  Progress progress{ Context() };
  for (auto _ : state)
  {
    costMinimizers<D>(input.Grid, input.Potential.data(), minimizers.data(), progress);
  }
  state.SetItemsProcessed(state.iterations() * input.Grid.NumberOfNodes());
}

template <int D, int ThreadCount>
void solvePoisson(benchmark::State& state)
{
  const OpenMPThreads threads(ThreadCount);
  const NodeInput<D> input(state.range(0));
  NodePoisson<D> poisson(input.Grid);
  NodeValues p(input.Grid.NumberOfNodes());
  Progress progress{ Context() };
  for (auto _ : state)
  {
    poisson.Solve(input.Excess.data(), p.data(), progress);
  }
  state.SetItemsProcessed(state.iterations() * input.Grid.NumberOfNodes());
}

template <int D, int ThreadCount>
void solveWeighted(benchmark::State& state)
{
  constexpr int iterations = 4;
  const OpenMPThreads threads(ThreadCount);
  const NodeInput<D> input(state.range(0));
  NodePoisson<D> poisson(input.Grid);
  NodeValues p(input.Grid.NumberOfNodes());
  Progress progress{ Context() };
  for (auto _ : state)
  {
    poisson.SolveWeighted(
      input.Excess.data(), input.Density.data(), 1.0, iterations, p.data(), progress);
  }
  state.SetItemsProcessed(state.iterations() * input.Grid.NumberOfNodes());
}

// Powers of two, and a length with a factor of five.
void sides2D(benchmark::internal::Benchmark* b)
{
  b->Arg(256)->Arg(300)->Arg(1024)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void sides3D(benchmark::internal::Benchmark* b)
{
  b->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(transformCosts<2, 1>)->Name("Optimal2D/two_cost_transforms")->Apply(sides2D);
BENCHMARK(transformCosts<2, 2>)->Name("Optimal2D/two_cost_transforms_2_threads")->Apply(sides2D);
BENCHMARK(findMinimizers<2>)->Name("Optimal2D/cost_minimizers")->Apply(sides2D);
BENCHMARK(solvePoisson<2, 1>)->Name("Optimal2D/Poisson")->Apply(sides2D);
BENCHMARK(solvePoisson<2, 2>)->Name("Optimal2D/Poisson_2_threads")->Apply(sides2D);
BENCHMARK(solveWeighted<2, 1>)->Name("Optimal2D/weighted_Poisson")->Apply(sides2D);
BENCHMARK(solveWeighted<2, 2>)->Name("Optimal2D/weighted_Poisson_2_threads")->Apply(sides2D);
BENCHMARK(transformCosts<3, 1>)->Name("Optimal3D/two_cost_transforms")->Apply(sides3D);
BENCHMARK(transformCosts<3, 2>)->Name("Optimal3D/two_cost_transforms_2_threads")->Apply(sides3D);
BENCHMARK(findMinimizers<3>)->Name("Optimal3D/cost_minimizers")->Apply(sides3D);
BENCHMARK(solvePoisson<3, 1>)->Name("Optimal3D/Poisson")->Apply(sides3D);
BENCHMARK(solvePoisson<3, 2>)->Name("Optimal3D/Poisson_2_threads")->Apply(sides3D);
BENCHMARK(solveWeighted<3, 1>)->Name("Optimal3D/weighted_Poisson")->Apply(sides3D);
BENCHMARK(solveWeighted<3, 2>)->Name("Optimal3D/weighted_Poisson_2_threads")->Apply(sides3D);

} // namespace
} // namespace RectifiedTransport

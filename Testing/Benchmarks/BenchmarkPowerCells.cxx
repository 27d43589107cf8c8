// SPDX-License-Identifier: BSD-3-Clause
// The power diagram beside what libraries have for it: Documentation/Alternatives.md draws the
// conclusions.
#include "BenchmarkInputs.h"

#include "Core/Parallel/Progress.h"
#include "Core/PowerCells/PowerDiagram.h"
#include "Core/Seeds/Seeds.h"

#include <cmath>

namespace RectifiedTransport
{
namespace
{

constexpr double domainSide = 512.0;

struct WeightedSites
{
  Particles<2> Sites;
  std::vector<double> Weights;

  // As Newton's method nears a solution, weights change by parts of themselves.
  std::vector<double> PartOfWeights(double part) const
  {
    std::vector<double> weights = this->Weights;
    for (double& weight : weights)
    {
      weight *= part;
    }
    return weights;
  }
};

using MakeSites = WeightedSites (*)(std::int64_t);

// Blue noise without weights.
WeightedSites evenSites(std::int64_t count)
{
  WeightedSites made;
  made.Sites.resize(static_cast<std::size_t>(count));
  made.Weights.resize(made.Sites.size(), 0.0);
  generateSeeds<2>(SeedPattern::BlueNoise, { 1.0, 1.0 }, 1, made.Sites);
  for (Point<2>& site : made.Sites)
  {
    site = { domainSide * site[0], domainSide * site[1] };
  }
  return made;
}

// The weights |x|^2 - 2 p(x) of a convex p move each cell to the gradient of p, as those of an
// equal-mass partition do; here along each axis by up to 8 % of the domain, so that nearly all
// sites lie outside of their cells.
WeightedSites movedCells(std::int64_t count)
{
  const double pi = std::acos(-1.0);
  WeightedSites made = evenSites(count);
  for (std::size_t i = 0; i < made.Sites.size(); ++i)
  {
    for (const double x : made.Sites[i])
    {
      made.Weights[i] -=
        (1.0 - std::cos(2.0 * pi * x / domainSide)) * domainSide * domainSide / (4.0 * pi * pi);
    }
  }
  return made;
}

// All cells meet in the centre of a circle.
WeightedSites circle(std::int64_t count)
{
  const double pi = std::acos(-1.0);
  WeightedSites made;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(count);
    made.Sites.push_back({ 256.0 + 200.0 * std::cos(angle), 256.0 + 200.0 * std::sin(angle) });
  }
  made.Weights.resize(made.Sites.size(), 0.0);
  return made;
}

// From nothing.
template <MakeSites Make>
void makeDiagram(benchmark::State& state)
{
  const WeightedSites made = Make(state.range(0));
  const SerialExecutor executor;
  for (auto _ : state)
  {
    Progress progress(executor);
    PowerDiagram diagram({ domainSide, domainSide });
    diagram.SetSites(made.Sites, progress);
    diagram.Update(made.Weights.data(), progress);
    benchmark::DoNotOptimize(diagram[0].Count);
  }
}

// For weights that differ from the last ones by 1 %.
template <MakeSites Make>
void updateDiagram(benchmark::State& state)
{
  const WeightedSites made = Make(state.range(0));
  const std::vector<double> weights[2] = { made.PartOfWeights(0.99), made.Weights };
  const SerialExecutor executor;
  Progress progress(executor);
  PowerDiagram diagram({ domainSide, domainSide });
  diagram.SetSites(made.Sites, progress);
  diagram.Update(weights[0].data(), progress);
  std::size_t turn = 0;
  for (auto _ : state)
  {
    turn = 1 - turn;
    diagram.Update(weights[turn].data(), progress);
  }
}

void sizes(benchmark::internal::Benchmark* b)
{
  b->Unit(benchmark::kMillisecond)->Arg(8192)->Arg(100000);
}

BENCHMARK(makeDiagram<evenSites>)->Name("Power/even/made")->Apply(sizes);
BENCHMARK(updateDiagram<evenSites>)->Name("Power/even/updated")->Apply(sizes);
BENCHMARK(makeDiagram<movedCells>)->Name("Power/moved/made")->Apply(sizes);
BENCHMARK(updateDiagram<movedCells>)->Name("Power/moved/updated")->Apply(sizes);
BENCHMARK(makeDiagram<circle>)
  ->Name("Power/circle/made")
  ->Unit(benchmark::kMillisecond)
  ->Arg(2000)
  ->Arg(8000);

} // namespace
} // namespace RectifiedTransport

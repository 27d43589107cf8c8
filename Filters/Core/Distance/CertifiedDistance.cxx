// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distance/CertifiedDistance.h"

#include "Core/Parallel/Stages.h"
#include "Core/Plan/TransportPlan.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// One iteration suffices for bounds: every feasible pair of dual potentials bounds the distance
// from below.
OptimalMapOptions optionsOfBounds()
{
  OptimalMapOptions options;
  options.LeastIterations = 1;
  options.MostIterations = 1;
  options.ForBounds = true;
  return options;
}

} // namespace

template <int Dimension>
SquaredBracket bracketDistance(const DensitySource<Dimension>& a, const DensitySource<Dimension>& b,
  const Point<Dimension>& sides, const Context& context)
{
  constexpr double enough = 0.02; // relative to the square: one per cent of the distance
  Progress progress(context);
  Stages stages(progress, { { "lower bound", 40 }, { "upper bound", 60 } });
  PlanOptions options;
  options.HasBound = true;
  options.Optimal = optionsOfBounds();
  const TransportPlan<Dimension> plan(PlanEnd<Dimension>({ a, {}, sides }),
    PlanEnd<Dimension>({ b, {}, sides }), options, stages["lower bound"]);
  SquaredBracket bracket;
  bracket.Lower = plan.LowerBound();
  // If both bounds meet, rounding may exchange them.
  bracket.Upper = std::max(bracket.Lower,
    plan.Certificate()->UpperBound(stages["upper bound"], (1.0 + enough) * bracket.Lower));
  return bracket;
}

template <int Dimension>
double memoryForBracket(const GridSize<Dimension>& cells)
{
  OptimalMapUse use;
  use.UpperBound = true;
  return TransportPlan<Dimension>::MemoryFor(cells, cells, optionsOfBounds(), use);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(bracketDistance);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(memoryForBracket);

} // namespace RectifiedTransport

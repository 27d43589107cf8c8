// SPDX-License-Identifier: BSD-3-Clause
// What all blocks of one advection share, derived from its options.
#ifndef RectifiedTransport_AdvectionJob_h
#define RectifiedTransport_AdvectionJob_h

#include "Core/Flow/FlowOptions.h"
#include "Core/Flow/Kernels/FlowKernels.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

constexpr int refinements = 5; // 2N, 4N ... 32N

inline void check(const FlowOptions& options)
{
  constexpr int maximumSteps = FlowOptions::MaximumNumberOfSteps;
  if (options.NumberOfSteps < 0 || options.NumberOfSteps > maximumSteps)
  {
    throw std::invalid_argument("NumberOfSteps is " + std::to_string(options.NumberOfSteps) +
      ", it must be from 0 to " + std::to_string(maximumSteps));
  }
  if (!(options.AreaTolerance > 0.0 && options.AreaTolerance <= 1.0))
  {
    throw std::invalid_argument("AreaTolerance is " + std::to_string(options.AreaTolerance) +
      ", it must be above 0 and at most 1");
  }
  if (!(options.Tolerance > 0.0) || !std::isfinite(options.Tolerance))
  {
    throw std::invalid_argument("Tolerance is " + std::to_string(options.Tolerance) +
      ", it must be a positive number of cells");
  }
}

// Those that all particles take; 0 with Adaptive.
inline int stepsOf(const FlowOptions& options)
{
  return options.Integrator == Integrator::Adaptive ? 0 : options.NumberOfSteps;
}

enum class AdvectionKind
{
  Forward,
  Backward,
  ForwardToCells // of a density of isolated cells
};

constexpr FlowDirection directionOf(AdvectionKind kind)
{
  return kind == AdvectionKind::Backward ? FlowDirection::Backward : FlowDirection::Forward;
}

// Relative to the domain's longest side. Below it, the estimate of a step's error is only rounding,
// and smaller steps gain no accuracy.
constexpr double finestTolerance = 0x1p-40;

// The least width of a box, in cells of a level, at which that level is used: coarse levels are
// faster and add an error that a larger number of steps does not remove. In 3D they gain less, as
// the sums on the finest level are simpler.
template <int Dimension>
double coarseRatio(const FlowOptions& options, AdvectionKind kind)
{
  constexpr double never = 1e12;
  constexpr double usual = Dimension == 3 ? 32.0 : 16.0;
  const bool adaptive = options.Integrator == Integrator::Adaptive;
  const bool exact = adaptive ? options.Tolerance < 0.003 : options.NumberOfSteps >= 128;
  const bool accurate = kind == AdvectionKind::ForwardToCells ||
    (adaptive ? options.Tolerance < 0.03 : options.NumberOfSteps >= 48);
  return exact ? never : accurate ? 64.0 : usual;
}

// If only isolated cells have mass, nearly all particles miss them with few steps. The first pass
// then takes 2^(this) times as many steps, as they would be redone with.
inline int firstRefinement(const FlowOptions& options, AdvectionKind kind)
{
  if (kind != AdvectionKind::ForwardToCells)
  {
    return 0;
  }
  constexpr int enough = 128;
  int refinement = 0;
  while (options.Integrator != Integrator::Adaptive && refinement < refinements &&
    (options.NumberOfSteps << refinement) < enough)
  {
    ++refinement;
  }
  return refinement;
}

// Kernels of the job stop once the progress is to stop.
template <int Dimension>
void stopWith(FlowJob<Dimension>& job, Progress& progress)
{
  job.ShouldStop = [](void* data) { return static_cast<Progress*>(data)->ShouldStop(); };
  job.ClientData = &progress;
}

template <int Dimension>
class AdvectionJob
{
public:
  // The options are valid and have steps.
  AdvectionJob(const TableView<Dimension>& tables, AdvectionKind kind, const FlowOptions& options)
    : Kind(kind)
    , Refinement(firstRefinement(options, kind))
  {
    this->Job.Tables = tables;
    this->Job.Integrator = options.Integrator;
    this->Job.Backward = kind == AdvectionKind::Backward;
    this->Job.Nearest = options.Lookup == TableLookup::Nearest;
    const double longest = *std::max_element(tables.Size, tables.Size + Dimension);
    this->Job.Tolerance = std::max(options.Tolerance, finestTolerance * longest);
    this->Job.Steps = std::int64_t{ options.NumberOfSteps } << this->Refinement;
    this->Job.CoarseRatio = coarseRatio<Dimension>(options, kind);
    if (options.Integrator == Integrator::Multistep)
    {
      this->Weights = multistepWeightsOf(this->Job.Steps, directionOf(kind));
    }
    this->Job.Weights = this->Weights.empty() ? nullptr : this->Weights.data();
  }
  AdvectionJob(const AdvectionJob&) = delete;
  AdvectionJob& operator=(const AdvectionJob&) = delete;

  // The last pass of unresolved particles; each pass has twice the steps.
  int LastPass() const { return refinements - this->Refinement; }

  FlowJob<Dimension> Job;
  const AdvectionKind Kind;
  const int Refinement; // Steps is NumberOfSteps times two to this power

private:
  std::vector<StepWeights> Weights;
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/TrackedParticles.h"

#include "Bridge/Blend/ParticlePositions.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Temporal/IntervalMap.h"
#include "Bridge/Temporal/StepDensity.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <numeric>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr std::int64_t grain = std::int64_t{ 1 } << 12;

// The mean over all particles of all ranks.
double meanSquare(const StepDensity& step, vtkDoubleArray* from, vtkDoubleArray* to,
  std::int64_t all, Progress& progress)
{
  const LengthScale scale(step.Grid);
  const double* a = from->GetPointer(0);
  const double* b = to->GetPointer(0);
  const auto own = sumExactly<ExactSum>(progress, from->GetNumberOfTuples(), grain,
    [&](std::int64_t first, std::int64_t last, ExactSum& sum) {
      for (std::int64_t i = first; i < last; ++i)
      {
        sum.Add(scale.SquaredDistanceInUnits(a + 3 * i, b + 3 * i));
      }
    });
  return scale.CostFromUnits(
    sumOverRanks(progress.Group(), own).Value() / static_cast<double>(all));
}

template <int D>
vtkSmartPointer<vtkDoubleArray> physicalOf(
  const ImageGrid& grid, ConstPointSpan<D> points, Progress& progress)
{
  auto positions = newArray<vtkDoubleArray>("Positions", 3, points.size());
  writePhysical<D>(grid, points, progress, { positions->GetPointer(0), points.size() });
  return positions;
}

} // namespace

void TrackedParticles::SetSettings(const MovingSettings& settings, int ranks)
{
  if (!(this->Settings == settings) || this->NumberOfRanks != ranks)
  {
    this->Steps.clear();
    this->Checked = 0;
  }
  this->Settings = settings;
  this->NumberOfRanks = ranks;
}

bool TrackedParticles::Extend(
  const StepDensity* before, const StepDensity& density, Progress& progress)
{
  using Self = TrackedParticles;
  this->Text.clear();
  const auto next = static_cast<std::size_t>(this->Checked);
  const bool isKnown = next < this->Steps.size() && this->Steps[next].Density->IsSameAs(density);
  if (onAllRanks(progress.Group(), isKnown))
  {
    ++this->Checked;
    return false;
  }
  this->Steps.resize(next);
  const int dimension = density.Grid.Dimension();
  const std::int64_t particles = before
    ? this->Particles
    : density.Grid.NumberOfCells() * static_cast<std::int64_t>(this->Settings.ParticlesPerCell);
  requireMemory(std::to_string(particles) + " particles (see ParticlesPerCell)",
    160.0 * static_cast<double>(particles) / progress.Group().Count());
  if (before)
  {
    (this->*dispatchDimension(dimension, &Self::Follow<1>, &Self::Follow<2>, &Self::Follow<3>))(
      *before, density, progress);
  }
  else
  {
    (this->*dispatchDimension(dimension, &Self::Begin<1>, &Self::Begin<2>, &Self::Begin<3>))(
      density, progress);
  }
  auto known = std::make_shared<StepDensity>(density);
  known->Values = nullptr;
  this->Steps.back().Density = known;
  ++this->Checked;
  return true;
}

template <int D>
void TrackedParticles::Begin(const StepDensity& density, Progress& progress)
{
  const PivotLattice<D> pivot =
    pivotLattice<D>(density.Grid.Size<D>(), this->Settings.ParticlesPerCell);
  this->Particles = pivot.NumberOfParticles();
  const RankShare share(this->Particles, progress.Group());
  const auto values = density.Density<D>();
  Stages stages(progress, { { "tables", 2 }, { "positions", 8 } });
  const RectifiedFlow<D> flow(values, stages["tables"]);
  LargeBuffer<double> points(share.Count * D);
  transportPivot<D>(
    flow, pivot, share.First, { points.data(), share.Count }, {}, stages["positions"]);
  Step step;
  step.Positions = physicalOf<D>(density.Grid, { points.data(), share.Count }, stages["positions"]);
  this->Steps.push_back(step);
}

template <int D>
void TrackedParticles::Follow(
  const StepDensity& before, const StepDensity& density, Progress& progress)
{
  Stages stages(progress, { { "map", 6 }, { "images", 4 } });
  vtkDoubleArray* from = this->Steps.back().Positions;
  const std::int64_t count = from->GetNumberOfTuples();
  const IntervalMap<D> map(
    before, density, this->Settings.IsOptimal, static_cast<double>(this->Particles), stages["map"]);
  LargeBuffer<double> points(count * D);
  stages["images"].For(count, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      before.Grid.ToIndex<D>(from->GetPointer(3 * i), points.data() + D * i);
      before.Grid.ClampToDomain<D>(points.data() + D * i);
    }
  });
  map.Forward({ points.data(), count }, true, stages["images"]);
  Step step;
  step.Positions = physicalOf<D>(density.Grid, { points.data(), count }, stages["images"]);
  step.Cost = meanSquare(before, from, step.Positions, this->Particles, stages["images"]);
  step.Bound = map.LowerBound();
  this->Text = map.Warning();
  this->Steps.push_back(step);
}

MovingParticles TrackedParticles::Between(int from, int to, const Ranks& ranks) const
{
  const Step& first = this->Steps[static_cast<std::size_t>(from)];
  const Step& second = this->Steps[static_cast<std::size_t>(to)];
  MovingParticles particles;
  particles.From = first.Positions;
  particles.To = second.Positions;
  particles.OfFirst = first.Positions->GetNumberOfTuples();
  particles.Masses = newArray<vtkDoubleArray>("Mass", 1, particles.OfFirst);
  std::fill_n(
    particles.Masses->GetPointer(0), particles.OfFirst, 1.0 / static_cast<double>(this->Particles));
  particles.Numbers.resize(static_cast<std::size_t>(particles.OfFirst));
  std::iota(
    particles.Numbers.begin(), particles.Numbers.end(), RankShare(this->Particles, ranks).First);
  if (from != to)
  {
    particles.Cost = second.Cost;
    particles.Bound = second.Bound;
    particles.HasBound = this->Settings.IsOptimal;
  }
  return particles;
}

} // namespace RectifiedTransport::Bridge

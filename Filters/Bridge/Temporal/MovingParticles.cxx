// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Temporal/MovingParticles.h"

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
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

// The particles of one step, in the cells of its density that have mass.
template <int D>
struct StepParticles
{
  LargeBuffer<double> Points; // in the density's index space
  std::vector<double> Masses;
  std::vector<std::int64_t> Numbers;

  std::int64_t Count() const { return static_cast<std::int64_t>(this->Masses.size()); }
  PointSpan<D> Span() { return { this->Points.data(), this->Count() }; }
};

template <int D>
Point<D> cornerOf(std::int64_t cell, const GridSize<D>& size)
{
  Point<D> corner;
  for (int axis = 0; axis < D; ++axis)
  {
    corner[axis] = static_cast<double>(cell % size[axis]);
    cell /= size[axis];
  }
  return corner;
}

template <int D>
StepParticles<D> placeParticles(
  const StepDensity& step, const PivotLattice<D>& lattice, const Ranks& ranks)
{
  const GridSize<D>& size = lattice.Lattice;
  const auto perCell = static_cast<std::int64_t>(lattice.Places.size());
  const std::int64_t cells = step.Grid.NumberOfCells();
  const RankShare share(cells * perCell, ranks);
  const double* density = step.Values->GetPointer(0);
  const double measure = step.Grid.CellMeasure() / static_cast<double>(perCell);
  StepParticles<D> particles;
  for (std::int64_t n = share.First; n < share.First + share.Count; ++n)
  {
    if (density[n % cells] > 0.0)
    {
      particles.Numbers.push_back(n);
    }
  }
  particles.Masses.resize(particles.Numbers.size());
  particles.Points = LargeBuffer<double>(particles.Count() * D);
  for (std::int64_t i = 0; i < particles.Count(); ++i)
  {
    const std::int64_t n = particles.Numbers[static_cast<std::size_t>(i)];
    const Point<D> corner = cornerOf<D>(n % cells, size);
    const Point<D>& place = lattice.Places[static_cast<std::size_t>(n / cells)];
    particles.Masses[static_cast<std::size_t>(i)] = density[n % cells] * measure;
    for (int axis = 0; axis < D; ++axis)
    {
      particles.Points.data()[i * D + axis] = corner[axis] + place[axis];
    }
  }
  return particles;
}

void requireMemoryFor(
  const StepDensity& from, const StepDensity& to, int perCell, const Ranks& ranks)
{
  const double particles = perCell *
    (static_cast<double>(from.Grid.NumberOfCells()) + static_cast<double>(to.Grid.NumberOfCells()));
  // Positions at both ends and between them, velocities, masses, numbers and vertices.
  constexpr double each = 4.0 * 24.0 + 5.0 * 8.0;
  std::ostringstream purpose;
  purpose.precision(20);
  purpose << particles << " particles (see ParticlesPerCell)";
  requireMemory(purpose.str(), each * particles / ranks.Count());
}

template <int D>
class ParticleMaker
{
public:
  ParticleMaker(const StepDensity& from, const StepDensity& to, const MovingSettings& settings)
    : First(from)
    , Second(to)
    , Settings(settings)
    , FirstLattice(pivotLattice<D>(from.Grid.Size<D>(), settings.ParticlesPerCell))
    , SecondLattice(pivotLattice<D>(to.Grid.Size<D>(), settings.ParticlesPerCell))
  {
  }

  MovingParticles Make(Progress& progress)
  {
    const Ranks& ranks = progress.Group();
    Stages stages(progress, { { "starts", 1 }, { "move", 98 }, { "images", 1 } });
    auto first = placeParticles<D>(this->First, this->FirstLattice, ranks);
    auto second = placeParticles<D>(this->Second, this->SecondLattice, ranks);
    this->Allocate(first, second, ranks);
    this->Write(this->First.Grid, first.Span(), this->Made.From, 0, stages["starts"]);
    this->Write(this->Second.Grid, second.Span(), this->Made.To, first.Count(), stages["starts"]);
    this->Made.Sizes.From = cloudsInCells<D>(this->FirstLattice, first.Count());
    this->Made.Sizes.To = this->Made.Sizes.From;
    const auto ofSecond = cloudsInCells<D>(this->SecondLattice, second.Count());
    if (this->First.Mass > 0.0 && this->Second.Mass > 0.0)
    {
      this->Move(first, second, stages["move"]);
      this->Write(this->Second.Grid, first.Span(), this->Made.To, 0, stages["images"]);
      this->Write(
        this->First.Grid, second.Span(), this->Made.From, first.Count(), stages["images"]);
      this->FindCost(stages["images"]);
      append(cloudsAtImages<D>(this->SecondLattice, this->Second.Grid, this->First.Grid,
               second.Numbers, second.Span(), stages["images"]),
        this->Made.Sizes.From);
      this->Made.Sizes.To = cloudsAtImages<D>(this->FirstLattice, this->First.Grid,
        this->Second.Grid, first.Numbers, first.Span(), stages["images"]);
    }
    else
    {
      append(ofSecond, this->Made.Sizes.From);
      this->Write(this->First.Grid, first.Span(), this->Made.To, 0, stages["images"]);
      this->Write(
        this->Second.Grid, second.Span(), this->Made.From, first.Count(), stages["images"]);
    }
    append(ofSecond, this->Made.Sizes.To);
    return std::move(this->Made);
  }

private:
  static void append(const std::vector<float>& more, std::vector<float>& to)
  {
    to.insert(to.end(), more.begin(), more.end());
  }

  void Allocate(const StepParticles<D>& first, const StepParticles<D>& second, const Ranks& ranks)
  {
    const std::int64_t count = first.Count() + second.Count();
    this->Made.OfFirst = first.Count();
    this->Made.From = newArray<vtkDoubleArray>("From", 3, count);
    this->Made.To = newArray<vtkDoubleArray>("To", 3, count);
    this->Made.Masses = newArray<vtkDoubleArray>("Mass", 1, count);
    std::copy(second.Masses.begin(), second.Masses.end(),
      std::copy(first.Masses.begin(), first.Masses.end(), this->Made.Masses->GetPointer(0)));
    if (ranks.AreSeveral())
    {
      const std::int64_t before =
        this->First.Grid.NumberOfCells() * this->Settings.ParticlesPerCell;
      this->Made.Numbers = first.Numbers;
      for (const std::int64_t number : second.Numbers)
      {
        this->Made.Numbers.push_back(before + number);
      }
    }
  }

  void Write(const ImageGrid& grid, PointSpan<D> points, vtkDoubleArray* to, std::int64_t at,
    Progress& progress)
  {
    writePhysical<D>(grid, points, progress, { to->GetPointer(3 * at), points.size() });
  }

  void Move(StepParticles<D>& first, StepParticles<D>& second, Progress& progress)
  {
    Stages stages(progress, { { "map", 8 }, { "forward", 1 }, { "backward", 1 } });
    const IntervalMap<D> map(
      this->First, this->Second, this->Settings.IsOptimal, 0.0, stages["map"]);
    map.Forward(first.Span(), false, stages["forward"]);
    map.Backward(second.Span(), stages["backward"]);
    this->Made.Bound = map.LowerBound();
    this->Made.HasBound = this->Settings.IsOptimal;
    this->Made.Warning = map.Warning();
  }

  void FindCost(Progress& progress)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 12;
    const LengthScale scale(this->First.Grid);
    const double* from = this->Made.From->GetPointer(0);
    const double* to = this->Made.To->GetPointer(0);
    const double* masses = this->Made.Masses->GetPointer(0);
    const double all = this->First.Mass;
    const auto own = sumExactly<ExactSum>(progress, this->Made.OfFirst, grain,
      [&](std::int64_t first, std::int64_t last, ExactSum& sum) {
        for (std::int64_t i = first; i < last; ++i)
        {
          sum.Add(masses[i] / all * scale.SquaredDistanceInUnits(from + 3 * i, to + 3 * i));
        }
      });
    this->Made.Cost = scale.CostFromUnits(sumOverRanks(progress.Group(), own).Value());
  }

  const StepDensity& First;
  const StepDensity& Second;
  const MovingSettings Settings;
  const PivotLattice<D> FirstLattice;
  const PivotLattice<D> SecondLattice;
  MovingParticles Made;
};

template <int D>
MovingParticles make(const StepDensity& from, const StepDensity& to, const MovingSettings& settings,
  Progress& progress)
{
  return ParticleMaker<D>(from, to, settings).Make(progress);
}

} // namespace

MovingParticles makeParticles(const StepDensity& from, const StepDensity& to,
  const MovingSettings& settings, Progress& progress)
{
  requireMemoryFor(from, to, settings.ParticlesPerCell, progress.Group());
  return dispatchDimension(from.Grid.Dimension(), make<1>, make<2>, make<3>)(
    from, to, settings, progress);
}

} // namespace RectifiedTransport::Bridge

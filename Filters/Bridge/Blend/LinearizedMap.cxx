// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/LinearizedMap.h"

#include "Bridge/Density/FlowCache.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkDoubleArray.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// From index space to physical space, which in 3D have their memory in common.
template <int D>
void toPhysical(const ImageGrid& geometry, const double* positions, std::int64_t count,
  Progress& progress, double* physical)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  progress.For(count, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      double index[D];
      std::copy_n(positions + i * D, D, index);
      geometry.ToPhysical<D>(index, physical + i * 3);
    }
  });
}

} // namespace

bool LinearizedMap::IsOutdated(
  const DensityImage& density, const LinearizedMapSettings& settings) const
{
  return !this->Kept || !(this->Settings == settings) || !this->Stamp.IsOf(density) ||
    !(this->Place == density.Geometry());
}

bool LinearizedMap::IsCandidate(const DensityImage& density) const
{
  return this->Stamp.IsLike(density) && this->Place == density.Geometry();
}

std::int64_t LinearizedMap::Update(DensityImage& density, const LinearizedMapSettings& settings,
  FlowCache& tables, Progress& progress, double end)
{
  if (!this->IsOutdated(density, settings))
  {
    return 0;
  }
  constexpr double partOfFingerprint = 0.01;
  progress.BeginStage(progress.StageEnd() + partOfFingerprint * (end - progress.StageEnd()));
  ContentHash stamp = this->Stamp;
  const bool isSame = stamp.Renew(density, progress) && this->Place == density.Geometry();
  if (isSame && this->Kept && this->Settings == settings)
  {
    this->Stamp = stamp;
    return 0;
  }
  this->Kept = nullptr; // until the particles have arrived
  this->Settings = settings;
  this->Place = density.Geometry();
  const int dimension = density.Geometry().Dimension();
  const std::int64_t moved = dimension == 1 ? this->Move<1>(density, tables, progress, end)
    : dimension == 2                        ? this->Move<2>(density, tables, progress, end)
                                            : this->Move<3>(density, tables, progress, end);
  this->Stamp = stamp;
  return moved;
}

template <int D>
std::int64_t LinearizedMap::Move(
  DensityImage& density, FlowCache& tables, Progress& progress, double end)
{
  constexpr double partOfTables = 0.03;
  constexpr double partOfConversion = 0.02;
  tables.Update(
    density, progress, progress.StageEnd() + partOfTables * (end - progress.StageEnd()));
  const RectifiedFlow<D>& flow = tables.Flow<D>();
  this->Mass = tables.TotalMass();

  GridSize<D> grid;
  std::copy_n(this->Settings.Grid.begin(), D, grid.begin());
  const PivotLattice<D> samples = pivotLattice<D>(grid, this->Settings.PerCell);
  const auto each = static_cast<std::int64_t>(numberOfCells<D>(samples.Lattice));
  const auto places = static_cast<std::int64_t>(samples.Places.size());
  auto physical = newArray<vtkDoubleArray>("Positions", 3, each * places);
  LargeBuffer<double> buffer;
  double* positions = physical->GetPointer(0);
  if constexpr (D != 3)
  {
    const std::int64_t numbers = each * places * D;
    withMemory("the particles", static_cast<double>(numbers) * sizeof(double),
      [&]() { buffer = LargeBuffer<double>(numbers); });
    positions = buffer.data();
  }

  std::int64_t moved = 0;
  const double begin = progress.StageEnd();
  const double flowing = (1.0 - partOfConversion) * (end - begin);
  for (std::int64_t place = 0; place < places; ++place)
  {
    progress.BeginStage(
      begin + flowing * static_cast<double>(place + 1) / static_cast<double>(places));
    moved +=
      flow
        .ForwardLattice(samples.Lattice, { positions + place * each * D, each },
          this->Settings.Options, progress.Stage(), samples.Places[static_cast<std::size_t>(place)])
        .MovedToMass;
  }
  progress.BeginStage(end);
  toPhysical<D>(density.Geometry(), positions, each * places, progress, physical->GetPointer(0));
  this->Kept = physical;
  return moved;
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/LinearizedMap.h"

#include "Bridge/Density/FlowCache.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkDoubleArray.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// From index space to physical space, which in 3D have their memory in common.
template <int D>
void toPhysical(const ImageGeometry& geometry, const double* positions, std::int64_t count,
  const Executor& executor, AlgorithmProgress& host, double* physical)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  host.Run(executor, count, grain, [&](std::int64_t first, std::int64_t last) {
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
  FlowCache& tables, const Executor& executor, AlgorithmProgress& host, double progress)
{
  if (!this->IsOutdated(density, settings))
  {
    return 0;
  }
  constexpr double partOfFingerprint = 0.01;
  host.BeginStage(host.Reached() + partOfFingerprint * (progress - host.Reached()));
  ContentHash stamp = this->Stamp;
  const bool isSame = stamp.Renew(density, executor, host) && this->Place == density.Geometry();
  if (isSame && this->Kept && this->Settings == settings)
  {
    this->Stamp = stamp;
    return 0;
  }
  this->Kept = nullptr; // until the particles have arrived
  this->Settings = settings;
  this->Place = density.Geometry();
  const int dimension = density.Geometry().Dimension();
  const std::int64_t moved = dimension == 1
    ? this->Move<1>(density, tables, executor, host, progress)
    : dimension == 2 ? this->Move<2>(density, tables, executor, host, progress)
                     : this->Move<3>(density, tables, executor, host, progress);
  this->Stamp = stamp;
  return moved;
}

template <int D>
std::int64_t LinearizedMap::Move(DensityImage& density, FlowCache& tables, const Executor& executor,
  AlgorithmProgress& host, double progress)
{
  constexpr double partOfTables = 0.03;
  constexpr double partOfConversion = 0.02;
  tables.Update(
    density, executor, host, host.Reached() + partOfTables * (progress - host.Reached()));
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
  const double begin = host.Reached();
  const double flowing = (1.0 - partOfConversion) * (progress - begin);
  for (std::int64_t place = 0; place < places; ++place)
  {
    host.BeginStage(begin + flowing * static_cast<double>(place + 1) / static_cast<double>(places));
    const FlowReport report =
      flow.ForwardLattice(samples.Lattice, positions + place * each * D, this->Settings.Options,
        executor, host.GetMonitor(), samples.Places[static_cast<std::size_t>(place)]);
    if (report.Cancelled)
    {
      throw Aborted();
    }
    moved += report.MovedToMass;
  }
  host.BeginStage(progress);
  toPhysical<D>(
    density.Geometry(), positions, each * places, executor, host, physical->GetPointer(0));
  this->Kept = physical;
  return moved;
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/LinearizedMap.h"

#include "Bridge/Blend/ParticlePositions.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Density/TableChoice.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include "vtkDoubleArray.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

bool LinearizedMap::IsOf(const InputDensity& density, const LinearizedMapSettings& settings) const
{
  return this->Kept && this->Settings == settings && this->Content.IsOf(density) &&
    this->Geometry == density.Grid();
}

bool LinearizedMap::IsOf(
  const ContentHash& content, const ImageGrid& grid, const LinearizedMapSettings& settings) const
{
  return this->Kept && this->Settings == settings && this->Content == content &&
    this->Geometry == grid;
}

void LinearizedMap::Make(InputDensity& density, const LinearizedMapSettings& settings,
  FlowCache& tables, Progress& progress)
{
  this->Settings = settings;
  this->Geometry = density.Grid();
  const auto move = dispatchDimension(this->Geometry.Dimension(), &LinearizedMap::Move<1>,
    &LinearizedMap::Move<2>, &LinearizedMap::Move<3>);
  (this->*move)(density, tables, progress);
  this->Content = ContentHash(density, progress);
}

template <int D>
void LinearizedMap::Move(InputDensity& density, FlowCache& tables, Progress& progress)
{
  Stages stages(progress, { { "tables", 4 }, { "flow", 94 }, { "positions", 2 } });
  GridSize<D> grid;
  std::copy_n(this->Settings.Grid.begin(), D, grid.begin());
  const PivotLattice<D> pivot = pivotLattice<D>(grid, this->Settings.PerCell);
  const std::int64_t particles = this->Settings.Share.Count;
  const FlowOptions& options = this->Settings.Options;
  const FlowTables kind = chooseTables<D>(this->Settings.Tables, density.Grid().Size<D>(),
    { options, FlowDirection::Forward, static_cast<double>(particles), true, "" });
  const SharedFlow& flow = tables.Update(density, stages["tables"], kind);
  this->Mass = flow.TotalMass();
  auto physical = newArray<vtkDoubleArray>("Positions", 3, particles);
  LargeBuffer<double> buffer;
  double* positions = physical->GetPointer(0);
  if constexpr (D != 3)
  {
    const std::int64_t numbers = particles * D;
    withMemory("the particles", static_cast<double>(numbers) * sizeof(double),
      [&]() { buffer = LargeBuffer<double>(numbers); });
    positions = buffer.data();
  }

  this->Report = transportPivot<D>(flow.Flow<D>(), pivot, this->Settings.Share.First,
    { positions, particles }, options, stages["flow"]);
  writePhysical<D>(this->Geometry, { positions, particles }, stages["positions"],
    { physical->GetPointer(0), particles });
  this->Kept = physical;
}

} // namespace RectifiedTransport::Bridge

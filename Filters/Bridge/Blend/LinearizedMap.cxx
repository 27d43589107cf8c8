// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blend/LinearizedMap.h"

#include "Bridge/Density/FlowCache.h"
#include "Bridge/Density/TableChoice.h"
#include "Bridge/Run/Memory.h"
#include "Core/Flow/PivotLattice.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

template <int D>
std::shared_ptr<const LinearizedMap> make(InputDensity& density,
  const LinearizedMapSettings& settings, FlowCache& tables, Progress& progress)
{
  Stages stages(progress, { { "tables", 4 }, { "flow", 94 }, { "positions", 2 } });
  GridSize<D> grid;
  std::copy_n(settings.Grid.begin(), D, grid.begin());
  const PivotLattice<D> pivot = pivotLattice<D>(grid, settings.PerCell);
  const std::int64_t particles = settings.Share.Count;
  const FlowTables kind = requireTables(chooseTables<D>(settings.Tables, density.Grid().Size<D>(),
    { settings.Options, FlowDirection::Forward, static_cast<double>(particles), true, "" }));
  const SharedFlow& flow = tables.Update(density, stages["tables"], kind);
  auto map = std::make_shared<LinearizedMap>();
  map->TotalMass = flow.TotalMass();
  map->Positions = newArray<vtkDoubleArray>("Positions", 3, particles);
  const PointSpan<3> physical(map->Positions->GetPointer(0), particles);
  LargeBuffer<double> buffer;
  double* positions = physical.data();
  if constexpr (D != 3)
  {
    const std::int64_t numbers = particles * D;
    withMemory({ "the particles", static_cast<double>(numbers) * sizeof(double) },
      [&]() { buffer = LargeBuffer<double>(numbers); });
    positions = buffer.data();
  }
  map->Flow = transportPivot<D>(flow.Flow<D>(), pivot, settings.Share.First,
    { positions, particles }, settings.Options, stages["flow"]);
  writePhysical<D>(density.Grid(), { positions, particles }, stages["positions"], physical);
  return map;
}

} // namespace

DataIdentity identityOfMap(const InputDensity& density, const LinearizedMapSettings& settings)
{
  DataIdentity identity = density.Identity();
  identity.AddGrid(density.Grid()); // not part of the content, but of the physical positions
  for (const std::int64_t number :
    { settings.Grid[0], settings.Grid[1], settings.Grid[2], settings.PerCell, settings.Share.First,
      settings.Share.Count, static_cast<std::int64_t>(settings.Tables) })
  {
    identity.AddNumber(static_cast<std::uint64_t>(number));
  }
  identity.AddOptions(settings.Options);
  return identity;
}

std::shared_ptr<const LinearizedMap> makeLinearizedMap(InputDensity& density,
  const LinearizedMapSettings& settings, FlowCache& tables, Progress& progress)
{
  return dispatchDimension(density.Grid().Dimension(), make<1>, make<2>, make<3>)(
    density, settings, tables, progress);
}

} // namespace RectifiedTransport::Bridge

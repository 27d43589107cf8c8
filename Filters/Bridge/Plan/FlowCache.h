// SPDX-License-Identifier: BSD-3-Clause
// The flow of a density, and what is made for some filters: its optimal map and corrections of
// areas. A filter keeps them until the density changes, and shares them with other filters.
#ifndef RectifiedTransport_FlowCache_h
#define RectifiedTransport_FlowCache_h

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Plan/DensityPlan.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Store/Store.h"
#include "Core/Equalize/AreaCorrection.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Flow/TableChoice.h"
#include "Core/Plan/TransportPlan.h"

#include "vtkTimeStamp.h"

#include <memory>
#include <variant>

namespace RectifiedTransport::Bridge
{

// The flow of a density with its tables. Shared by all filters that read the same density.
class SharedFlow
{
public:
  // Makes tables of this kind, in the memory of `previous` if that has whole ones, which end.
  // Throws Failure, also if the total mass is not positive and finite, and Cancelled.
  template <int D>
  static std::shared_ptr<SharedFlow> Make(InputDensity& density, FlowTables tables,
    std::shared_ptr<SharedFlow> previous, Progress& progress);
  // Its tables, just made.
  template <int D>
  SharedFlow(RectifiedFlow<D> flow, FlowTables tables, const InputDensity& density);

  // What its tables know about the density, and the flow that they define.
  template <int D>
  const RectifiedFlow<D>& Flow() const
  {
    return std::get<RectifiedFlow<D>>(this->Flows);
  }
  template <int D>
  bool HasFlow() const
  {
    return std::holds_alternative<RectifiedFlow<D>>(this->Flows);
  }
  // Density times cell measure, summed.
  double TotalMass() const { return this->Mass; }
  const SuspectValues& Suspect() const { return this->Values; }
  FlowTables Tables() const { return this->Kind; }
  vtkMTimeType BuildTime() const { return this->Built.GetMTime(); }

  // For a flow with tiles: sets the density of the run, which has the same content.
  void Attach(InputDensity& density, Progress& progress);

private:
  std::variant<std::monostate, RectifiedFlow<1>, RectifiedFlow<2>, RectifiedFlow<3>> Flows;
  FlowTables Kind;
  double Mass;
  SuspectValues Values;
  vtkTimeStamp Built;
};

class FlowCache
{
public:
  // Whether Update must compute the content hash and probably builds tables.
  bool IsOutdated(const InputDensity& density) const
  {
    return !this->Tables.Holds(density.Identity());
  }

  // The flow of a density. Tables are built if the content of the density differs from that of the
  // last update and no other filter has them. A flow with tiles is valid only as long as the
  // density lives. If Plan follows, its needs are known before tables are built: these are not, if
  // memory for a map is missing. Throws Failure and Cancelled; the next update then builds.
  const SharedFlow& Update(InputDensity& density, Progress& progress,
    FlowTables tables = FlowTables::Whole, const OptimalNeeds& needs = {});
  // The flow of the last update.
  template <int D>
  std::shared_ptr<const RectifiedFlow<D>> Flow() const
  {
    const auto shared = this->Tables.Cached<const SharedFlow>();
    return { shared, &shared->template Flow<D>() };
  }
  const DataIdentity& Identity() const { return this->Tables.Identity(); }

  // After Update of the same density, with whole tables where the setting needs a map: what moves
  // its points. An optimal map is kept until a setting that needs none, another one or another
  // density. Valid as the flow. Collective. Throws Failure and Cancelled.
  template <int D>
  TransportPlan<D> Plan(const OptimalNeeds& needs, const FlowOptions& options,
    InputDensity& density, Progress& progress);
  // Whether Plan probably solves.
  bool MustSolve(const OptimalSetting& setting) const
  {
    return setting.NeedsMap() && this->Map.IsEmpty();
  }

  // After Update, with whole tables: by what points that a plan takes back have to be corrected for
  // equal areas. Kept until other options, another density or ClearCorrection. Not collective.
  // Throws Failure and Cancelled.
  template <int D>
  std::shared_ptr<const AreaCorrection<D>> Correction(const TransportPlan<D>& plan,
    const OptimalSetting& setting, const FlowOptions& options, Progress& progress);
  void ClearCorrection() { this->Areas.Release(); }
  void ClearMaps()
  {
    this->ClearCorrection();
    this->Map.Release();
  }

  // Releases this filter's references to the tables and what was made for them.
  void Release()
  {
    this->ClearMaps();
    this->Tables.Release();
  }

  // Grows with each build; 0 before the first.
  vtkMTimeType BuildTime() const { return this->Time; }

private:
  template <int D>
  std::shared_ptr<SharedFlow> Build(InputDensity& density, FlowTables tables,
    const OptimalNeeds& needs, std::shared_ptr<SharedFlow> previous, Progress& progress);

  StoreSlot Tables;
  StoreSlot Map;
  StoreSlot Areas;
  vtkMTimeType Time = 0;
};

// The tables that were chosen. Throws Failure if tiles do not fit in memory.
inline FlowTables requireTables(const TableChoice& choice)
{
  if (choice.Tables == FlowTables::Tiled)
  {
    requireMemory(choice.Memory);
  }
  return choice.Tables;
}

} // namespace RectifiedTransport::Bridge

#endif

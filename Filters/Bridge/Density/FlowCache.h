// SPDX-License-Identifier: BSD-3-Clause
// The flow of a density, kept by a filter until the density changes.
#ifndef RectifiedTransport_FlowCache_h
#define RectifiedTransport_FlowCache_h

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Density/DensityTransport.h"
#include "Bridge/Density/SharedFlow.h"
#include "Core/Parallel/Stages.h"

#include <memory>
#include <utility>

namespace RectifiedTransport::Bridge
{

class FlowCache
{
public:
  // Whether Update must compute the content hash and probably builds tables.
  bool IsOutdated(const InputDensity& density) const
  {
    return !this->Kept || !this->Hash.IsOf(density);
  }

  // The flow of a density. Tables are built if the content of the density differs from that of the
  // last update and no other filter has them. A flow with tiles is valid only as long as the
  // density lives. If Transport follows, its needs are known before tables are built: these are
  // not, if memory for a map is missing. Throws Failure and Cancelled; the next update then builds.
  const SharedFlow& Update(InputDensity& density, Progress& progress,
    FlowTables tables = FlowTables::Whole, const OptimalNeeds& needs = {});

  // After Update of the same density, with whole tables where the setting needs a map: what moves
  // its points. An optimal map is kept until a setting that needs none, another one or another
  // density, and shared with other filters. Valid as the flow. Collective. Throws Failure and
  // Cancelled.
  template <int D>
  DensityTransport<D> Transport(
    const OptimalNeeds& needs, InputDensity& density, Progress& progress)
  {
    const OptimalSetting& setting = needs.Setting;
    Stages stages(progress, { { "map", 8 }, { "check", 2 } });
    std::shared_ptr<const OptimalMap<D>> map;
    if (setting.NeedsMap())
    {
      map =
        this->Kept->template Optimal<D>(needs, density, std::move(this->KeptMap), stages["map"]);
    }
    this->KeptMap = map;
    needs.RequireForSamples<D>(density.Grid().Size<D>(), progress.Group());
    return { this->Kept->template Flow<D>(), density.Grid(), setting, map, stages["check"] };
  }
  // Whether Transport probably solves.
  bool MustSolve(const OptimalSetting& setting) const
  {
    return setting.NeedsMap() && !this->KeptMap;
  }

  // After Update, with whole tables: by what points that go back have to be corrected for equal
  // areas. Kept until other options, another density or ForgetCorrection, and shared with other
  // filters. Not collective. Throws Failure and Cancelled.
  template <int D>
  std::shared_ptr<const AreaCorrection<D>> Correction(
    const DensityTransport<D>& transport, const FlowOptions& options, Progress& progress)
  {
    const auto found = this->Kept->template Correction<D>(
      transport, options, std::move(this->KeptCorrection), progress);
    this->KeptCorrection = found;
    return found;
  }
  void ForgetCorrection() { this->KeptCorrection.reset(); }
  void ForgetMaps()
  {
    this->ForgetCorrection();
    this->KeptMap.reset();
  }

  // Releases this filter's references to the tables and what was made for them.
  void Release()
  {
    this->ForgetMaps();
    this->Kept.reset();
  }

  // Grows with each build; 0 before the first.
  vtkMTimeType BuildTime() const { return this->Time; }

private:
  std::shared_ptr<SharedFlow> Kept;
  std::shared_ptr<const void> KeptMap;
  std::shared_ptr<const void> KeptCorrection;
  ContentHash Hash;
  vtkMTimeType Time = 0;
};

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The flow of a density with its tables, and what is made for some filters: its optimal map and
// corrections of areas. Shared by all filters that read the same density.
#ifndef RectifiedTransport_SharedFlow_h
#define RectifiedTransport_SharedFlow_h

#include "Bridge/Density/DensityTransport.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/OptimalMemory.h"
#include "Bridge/Density/WeakPool.h"
#include "Core/Equalize/AreaCorrection.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/OptimalMap/OptimalMap.h"

#include "vtkTimeStamp.h"

#include <memory>
#include <utility>
#include <variant>

namespace RectifiedTransport::Bridge
{

class ContentHash;

class SharedFlow
{
public:
  // With tables of this kind, just made. Throws Failure if its total mass is not positive and
  // finite.
  template <int D>
  SharedFlow(RectifiedFlow<D> flow, FlowTables tables, const InputDensity& density);

  // What its tables know about the density, and the flow that they define.
  template <int D>
  const RectifiedFlow<D>& Flow() const
  {
    return std::get<RectifiedFlow<D>>(this->Kept);
  }
  // The optimal map of the density, solved, in LengthScale's units: one that somebody owns, or a
  // new one, for which `previous` is reset first. The density has the content of this one. Of whole
  // tables; collective. Throws Failure and Cancelled.
  template <int D>
  std::shared_ptr<const OptimalMap<D>> Optimal(const OptimalNeeds& needs, InputDensity& density,
    std::shared_ptr<const void> previous, Progress& progress) const;
  // By what points that a map takes back have to be corrected for equal areas: one that somebody
  // owns, for options that mean the same, or a new one, for which `previous` is reset first. Of
  // whole tables; not collective. Throws Failure and Cancelled.
  template <int D>
  std::shared_ptr<const AreaCorrection<D>> Correction(const DensityTransport<D>& transport,
    const FlowOptions& options, std::shared_ptr<const void> previous, Progress& progress) const;
  // Density times cell measure, summed.
  double TotalMass() const { return this->Mass; }
  const UnusualValues& Unusual() const { return this->Values; }
  FlowTables Tables() const { return this->Kind; }
  vtkMTimeType BuildTime() const { return this->Built.GetMTime(); }

  // Returns the flow that another filter owns for a density of this content, else builds one and
  // shares it. Flows with tiles are not shared because they read the density of one filter's run.
  // Resets `previous` first and reuses its memory if it has no other owner. Builds nothing if there
  // is too little memory for the optimal map besides. Throws Failure and Cancelled.
  template <int D>
  static std::shared_ptr<SharedFlow> FindOrBuild(InputDensity& density, const ContentHash& content,
    FlowTables tables, const OptimalNeeds& needs, std::shared_ptr<SharedFlow> previous,
    Progress& progress);

  // For a flow with tiles: sets the density of the run, which has the same content.
  void Attach(InputDensity& density, Progress& progress);

private:
  using AnyFlow =
    std::variant<std::monostate, RectifiedFlow<1>, RectifiedFlow<2>, RectifiedFlow<3>>;

  AnyFlow Kept;
  mutable WeakPool<OptimalMapKey> Maps;
  // By the flow's options, resolved, and by the optimal map.
  mutable WeakPool<std::pair<FlowOptions, OptimalMapKey>> Corrections;
  FlowTables Kind;
  double Mass;
  UnusualValues Values;
  vtkTimeStamp Built;
};

} // namespace RectifiedTransport::Bridge

#endif

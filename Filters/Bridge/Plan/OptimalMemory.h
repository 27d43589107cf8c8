// SPDX-License-Identifier: BSD-3-Clause
// The memory of an optimal map and of what it is wanted for, to ask for before the work.
#ifndef RectifiedTransport_OptimalMemory_h
#define RectifiedTransport_OptimalMemory_h

#include "Bridge/Run/Memory.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Parallel/Ranks.h"
#include "Core/Plan/TransportPlan.h"

#include <string>

namespace RectifiedTransport::Bridge
{

// What an optimal map is wanted for.
struct OptimalNeeds
{
  OptimalSetting Setting;
  double Samples = 0.0; // that the map moves together, of all ranks

  OptimalMapUse Use(const Ranks& ranks) const
  {
    OptimalMapUse use;
    use.Samples = this->Setting.IsOptimal ? this->Samples : 0.0;
    use.OnSeveralRanks = ranks.AreSeveral();
    return use;
  }
  // For a map that is there. Throws Failure if the memory is not there.
  template <int D>
  void RequireForSamples(const GridSize<D>& target, const Ranks& ranks) const
  {
    requireMemory({ std::string("the exact counts of particles (") + this->Setting.Advice() + ")",
      TransportPlan<D>::MemoryForSamples(target, this->Use(ranks)) });
  }
};

// `densities` are those of the map, for messages.
template <int D>
MemoryPlan memoryOfOptimalMap(const std::string& densities, const GridSize<D>& source,
  const GridSize<D>& target, const OptimalNeeds& needs, const Ranks& ranks)
{
  return { "the optimal map " + densities + " (" + needs.Setting.Advice() + ")",
    TransportPlan<D>::MemoryFor(source, target, OptimalMapOptions(), needs.Use(ranks)) };
}

template <int D>
MemoryPlan memoryOfOptimalMap(const GridSize<D>& source, const GridSize<D>& target,
  const OptimalNeeds& needs, const Ranks& ranks)
{
  return memoryOfOptimalMap<D>("between densities of " + describeSize<D>(source) + " and " +
      describeSize<D>(target) + " cells",
    source, target, needs, ranks);
}

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The flow of a density, kept by a filter until the density changes.
#ifndef RectifiedTransport_FlowCache_h
#define RectifiedTransport_FlowCache_h

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Density/SharedFlow.h"

#include <memory>

namespace RectifiedTransport
{

class FlowCache
{
public:
  // Whether Update must compute the content hash and probably builds tables.
  bool IsOutdated(const InputDensity& density) const
  {
    return !this->Kept || !this->Hash.IsOf(density);
  }

  // The flow of a density; progress then reaches `end`. Tables are built if the content of the
  // density differs from that of the last update and no other filter has them. A flow with tiles is
  // valid only as long as the density lives. Throws Failure and Cancelled; the next update then
  // builds.
  const SharedFlow& Update(
    InputDensity& density, Progress& progress, double end, FlowTables tables = FlowTables::Whole);

  // Releases this filter's reference to the tables.
  void Release() { this->Kept.reset(); }

  // Grows with each build; 0 before the first.
  vtkMTimeType BuildTime() const { return this->Time; }

private:
  std::shared_ptr<SharedFlow> Kept;
  ContentHash Hash;
  vtkMTimeType Time = 0;
};

} // namespace RectifiedTransport

#endif

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
  // Whether Update has to look closer, and most likely builds tables.
  bool IsOutdated(const DensityImage& density) const
  {
    return !this->Kept || !this->Hash.IsOf(density);
  }

  // The flow of a density, as the work of the stages up to the progress `end`: the tables are built
  // if the density is another one, down to its values where only its image is another, and nobody
  // has them. Throws Failure and Cancelled; the next update then builds.
  const SharedFlow& Update(DensityImage& density, Progress& progress, double end);

  // Gives the tables back; the next update needs new ones.
  void Release() { this->Kept.reset(); }

  // Grows with each build; 0 before the first.
  vtkMTimeType BuildTime() const { return this->Time; }

private:
  std::shared_ptr<const SharedFlow> Kept;
  ContentHash Hash;
  vtkMTimeType Time = 0;
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The interface to the values of a density that is distributed over ranks.
#ifndef RectifiedTransport_DistributedDensity_h
#define RectifiedTransport_DistributedDensity_h

#include "../Geometry/GridSize.h"

#include <memory>

namespace RectifiedTransport
{

class DensityValues;

template <int Dimension>
class DistributedDensity
{
public:
  virtual ~DistributedDensity() = default;
  // The values of the grid cells from `low` up to `high`, each under its number in the whole grid.
  // Collective: each rank may want another box, or an empty one. Throws std::bad_alloc.
  virtual std::shared_ptr<const DensityValues> Gather(
    const GridSize<Dimension>& low, const GridSize<Dimension>& high) const = 0;
};

} // namespace RectifiedTransport

#endif

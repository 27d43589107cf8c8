// SPDX-License-Identifier: BSD-3-Clause
// A density whose grid cells lie on several ranks: the interface to its values.
#ifndef RectifiedTransport_SharedDensity_h
#define RectifiedTransport_SharedDensity_h

#include "Density.h"

#include <memory>

namespace RectifiedTransport
{

template <int Dimension>
class SharedDensity
{
public:
  virtual ~SharedDensity() = default;
  // The values of the grid cells from `low` up to `high`, as of a whole density: of pieces of rows
  // by their numbers in the whole grid. Each rank may want another box, or an empty one; all of
  // them call this. Throws std::bad_alloc.
  virtual std::unique_ptr<const DensityValues> Gather(
    const GridSize<Dimension>& low, const GridSize<Dimension>& high) const = 0;
};

} // namespace RectifiedTransport

#endif

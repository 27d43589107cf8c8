// SPDX-License-Identifier: BSD-3-Clause
// The particles of an advection in an order in which neighbours in memory are neighbours in space.
#ifndef RectifiedTransport_ParticleSource_h
#define RectifiedTransport_ParticleSource_h

#include "Core/Flow/FlowArguments.h"
#include "Core/Flow/FlowSeeds.h"
#include "Core/Flow/LatticeOrder.h"
#include "Core/Flow/SortedPoints.h"
#include "Core/Geometry/GridSize.h"

#include <cstdint>

namespace RectifiedTransport
{

// Returns use(source) for the seeds on a box of `size`: source.Prepare(first) makes the chunk that
// begins at particle `first` and returns its length, at most `chunk` points of an array;
// source.Fill reads particles of it. Throws std::invalid_argument, also where there is not memory
// for so many positions.
template <int Dimension, class Use>
auto withSource(const FlowSeeds<Dimension>& seeds, const GridSize<Dimension>& size,
  std::int64_t chunk, std::int64_t positions, const Use& use)
{
  if (seeds.IsLattice())
  {
    return use(checkedOrder<Dimension>(seeds, size, positions));
  }
  checkCount(positions, static_cast<double>(seeds.Points().size()));
  return use(SortedPoints<Dimension>(seeds.Points(), chunk));
}

} // namespace RectifiedTransport

#endif

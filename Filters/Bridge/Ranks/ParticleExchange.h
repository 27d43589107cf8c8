// SPDX-License-Identifier: BSD-3-Clause
// Particles moved to the ranks that have their places.
#ifndef RectifiedTransport_ParticleExchange_h
#define RectifiedTransport_ParticleExchange_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class PlaceOwners;
class Progress;
class Ranks;

// Each particle is a cell of `points` points in a row, whose last one is its place. Afterwards the
// data set has the particles of this rank's places, those of rank 0 first, else in their order, as
// the work of the progress's current stage. Collective. Throws Failure, Cancelled and
// std::bad_alloc.
void moveToOwners(vtkPolyData* particles, std::int64_t points, const PlaceOwners& owners,
  const Ranks& ranks, Progress& progress);

} // namespace RectifiedTransport

#endif

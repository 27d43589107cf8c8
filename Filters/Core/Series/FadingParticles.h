// SPDX-License-Identifier: BSD-3-Clause
// Particles of two steps that fade into each other.
#ifndef RectifiedTransport_FadingParticles_h
#define RectifiedTransport_FadingParticles_h

#include "Core/Series/SeriesParticles.h"

#include <functional>

namespace RectifiedTransport
{

// Moves points of the first step to the second one, and of the second step to the first one, from
// index space to index space. Collective.
template <int D>
using MoveBetween =
  std::function<void(PointSpan<D> first, PointSpan<D> second, Progress& progress)>;

// Particles of the first step begin in its cells, `perCell` in each with the cell's mass, and fade
// linearly. Particles of the second step end in its cells and grow. Both sets represent one moving
// density, which is exactly the step's density at both ends. If a step has no mass, the
// particles of the other one stay where they are. Sets no bound. Collective. Throws std::bad_alloc,
// Cancelled, and what `move` throws.
template <int D>
SeriesParticles makeFadingParticles(const SeriesStep& from, const SeriesStep& to, int perCell,
  const MoveBetween<D>& move, Progress& progress);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The mass of the particles of several ranks on a grid.
#ifndef RectifiedTransport_RankSplat_h
#define RectifiedTransport_RankSplat_h

#include "Core/Splat/Splat.h"

namespace RectifiedTransport
{

class Progress;

// The same as splatMass for the particles of all ranks of the progress, in the order of the ranks
// and then of their particles. Each rank gets the cells of its part `wanted`; parts may be empty
// and may overlap. `keys`, one for each particle, may be nullptr. If all ranks that have particles
// give keys, the terms of a cell are added in the order of the keys (equal keys: by rank, then by
// index). Returns how many particles of all ranks are outside. Memory: about 100 bytes for each
// particle that a rank sends, and as much for each that reaches its part. Collective. Throws
// std::bad_alloc and Cancelled.
template <int Dimension, class Real>
std::int64_t splatOnRanks(const SplatParticles<Dimension, Real>& particles,
  const std::int64_t* keys, const GridSize<Dimension>& size, const LatticePart<Dimension>& wanted,
  const SplatOptions& options, double scale, double* cells, Progress& progress);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Spreads particles evenly within cells where they are found not to be, without moving them to
// other cells.
#ifndef RectifiedTransport_SlabEqualization_h
#define RectifiedTransport_SlabEqualization_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"

namespace RectifiedTransport
{

class Progress;

// A map errs in the same direction in neighbouring cells, which a cell's few particles do not show,
// but those of a slab do: one cell thick along an axis, and 8 cells along the others. Axis by axis,
// the numbers of particles in the halves of the thickness are compared, then in the halves of
// these, down to 32 parts. Of each level, the part of the differences that chance explains stays
// (Stein's shrinkage), the rest is removed by a monotone map of the places along the thickness.
// Particles that are independent samples hardly move.
//
// Particles are in index space, in the box. The same bits for every number of threads and every
// order of the particles. Adds 2 * Dimension units of work a particle. Takes at most about 32 bytes
// a particle or 8 MB, on several threads up to twice that. Not collective. Throws std::bad_alloc
// and Cancelled.
template <int Dimension>
void equalizeInSlabs(
  const GridSize<Dimension>& size, PointSpan<Dimension> particles, Progress& progress);

// Bytes that it takes at most, about.
template <int Dimension>
double memoryForSlabEqualization(const GridSize<Dimension>& size, std::int64_t particles);

} // namespace RectifiedTransport

#endif

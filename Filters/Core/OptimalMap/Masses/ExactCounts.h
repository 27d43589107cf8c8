// SPDX-License-Identifier: BSD-3-Clause
// Moves particles of equal masses until as many as possible are in each of the boxes that halve a
// density's grid, down to its cells.
#ifndef RectifiedTransport_ExactCounts_h
#define RectifiedTransport_ExactCounts_h

#include "Core/OptimalMap/Masses/CellDensity.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// From the whole grid down, boxes are halved at whole cells across their longest side, the first
// one of equal sides; of an odd number of cells, the lower half has one more. Of n particles in a
// box, floor or ceil of n times its share are wanted in a half, and none where nothing is. Those
// beyond that go to their mirror image on the other side of the plane, the nearest ones first, or
// to the nearest cell with mass there; of equally near ones, those with lower numbers. Boxes of
// fewer than 5 particles are not halved; from empty cells in them, particles go to the nearest one
// with mass. `sides` are those of a cell, in lengths.
//
// Particles are in the density's index space, in its box. The same bits for every number of
// threads, but another order of the particles may give others. Adds a unit of work a particle.
// Memory: memoryForExactCounts. Returns how many moves it made. Not collective. Throws
// std::bad_alloc and Cancelled.
template <int Dimension>
std::int64_t makeCountsExact(const CellDensity<Dimension>& density, const Point<Dimension>& sides,
  PointSpan<Dimension> particles, Progress& progress);

// Bytes that it takes at most, about.
template <int Dimension>
double memoryForExactCounts(const GridSize<Dimension>& size, std::int64_t particles);

} // namespace RectifiedTransport

#endif

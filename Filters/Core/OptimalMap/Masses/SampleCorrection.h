// SPDX-License-Identifier: BSD-3-Clause
// The last moves of samples that a map has taken to a density: boxes of cells get their shares of
// them.
#ifndef RectifiedTransport_SampleCorrection_h
#define RectifiedTransport_SampleCorrection_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"
#include "Core/OptimalMap/Masses/CellDensity.h"

namespace RectifiedTransport
{

class Progress;

// Spreads particles evenly within cells where they are found not to be, without moving them to
// other cells.
//
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

// Masses of the nodes, if there are samples enough, then exact counts in boxes, then even places
// in cells. Samples are in the index space of the density, whose cells have the sides `sides`. The
// samples of all ranks are moved together. The same bits for every number of threads and ranks.
// Takes the progress to its end. Collective. Throws std::bad_alloc and Cancelled.
template <int Dimension>
void correctSamples(const CellDensity<Dimension>& density, const Point<Dimension>& sides,
  PointSpan<Dimension> samples, Progress& progress);

// Bytes that it takes at most, about, for so many samples of all ranks.
template <int Dimension>
double memoryForCorrection(const GridSize<Dimension>& size, double samples, bool onSeveralRanks);

} // namespace RectifiedTransport

#endif

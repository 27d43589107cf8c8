// SPDX-License-Identifier: BSD-3-Clause
// The last moves of samples that a map has taken to a density: boxes of cells get their shares of
// them.
#ifndef RectifiedTransport_SampleCorrection_h
#define RectifiedTransport_SampleCorrection_h

#include "Core/OptimalMap/Masses/CellDensity.h"

namespace RectifiedTransport
{

class Progress;

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

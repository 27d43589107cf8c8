// SPDX-License-Identifier: BSD-3-Clause
// Blue noise: points that keep their distance from one another without order or direction.
#ifndef RectifiedTransport_BlueNoise_h
#define RectifiedTransport_BlueNoise_h

#include "Core/Geometry/Points.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Exactly `count` points in the unit box, evenly spaced in a box of sides `lengths`; O(count) time,
// O(sqrt(count)) memory in 2D. Arguments are those of generateSeeds, already checked. Adds about
// 2 * count to the progress. Throws Cancelled.
//
// 2D and 3D: a relaxed toroidal tile is repeated over space, and a window of the box's shape grows
// from a corner until it holds `count` points. The window is turned against the tile by a fixed
// angle of badly approximable slope, so that even a thin strip sweeps the whole tile and no period
// shows. The random seed chooses the corner and one of the tile's 8 or 48 symmetries. A box less
// than about one point thick takes the pattern of one dimension less, and an additive recurrence
// across.
// 1D: one point in each of `count` equal intervals, jittered over half of it: spacings are between
// 0.5 and 1.5 of the mean.
template <int Dimension>
void generateBlueNoise(const Point<Dimension>& lengths, std::int64_t count,
  std::uint64_t randomSeed, double* unitPoints, Progress& progress);

} // namespace RectifiedTransport

#endif

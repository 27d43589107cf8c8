// SPDX-License-Identifier: BSD-3-Clause
// Blue-noise point sets (paper, Section 5.1): even spacing without order or preferred directions.
#ifndef RectifiedTransport_BlueNoise_h
#define RectifiedTransport_BlueNoise_h

#include "Core/Geometry/Points.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// Fills unitPoints with points of the unit box that are evenly spaced in a box of sides `lengths`:
// the points from number `first` on, out of `count`. Takes O(count) time even for a part, except in
// 1D, and O(sqrt(count)) memory in 2D. The arguments are those of generateSeeds, already checked.
// Adds about 3 * count to the progress in 2D, otherwise 2 * count. Throws Cancelled.
//
// 2D and 3D: a relaxed toroidal tile is repeated periodically. The points are those of a window of
// the box's shape at a corner, of the size that holds `count`. The window is rotated against the
// tile by a fixed angle of badly approximable slope, so that even a thin strip samples the whole
// tile and no period is visible. The random seed chooses the corner and one of the tile's 8 or 48
// symmetries. A box less than about one mean spacing thick gets the pattern of one dimension less,
// and an additive recurrence across.
// 2D: the points within a mean spacing of the faces then move towards the centroids of their
// Voronoi cells (WindowBorder.h). The cut through the pattern increases the mean squared distance
// to the nearest point by 0.14 / sqrt(count) times area / number in a square; the motion reduces
// the 0.14 to 0.07. Points at a face then tend to stand in rows along it, and layers of whole rows
// have their share of the points. The cells of the first row are about 2 % smaller than the mean,
// and the second row's are as much larger. In 3D the window stays as it is cut.
// 1D: one point in each of `count` equal intervals, jittered over half of it: spacings are between
// 0.5 and 1.5 of the mean.
template <int Dimension>
void generateBlueNoise(const Point<Dimension>& lengths, std::int64_t count,
  std::uint64_t randomSeed, std::int64_t first, PointSpan<Dimension> unitPoints,
  Progress& progress);

} // namespace RectifiedTransport

#endif

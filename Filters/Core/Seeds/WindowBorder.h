// SPDX-License-Identifier: BSD-3-Clause
// The border of a rectangle that was cut out of an even pattern of the plane. The cut leaves seeds
// too close to a face or too far from it.
#ifndef RectifiedTransport_WindowBorder_h
#define RectifiedTransport_WindowBorder_h

#include "Core/Geometry/Points.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// The band of the seeds that move or bound the cells of those that move, for `count` seeds.
class BorderBand
{
public:
  BorderBand(const Point<2>& lengths, std::int64_t count);
  bool Holds(const double* unitPoint) const
  {
    return unitPoint[0] < this->Low[0] || unitPoint[0] > this->High[0] ||
      unitPoint[1] < this->Low[1] || unitPoint[1] > this->High[1];
  }

private:
  Point<2> Low;
  Point<2> High;
};

struct BorderSeed
{
  std::int64_t Number;
  Point<2> UnitPoint;
};

// Moves the seeds within a mean spacing of the faces of a rectangle of sides `lengths` towards the
// centroids of their Voronoi cells (Lloyd's method, over-relaxed). The other seeds and the order
// stay. This lowers the mean squared distance of the rectangle to the nearest seed. No two seeds
// come nearer to each other than 0.86 of the spacing of the hexagonal lattice, or than they were if
// that is less. Seeds are moved one after the other on the calling thread.
//
// `border` has all seeds of the band, by their numbers; unitPoints are the seeds from number
// `first` on, out of `count`. There is at least one seed, and no two coincide. Seeds that move
// should have their neighbours within two mean spacings, as in any even pattern: seeds farther
// inside are ignored. Takes O(sqrt(count)) memory and time; O(count) in strips, where all are at
// the border. Adds the number of seeds and of moved seeds to the progress. Throws Cancelled.
void relaxBorder(const Point<2>& lengths, std::int64_t count, const std::vector<BorderSeed>& border,
  std::int64_t first, PointSpan<2> unitPoints, Progress& progress);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The border of a rectangle that was cut out of an even pattern of the plane: the pattern does not
// know of the cut, which leaves seeds close to a face or too far from it.
#ifndef RectifiedTransport_WindowBorder_h
#define RectifiedTransport_WindowBorder_h

#include "Core/Geometry/Points.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Moves the seeds within a mean spacing of the faces of a rectangle of sides `lengths` towards
// the centroids of their Voronoi cells (Lloyd's method, over-relaxed); the others stay, and so does
// the order. The mean squared distance of the rectangle from the nearest seed falls, and no two
// seeds come nearer to each other than 0.86 of the spacing of the hexagonal lattice, or than they
// are if that is less. Seeds are moved one after the other on the thread that calls.
//
// There is at least one seed, and no two are in one place. Seeds that move should have their
// neighbours within two mean spacings, as in any even pattern: those that are farther inside are
// not regarded. Takes O(sqrt(count)) memory, and as much time after a pass over all seeds; O(count)
// in strips, where all are at the border. Adds to the progress the number of seeds, and that of
// those that move. Throws Cancelled.
void relaxBorder(const Point<2>& lengths, PointSpan<2> unitPoints, Progress& progress);

// Where the seeds are that move or bound the cells of those that do, of `count` seeds.
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

// Of `count` seeds, moves those from number `first` on that unitPoints has, with the same bits;
// `border` are all seeds of the band, by their numbers.
void relaxBorder(const Point<2>& lengths, std::int64_t count, const std::vector<BorderSeed>& border,
  std::int64_t first, PointSpan<2> unitPoints, Progress& progress);

} // namespace RectifiedTransport

#endif

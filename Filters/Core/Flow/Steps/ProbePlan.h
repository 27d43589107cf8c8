// SPDX-License-Identifier: BSD-3-Clause
// Which blocks of cells show the error of a flow, and how many of them are looked at.
#ifndef RectifiedTransport_ProbePlan_h
#define RectifiedTransport_ProbePlan_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/Points.h"

#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
struct ProbePlan
{
  // Of a map, forward or backward: blocks of 4 cells along each axis, all that lie side by side, or
  // some where those are too many.
  explicit ProbePlan(const GridSize<Dimension>& size);
  // Of so many particles that go forward: blocks in which they show an error of the tolerance. None
  // if there are fewer than two, or so few particles that looking would take longer than they do.
  ProbePlan(const GridSize<Dimension>& size, double particles, double tolerance);

  GridSize<Dimension> Side; // of a block, in cells
  int Parts = 1;            // of its sides, along an edge, between the points that are moved
  std::int64_t Blocks = 0;  // a multiple of SymmetricPlace's Images, but of those side by side
  GridSize<Dimension> SideBySide{}; // how many lie so along each axis; 0: blocks are spread

  // At most so many, spread.
  void Spread(std::int64_t most);
  // The lowest corner of one of those side by side. They lie as those of mirror images do: where
  // they do not fit, those of the upper half overlap with those of the lower.
  Point<Dimension> LowestOf(std::int64_t number, const GridSize<Dimension>& size) const;

private:
  double BlocksOf(const GridSize<Dimension>& size) const;
  void Take(double blocks);
};

// So many particles of blue noise in a block differ from the density by about a part of this many:
// the count varies by k^(1/4), so the part is k^(-3/4).
double particlesThatShow(double part);

} // namespace RectifiedTransport

#endif

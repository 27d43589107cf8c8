// SPDX-License-Identifier: BSD-3-Clause
// A coupling of the cells of two densities along a map, whose masses are not yet those of the
// target.
#ifndef RectifiedTransport_ImageShares_h
#define RectifiedTransport_ImageShares_h

#include "Core/Geometry/LatticePart.h"
#include "Core/OptimalMap/Masses/CellDensity.h"
#include "Core/OptimalMap/Nodes/IntegerSums.h"
#include "Core/OptimalMap/Nodes/NodeMap.h"

#include <cstdint>

namespace RectifiedTransport
{

class Progress;

// What the cells of the target got from the source, as in IntegerSums.h.
template <int Dimension>
struct CellShares
{
  const std::int64_t* Got(std::int64_t cell) const { return this->Sums.data() + cell * this->Each; }
  // How much mass a cell got beyond its share; negative if it lacks some.
  std::int64_t ResidualOf(std::int64_t cell, const CellDensity<Dimension>& target) const
  {
    return this->Got(cell)[0] - toInteger(target.Share(cell) * integerUnit);
  }
  GridSize<Dimension> PlaceOf(std::int64_t cell) const
  {
    return LatticePart<Dimension>::WholeOf(this->Size).CellOf(cell);
  }

  GridSize<Dimension> Size;
  Point<Dimension> Sides{};     // sides of a cell, in lengths
  double SquaredDiagonal = 0.0; // squared diagonal of the box
  LargeBuffer<std::int64_t> Sums;
  int Each = 1; // sums a cell: the mass, with costs also its first moments, with ways from
                // the source in parts of the whole grid
  // The cost of all ways, rounded up, and the part of it that arises as images are split between
  // cells, both in squared diagonals over integerUnit.
  std::int64_t Cost = 0;
  std::int64_t CostOfSpread = 0;
};

// The images of the parts of the source's cells (ImageSamples) go to the cells with mass about
// them. The map is given at the corners of cells, in cells. Both densities have the size of its
// grid. The same bits for every number of threads. Throws std::bad_alloc and Cancelled.
template <int Dimension>
CellShares<Dimension> shareImages(const CellDensity<Dimension>& source,
  const CellDensity<Dimension>& target, const NodeMap<Dimension>& corners, bool withCosts,
  Progress& progress);

} // namespace RectifiedTransport

#endif

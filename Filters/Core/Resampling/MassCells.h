// SPDX-License-Identifier: BSD-3-Clause
// Which cells of data sets carry mass: those of the highest dimension. In data sets of lines,
// closed lines around regions of a plane.
#ifndef RectifiedTransport_MassCells_h
#define RectifiedTransport_MassCells_h

#include "Core/Resampling/CellSet.h"

namespace RectifiedTransport
{

class Progress;

struct MassCells
{
  int Dimension = 0;           // dimension of the domain
  bool AreClosedLines = false; // lines are around regions of a plane

  // Whether a cell has the dimension; other cells carry no mass.
  bool HasDimension(const CellReader& reader, std::int64_t cell) const;
  // The points of a cell that carries mass; nullptr for another one.
  const CellReader::Ids* Find(CellReader& reader, std::int64_t cell) const;
};

// For cells of at most this dimension. Lines are around regions if a closed one is not on a
// straight line. Throws Cancelled.
MassCells massCells(const CellSets& sets, int dimension, Progress& progress);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The pieces of an image that ranks have.
#ifndef RectifiedTransport_ImagePiece_h
#define RectifiedTransport_ImagePiece_h

#include "Core/Geometry/Distributed/TupleBoxes.h"

#include <array>
#include <string>
#include <vector>

namespace RectifiedTransport
{

struct ImagePiece
{
  Extent Points = emptyExtent;
  Extent Cells = emptyExtent;
  std::array<double, 15> Geometry{}; // origin, spacing, direction
};

// The smallest box of tuples of a box whose flags have none of a mask.
TupleBox boxWithout(const TupleBox& all, const unsigned char* flags, unsigned char mask);

struct JoinedPieces
{
  std::vector<Extent> Points; // extents of the points, by pieces
  std::vector<Extent> Cells;  // the same for cells
  Extent Whole = emptyExtent; // empty if no piece has points
  std::array<double, 15> Geometry{};
  // Why the pieces are no parts of one image, or do not fill it; empty if they do.
  std::string Fault;
};
// Joins the pieces of all ranks, which are in the order of ranks.
JoinedPieces joinPieces(const std::vector<ImagePiece>& pieces);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/ImagePiece.h"

#include <algorithm>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

// With 17 digits, different doubles have different texts.
std::string describe(const double* numbers, std::size_t count)
{
  std::ostringstream os;
  os.precision(17);
  for (std::size_t i = 0; i < count; ++i)
  {
    os << (i == 0 ? "" : " ") << numbers[i];
  }
  return os.str();
}

// How the geometries of two ranks differ; empty if they do not.
std::string differenceOf(
  const ImagePiece& one, std::size_t rankOfOne, const ImagePiece& other, std::size_t rankOfOther)
{
  constexpr std::array<const char*, 3> names = { "origin", "spacing", "direction matrix" };
  // The geometry is origin (3 numbers), spacing (3) and direction matrix (9, row by row).
  constexpr std::array<std::size_t, 4> starts = { 0, 3, 6, 15 };
  for (std::size_t part = 0; part < names.size(); ++part)
  {
    const std::size_t count = starts[part + 1] - starts[part];
    const double* first = one.Geometry.data() + starts[part];
    const double* second = other.Geometry.data() + starts[part];
    if (!std::equal(first, first + count, second))
    {
      return "The images of the ranks are not parts of one: the " + std::string(names[part]) +
        " is " + describe(first, count) + " on rank " + std::to_string(rankOfOne) + ", but " +
        describe(second, count) + " on rank " + std::to_string(rankOfOther);
    }
  }
  return {};
}

// Which points or cells of the whole image no piece has, as a message; empty if there are none.
// What pieces cover is subtracted from the whole box, box by box.
std::string missingTuples(const std::vector<ImagePiece>& pieces, const Extent& whole, int owner)
{
  std::vector<TupleBox> missing = { tuplesOf(whole, owner, whole) };
  for (const ImagePiece& piece : pieces)
  {
    const Extent& extent = owner == OfPoints ? piece.Points : piece.Cells;
    if (!isEmpty(extent))
    {
      subtract(tuplesOf(extent, owner, whole), missing);
    }
  }
  return missing.empty() || missing.front().IsEmpty()
    ? std::string()
    : "The images of the ranks do not fill their common extent: none has the " +
      std::string(owner == OfPoints ? "points " : "cells ") + describe(missing.front());
}

} // namespace

// Row by row: the first and the last tuple of a row that are no ghosts.
TupleBox boxWithout(const TupleBox& all, const unsigned char* flags, unsigned char mask)
{
  TupleBox own{};
  const auto isOwn = [mask](unsigned char flag) { return (flag & mask) == 0; };
  for (std::int64_t first = 0; first < all.Count(); first += all.Cells[0])
  {
    const unsigned char* row = flags + first;
    const unsigned char* end = row + all.Cells[0];
    const unsigned char* low = std::find_if(row, end, isOwn);
    const unsigned char* high = end;
    while (high != low && !isOwn(high[-1]))
    {
      --high;
    }
    if (low != end)
    {
      own = own.With({ all.CellOf(first + (low - row)), { high - low, 1, 1 } });
    }
  }
  return own;
}

// The geometry is that of the first rank with points, bit by bit; the whole is the union of
// extents.
JoinedPieces joinPieces(const std::vector<ImagePiece>& pieces)
{
  JoinedPieces joined;
  std::size_t first = pieces.size(); // rank with points
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const ImagePiece& piece = pieces[rank];
    joined.Points.push_back(piece.Points);
    joined.Cells.push_back(piece.Cells);
    if (isEmpty(piece.Points))
    {
      continue;
    }
    if (first == pieces.size())
    {
      first = rank;
      joined.Whole = piece.Points;
      joined.Geometry = piece.Geometry;
    }
    // Every piece must have the geometry of the first one, bit by bit.
    joined.Fault = differenceOf(pieces[first], first, piece, rank);
    if (!joined.Fault.empty())
    {
      return joined;
    }
    for (std::size_t end = 0; end < 6; end += 2)
    {
      joined.Whole[end] = std::min(joined.Whole[end], piece.Points[end]);
      joined.Whole[end + 1] = std::max(joined.Whole[end + 1], piece.Points[end + 1]);
    }
  }
  for (const int owner : { OfPoints, OfCells })
  {
    if (first < pieces.size() && joined.Fault.empty())
    {
      joined.Fault = missingTuples(pieces, joined.Whole, owner);
    }
  }
  return joined;
}

} // namespace RectifiedTransport

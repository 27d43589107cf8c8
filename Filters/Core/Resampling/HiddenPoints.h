// SPDX-License-Identifier: BSD-3-Clause
// The cells of an image whose points are hidden.
#ifndef RectifiedTransport_HiddenPoints_h
#define RectifiedTransport_HiddenPoints_h

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

struct BlankingFlags
{
  unsigned char HiddenPoint;
  unsigned char BlankCell;
};

// Writes the flags of the cells in some rows of an image along its first axis: BlankCell if a point
// of the cell has the flag HiddenPoint, else the cell's own flags, 0 if `cells` is nullptr.
// `dimensions` are numbers of points; 1 is no axis.
void blankCellsOfHiddenPoints(const std::array<int, 3>& dimensions, const unsigned char* points,
  const unsigned char* cells, std::int64_t firstRow, std::int64_t lastRow, unsigned char* flags,
  BlankingFlags values);

} // namespace RectifiedTransport

#endif

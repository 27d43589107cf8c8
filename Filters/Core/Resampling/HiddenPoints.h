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

// Writes the flags of an image's cells in some rows along its first axis. A cell has BlankCell if
// one of its points has HiddenPoint, else its own flags, 0 if `cells` is nullptr. `dimensions` are
// numbers of points; 1 is no axis.
void blankCellsOfHiddenPoints(const std::array<int, 3>& dimensions, const unsigned char* points,
  const unsigned char* cells, std::int64_t firstRow, std::int64_t lastRow, unsigned char* flags,
  BlankingFlags values);

} // namespace RectifiedTransport

#endif

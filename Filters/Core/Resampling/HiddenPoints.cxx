// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/HiddenPoints.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

void blankCellsOfHiddenPoints(const std::array<int, 3>& dimensions, const unsigned char* points,
  const unsigned char* cells, std::int64_t firstRow, std::int64_t lastRow, unsigned char* flags,
  BlankingFlags values)
{
  const std::int64_t columns = std::max(1, dimensions[0] - 1);
  const std::int64_t rows = std::max(1, dimensions[1] - 1);
  const std::int64_t rowStep = dimensions[0];
  const std::int64_t planeStep = rowStep * dimensions[1];
  // From the first point of a cell to each of its points.
  std::array<std::int64_t, 8> corners{};
  std::size_t count = 1;
  const std::array<std::int64_t, 3> steps = { 1, rowStep, planeStep };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = 0; dimensions[axis] > 1 && i < count; ++i)
    {
      corners[count + i] = corners[i] + steps[axis];
    }
    count *= dimensions[axis] > 1 ? 2 : 1;
  }
  for (std::int64_t row = firstRow; row < lastRow; ++row)
  {
    // Rows of cells are numbered along axis 1, then axis 2.
    const unsigned char* first = points + row % rows * rowStep + row / rows * planeStep;
    for (std::int64_t i = 0; i < columns; ++i)
    {
      unsigned char any = 0;
      for (std::size_t corner = 0; corner < count; ++corner)
      {
        // The union of the points' flags.
        any |= first[i + corners[corner]];
      }
      const std::int64_t cell = row * columns + i;
      const unsigned char own = cells ? cells[cell] : 0;
      flags[cell] = (any & values.HiddenPoint) != 0 ? values.BlankCell : own;
    }
  }
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Reading/PaddedValues.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

PaddedValues::PaddedValues(std::shared_ptr<const DensityValues> inner, const LatticePart<3>& box,
  const GridSize<3>& padded, double empty)
  : Inner(std::move(inner))
  , Box(box)
  , Whole(LatticePart<3>::WholeOf(padded))
  , Empty(empty)
{
}

void PaddedValues::Read(std::int64_t first, std::int64_t count, double* values) const
{
  const std::int64_t end = first + count;
  while (first < end)
  {
    // One row of the larger grid at a time, or the piece of it that was asked for: the cells below
    // the box, those in it (read from `Inner`), and those above it.
    GridSize<3> cell = this->Whole.CellOf(first);
    const std::int64_t last = std::min(end, first + this->Whole.Cells[0] - cell[0]);
    const std::int64_t offset = cell[0] - first; // from numbers to the first axis
    std::int64_t low = std::clamp(this->Box.Low[0] - offset, first, last);
    std::int64_t high = std::clamp(this->Box.End(0) - offset, low, last);
    cell[0] = low + offset;
    if (low == high || !this->Box.Contains(cell))
    {
      low = high = last;
    }
    double* row = values - first;
    std::fill(row + first, row + low, this->Empty);
    if (low < high)
    {
      this->Inner->Read(this->Box.NumberOf(cell), high - low, row + low);
    }
    std::fill(row + high, row + last, this->Empty);
    values += last - first;
    first = last;
  }
}

} // namespace RectifiedTransport

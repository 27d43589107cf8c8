// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Distributed/TupleBoxes.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace RectifiedTransport
{

Extent intersectionOf(const Extent& a, const Extent& b)
{
  Extent both = a;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::max(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::min(a[2 * axis + 1], b[2 * axis + 1]);
  }
  // Of one whose ends are reversed otherwise VTK counts points and cells that there are not.
  return isEmpty(both) ? emptyExtent : both;
}

TupleBox tuplesOf(const Extent& extent, int owner, const Extent& whole)
{
  TupleBox box{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool hasCells = owner == OfCells && whole[2 * axis] < whole[2 * axis + 1];
    box.Low[axis] = extent[2 * axis];
    box.Cells[axis] = std::max(0, extent[2 * axis + 1] - extent[2 * axis] + (hasCells ? 0 : 1));
  }
  return box;
}

Extent extentOf(const TupleBox& box, int owner, const Extent& whole)
{
  Extent extent = emptyExtent;
  for (std::size_t axis = 0; axis < 3 && !box.IsEmpty(); ++axis)
  {
    const bool hasCells = owner == OfCells && whole[2 * axis] < whole[2 * axis + 1];
    extent[2 * axis] = static_cast<int>(box.Low[axis]);
    extent[2 * axis + 1] = static_cast<int>(box.End(static_cast<int>(axis))) - (hasCells ? 0 : 1);
  }
  return extent;
}

void subtract(const TupleBox& box, std::vector<TupleBox>& from)
{
  std::vector<TupleBox> left;
  for (TupleBox rest : from)
  {
    if (rest.And(box).IsEmpty())
    {
      left.push_back(rest);
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const TupleBox common = rest.And(box);
      TupleBox below = rest;
      below.Cells[axis] = common.Low[axis] - rest.Low[axis];
      TupleBox above = rest;
      above.Low[axis] = common.End(axis);
      above.Cells[axis] = rest.End(axis) - common.End(axis);
      for (const TupleBox& side : { below, above })
      {
        if (!side.IsEmpty())
        {
          left.push_back(side);
        }
      }
      rest.Low[axis] = common.Low[axis];
      rest.Cells[axis] = common.Cells[axis];
    }
  }
  from = std::move(left);
}

std::string describe(const TupleBox& box)
{
  std::ostringstream os;
  for (int axis = 0; axis < 3; ++axis)
  {
    os << (axis == 0 ? "" : " x ") << "[" << box.Low[axis] << ", " << box.End(axis) - 1 << "]";
  }
  return os.str();
}

} // namespace RectifiedTransport

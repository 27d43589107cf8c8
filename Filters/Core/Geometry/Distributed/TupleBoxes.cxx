// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Geometry/Distributed/TupleBoxes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
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
  // VTK counts points and cells in extents whose ends are reversed in another way.
  return isEmpty(both) ? emptyExtent : both;
}

// One layer of points has no cells along its axis; with one more layer of the whole, it has.
Extent withCells(const Extent& extent, const Extent& whole)
{
  Extent grown = extent;
  for (std::size_t low = 0; low < grown.size() && !isEmpty(extent); low += 2)
  {
    if (extent[low] == extent[low + 1] && whole[low] < whole[low + 1])
    {
      grown[low] -= extent[low + 1] == whole[low + 1] ? 1 : 0;
      grown[low + 1] = grown[low] + 1;
    }
  }
  return grown;
}

std::string textOfExtent(const int* extent)
{
  std::string text;
  for (int i = 0; i < 6; ++i)
  {
    text += (i == 0 ? "" : " ") + std::to_string(extent[i]);
  }
  return text;
}

bool isReadable(const int* extent)
{
  bool is = true;
  for (std::size_t a = 0; a < 6; a += 2)
  {
    // In 64 bits: the difference of two ints may not be an int.
    const std::int64_t points = std::int64_t{ extent[a + 1] } - extent[a] + 1; // 0: empty
    is = is && points >= 0 && points <= std::numeric_limits<int>::max();
  }
  return is;
}

// One cell fewer than points along an axis of the whole image.
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

// The inverse of tuplesOf: one point more than cells, where the whole image has cells.
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

// Cuts what a box leaves of each other box into up to six boxes: below and above it along each
// axis, within what is common along the axes before.
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
      // What is below and above the common part along this axis is left. The rest goes on with the
      // common range.
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

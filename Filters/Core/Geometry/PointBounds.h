// SPDX-License-Identifier: BSD-3-Clause
// The bounds of points in space, and boxes of items for a tree (see BoxTree.h).
#ifndef RectifiedTransport_PointBounds_h
#define RectifiedTransport_PointBounds_h

#include "Core/Geometry/BoxTree.h"
#include "Core/Geometry/Points.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace RectifiedTransport
{

class Progress;

struct PointBounds
{
  void Add(const double* x) { this->Add(x, x); }
  void Add(const PointBounds& other) { this->Add(other.Low.data(), other.High.data()); }
  void Add(const double* low, const double* high)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], low[axis]);
      this->High[axis] = std::max(this->High[axis], high[axis]);
    }
  }

  double Length(std::size_t axis) const { return this->High[axis] - this->Low[axis]; }
  // The axis of the longest side.
  std::size_t Longest() const
  {
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      longest = this->Length(axis) > this->Length(longest) ? axis : longest;
    }
    return longest;
  }

  static constexpr double most = std::numeric_limits<double>::infinity();
  Point<3> Low{ most, most, most };
  Point<3> High{ -most, -most, -most };
};

struct ItemBox : PointBounds
{
  std::int64_t First;
  std::int64_t Last;
  std::int64_t Second; // of the children, after the next one; -1 in a leaf
};

// Puts the items of a box in two parts across its longest side, by value(item, axis), unless they
// are few enough for a leaf. Returns where the second part begins, the first item for a leaf.
template <class Value>
std::int64_t divideItems(std::int64_t* items, const ItemBox& box, std::int64_t itemsOfLeaf,
  const Value& value, Progress& progress)
{
  if (box.Last - box.First <= itemsOfLeaf)
  {
    return box.First;
  }
  const std::size_t longest = box.Longest();
  const std::int64_t middle = partitionAboutMedian(
    items, box.First, box.Last, [&](std::int64_t item) { return value(item, longest); }, progress);
  // Where all values are the same, any halves do.
  return middle < box.Last ? middle : (box.First + box.Last) / 2;
}

} // namespace RectifiedTransport

#endif

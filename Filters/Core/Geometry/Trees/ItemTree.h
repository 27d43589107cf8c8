// SPDX-License-Identifier: BSD-3-Clause
// A tree of the bounding boxes of numbered items.
#ifndef RectifiedTransport_ItemTree_h
#define RectifiedTransport_ItemTree_h

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Trees/BoxTree.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// The bounds of a range of items in a tree, see makeBoxTree.
struct ItemBox : PointBounds
{
  std::int64_t First; // items
  std::int64_t Last;
  std::int64_t Second; // number of the second child, the first being the next box; -1 in a leaf
};

class ItemTree
{
public:
  // bound(item, box) adds an item to a box. Boxes of more than `itemsOfLeaf` items are divided
  // across their longest side, by value(item, axis). Throws std::bad_alloc and Cancelled.
  template <class Bound, class Value>
  ItemTree(std::vector<std::int64_t> items, std::int64_t itemsOfLeaf, const Bound& bound,
    const Value& value, Progress& progress)
    : Items(std::move(items))
  {
    if (this->Items.empty())
    {
      return;
    }
    this->Boxes = makeBoxTree<ItemBox>(
      static_cast<std::int64_t>(this->Items.size()),
      [&](std::int64_t first, std::int64_t last) {
        // Bounds of the items, and a leaf until it is divided.
        ItemBox box{ {}, first, last, -1 };
        for (std::int64_t i = first; i < last; ++i)
        {
          bound(this->Items[static_cast<std::size_t>(i)], box);
        }
        progress.Add(last - first);
        return box;
      },
      [&](const ItemBox& box) {
        if (box.Last - box.First <= itemsOfLeaf)
        {
          return box.First;
        }
        const std::size_t longest = box.Longest();
        const std::int64_t middle = partitionAboutMedian(
          this->Items.data(), box.First, box.Last,
          [&](std::int64_t item) { return value(item, longest); }, progress);
        // Where all values are the same, any halves do.
        return middle < box.Last ? middle : (box.First + box.Last) / 2;
      });
  }

  // Calls visit(item) for the items of the leaves for which isNear(bounds) is true, as it is for
  // all boxes that they are in.
  template <class IsNear, class Visit>
  void VisitNear(const IsNear& isNear, const Visit& visit) const
  {
    if (!this->Boxes.empty())
    {
      this->VisitNear(0, isNear, visit);
    }
  }

private:
  template <class IsNear, class Visit>
  void VisitNear(std::int64_t at, const IsNear& isNear, const Visit& visit) const
  {
    const ItemBox& box = this->Boxes[static_cast<std::size_t>(at)];
    // Nothing in the box is near either.
    if (!isNear(box))
    {
      return;
    }
    if (box.Second >= 0)
    {
      this->VisitNear(at + 1, isNear, visit);
      this->VisitNear(box.Second, isNear, visit);
      return;
    }
    for (std::int64_t i = box.First; i < box.Last; ++i)
    {
      visit(this->Items[static_cast<std::size_t>(i)]);
    }
  }

  std::vector<std::int64_t> Items;
  std::vector<ItemBox> Boxes;
};

} // namespace RectifiedTransport

#endif

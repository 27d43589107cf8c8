// SPDX-License-Identifier: BSD-3-Clause
// A binary tree of bounds over numbered blocks of points, which are its leaves: one child of a box
// has the first half of its blocks, the other one the rest.
#ifndef RectifiedTransport_BlockTree_h
#define RectifiedTransport_BlockTree_h

#include "Core/Geometry/Trees/BlockBounds.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Enlarges bounds by others.
template <int Dimension>
void join(BlockBounds<Dimension>& bounds, const BlockBounds<Dimension>& other)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    bounds.Low[axis] = std::min(bounds.Low[axis], other.Low[axis]);
    bounds.High[axis] = std::max(bounds.High[axis], other.High[axis]);
  }
  bounds.Largest = std::max(bounds.Largest, other.Largest);
}

// The squared distance of two boxes.
template <int Dimension>
double squaredGap(const BlockBounds<Dimension>& a, const BlockBounds<Dimension>& b)
{
  double squared = 0.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    // Not the maximum of a list: compilers keep that one in memory.
    const double above = a.Low[axis] - b.High[axis];
    const double below = b.Low[axis] - a.High[axis];
    const double most = above > below ? above : below;
    const double gap = most > 0.0 ? most : 0.0;
    squared += gap * gap;
  }
  return squared;
}

template <int Dimension>
class BlockTree
{
public:
  using Bounds = BlockBounds<Dimension>;

  // Throws std::bad_alloc.
  explicit BlockTree(std::int64_t blocks = 0)
    : Leaves(static_cast<std::size_t>(blocks))
    , Boxes(static_cast<std::size_t>(std::max<std::int64_t>(2 * blocks - 1, 0)))
  {
  }
  // The most bytes.
  static double MemoryFor(double blocks) { return 3.0 * sizeof(Bounds) * blocks; }

  std::int64_t Blocks() const { return static_cast<std::int64_t>(this->Leaves.size()); }
  Bounds& operator[](std::int64_t block) { return this->Leaves[static_cast<std::size_t>(block)]; }
  const Bounds& operator[](std::int64_t block) const
  {
    return this->Leaves[static_cast<std::size_t>(block)];
  }

  // Updates the boxes after the blocks' bounds have changed.
  void Update()
  {
    if (!this->Leaves.empty())
    {
      this->Update({ 0, 0, this->Blocks() });
    }
  }

  // Calls visit(first, last) for the blocks [first, last) of each box, parents before their
  // children. The second half begins at middleOf(first, last).
  template <class Visit>
  void ForEach(const Visit& visit) const
  {
    this->Descend([&](const Part& part) {
      visit(part.First, part.Last);
      return true;
    });
  }
  static std::int64_t middleOf(std::int64_t first, std::int64_t last)
  {
    return first + (last - first) / 2;
  }

  // The bounds of the blocks [first, last).
  Bounds BoundsOf(std::int64_t first, std::int64_t last) const
  {
    Bounds bounds = (*this)[first];
    for (std::int64_t block = first + 1; block < last; ++block)
    {
      join<Dimension>(bounds, (*this)[block]);
    }
    return bounds;
  }

  // Finds the blocks for which isInReach(bounds) is true; it must be true for all boxes around such
  // a block, too. The blocks ascend.
  template <class Test>
  void Find(const Test& isInReach, std::vector<std::int64_t>& found) const
  {
    found.clear();
    this->Descend([&](const Part& part) {
      if (!isInReach(this->Boxes[static_cast<std::size_t>(part.Box)]))
      {
        return false;
      }
      if (part.Last - part.First == 1)
      {
        found.push_back(part.First);
      }
      return true;
    });
  }

private:
  // Boxes are in depth-first order: the first child is the next one, the second one comes after
  // what is in the first.
  struct Part
  {
    std::int64_t Box;
    std::int64_t First; // blocks
    std::int64_t Last;

    std::int64_t Middle() const { return middleOf(this->First, this->Last); }
    Part FirstHalf() const { return { this->Box + 1, this->First, this->Middle() }; }
    Part SecondHalf() const
    {
      return { this->Box + 2 * (this->Middle() - this->First), this->Middle(), this->Last };
    }
  };

  // Visits boxes depth-first, and goes on to the children of those for which visit(part) is true.
  template <class Visit>
  void Descend(const Visit& visit) const
  {
    Part stack[64]; // more than the tree's depth
    int depth = 0;
    if (!this->Leaves.empty())
    {
      stack[depth++] = { 0, 0, this->Blocks() };
    }
    while (depth > 0)
    {
      const Part part = stack[--depth];
      if (visit(part) && part.Last - part.First > 1)
      {
        stack[depth++] = part.SecondHalf();
        stack[depth++] = part.FirstHalf();
      }
    }
  }

  void Update(const Part& part)
  {
    Bounds& box = this->Boxes[static_cast<std::size_t>(part.Box)];
    if (part.Last - part.First == 1)
    {
      box = (*this)[part.First];
      return;
    }
    this->Update(part.FirstHalf());
    this->Update(part.SecondHalf());
    box = this->Boxes[static_cast<std::size_t>(part.FirstHalf().Box)];
    join<Dimension>(box, this->Boxes[static_cast<std::size_t>(part.SecondHalf().Box)]);
  }

  std::vector<Bounds> Leaves; // one per block
  std::vector<Bounds> Boxes;
};

} // namespace RectifiedTransport

#endif

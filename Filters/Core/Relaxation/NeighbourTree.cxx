// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/NeighbourTree.h"

#include "Core/Parallel/Polls.h"
#include "Core/Parallel/Progress.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

// A point with its number in the given order.
template <int Dimension>
struct NumberedPoint
{
  ScaledPoint<Dimension> Point;
  std::int64_t Number;
};

// Compares a and b along an axis. Equal coordinates are compared along the next axes, and
// coincident points by their numbers, so that the order is total and does not depend on threads.
template <int Dimension>
bool isBefore(const NumberedPoint<Dimension>& a, const NumberedPoint<Dimension>& b, int axis)
{
  for (int step = 0; step < Dimension; ++step)
  {
    const int at = (axis + step) % Dimension;
    if (a.Point.X[at] != b.Point.X[at])
    {
      return a.Point.X[at] < b.Point.X[at];
    }
  }
  return a.Number < b.Number;
}

// Returns the axis along which the points have the largest extent.
template <int Dimension>
int widestAxis(const NumberedPoint<Dimension>* first, const NumberedPoint<Dimension>* last)
{
  int widest = 0;
  double most = -1.0;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const auto [low, high] = std::minmax_element(first, last,
      [axis](const auto& a, const auto& b) { return a.Point.X[axis] < b.Point.X[axis]; });
    const double width = high->Point.X[axis] - low->Point.X[axis];
    widest = width > most ? axis : widest;
    most = std::max(width, most);
  }
  return widest;
}

// A block as a signed number.
constexpr std::int64_t wholeBlock = repulsionBlock;

} // namespace

template <int Dimension>
void NeighbourTree<Dimension>::Begin(std::int64_t points)
{
  this->Count = points;
  this->Sorted.resize(static_cast<std::size_t>((points + repulsionBlock - 1) / repulsionBlock));
  // A balanced tree over the blocks, whose shape depends only on their number.
  this->Boxes = BlockTree<Dimension>(this->Blocks());
}

template <int Dimension>
void NeighbourTree<Dimension>::End()
{
  // Lanes without a point have the squared spacing -infinity: the test |gap|^2 < reach * (sum of
  // squares) then fails for every target.
  ScaledPoint<Dimension> missing{};
  missing.Square = -std::numeric_limits<double>::infinity();
  for (std::int64_t i = this->Count; i < this->Blocks() * repulsionBlock; ++i)
  {
    this->Set(i, missing);
  }
  this->Update();
}

template <int Dimension>
void NeighbourTree<Dimension>::BuildInOrder(
  const std::vector<ScaledPoint<Dimension>>& points, Progress& progress)
{
  this->Begin(static_cast<std::int64_t>(points.size()));
  progress.Check();
  constexpr std::int64_t grain = 512 * wholeBlock;
  progress.ForEach(
    this->Count, grain, [&](std::int64_t i) { this->Set(i, points[static_cast<std::size_t>(i)]); });
  this->End();
  progress.Check();
}

// A balanced tree: each node halves its points at the median of its widest axis, at a multiple of
// the block size. nth_element gives O(n log n) in all.
template <int Dimension>
void NeighbourTree<Dimension>::Build(
  const std::vector<ScaledPoint<Dimension>>& points, Progress& progress)
{
  std::vector<NumberedPoint<Dimension>> numbered;
  numbered.reserve(points.size());
  for (const auto& point : points)
  {
    numbered.push_back({ point, static_cast<std::int64_t>(numbered.size()) });
  }
  progress.Check();
  this->Begin(static_cast<std::int64_t>(points.size()));
  progress.Check();
  Polls polls(progress);
  this->Boxes.ForEach([&](std::int64_t firstBlock, std::int64_t lastBlock) {
    // The points of the blocks [firstBlock, lastBlock).
    auto* first = numbered.data() + firstBlock * repulsionBlock;
    auto* last = numbered.data() + std::min(lastBlock * repulsionBlock, this->Size());
    // Within a block, points are sorted completely, so that their order does not depend on how
    // nth_element arranges equal parts.
    const bool isBlock = lastBlock - firstBlock == 1;
    const int axis = isBlock ? 0 : widestAxis<Dimension>(first, last);
    const auto before = [&polls, axis](const auto& a, const auto& b) {
      polls.Count();
      return isBefore<Dimension>(a, b, axis);
    };
    if (isBlock)
    {
      std::sort(first, last, before);
      return;
    }
    const std::int64_t middle = BlockTree<Dimension>::middleOf(firstBlock, lastBlock);
    std::nth_element(first, numbered.data() + middle * repulsionBlock, last, before);
  });
  // The number that each point had before.
  this->Places.resize(numbered.size());
  for (std::size_t i = 0; i < numbered.size(); ++i)
  {
    this->Set(static_cast<std::int64_t>(i), numbered[i].Point);
    this->Places[i] = numbered[i].Number;
  }
  progress.Check();
  this->End();
  progress.Check();
}

// The bounds take the block's real points alone: the lanes that are missing have no place.
template <int Dimension>
BlockBounds<Dimension> NeighbourTree<Dimension>::BoundsOf(std::int64_t number) const
{
  const ScaledBlock<Dimension>& block = this->Sorted[static_cast<std::size_t>(number)];
  const std::int64_t count = std::min(this->Size() - number * repulsionBlock, wholeBlock);
  BlockBounds<Dimension> bounds;
  bounds.Largest = *std::max_element(block.Square, block.Square + count);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double* x = block.X[axis];
    bounds.Low[axis] = *std::min_element(x, x + count);
    bounds.High[axis] = *std::max_element(x, x + count);
  }
  return bounds;
}

// Point i is lane i mod 8 of block i / 8: coordinates are arrays by axes within a block.
template <int Dimension>
ScaledPoint<Dimension> NeighbourTree<Dimension>::Get(std::int64_t i) const
{
  const ScaledBlock<Dimension>& block = this->Sorted[static_cast<std::size_t>(i / repulsionBlock)];
  const std::int64_t lane = i % repulsionBlock;
  ScaledPoint<Dimension> point;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    point.X[axis] = block.X[axis][lane];
  }
  point.Spacing = block.Spacing[lane];
  point.Square = block.Square[lane];
  point.Mass = block.Mass[lane];
  return point;
}

template <int Dimension>
void NeighbourTree<Dimension>::Set(std::int64_t i, const ScaledPoint<Dimension>& point)
{
  ScaledBlock<Dimension>& block = this->Sorted[static_cast<std::size_t>(i / repulsionBlock)];
  const std::int64_t lane = i % repulsionBlock;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    block.X[axis][lane] = point.X[axis];
  }
  block.Spacing[lane] = point.Spacing;
  block.Square[lane] = point.Square;
  block.Mass[lane] = point.Mass;
}

// Points may have moved: this renews the boxes of the blocks, then those of the nodes above them,
// but not the order.
template <int Dimension>
void NeighbourTree<Dimension>::Update()
{
  for (std::int64_t block = 0; block < this->Blocks(); ++block)
  {
    this->Boxes[block] = this->BoundsOf(block);
  }
  this->Boxes.Update();
}

// Lanes beyond the last point repeat it: the kernels compute whole registers, and the caller
// ignores these sums.
template <int Dimension>
int NeighbourTree<Dimension>::Fill(std::int64_t block, RepulsionBlock<Dimension>& into) const
{
  const ScaledBlock<Dimension>& from = this->Sorted[static_cast<std::size_t>(block)];
  const std::int64_t count = std::min(this->Size() - block * repulsionBlock, wholeBlock);
  for (std::int64_t lane = 0; lane < repulsionBlock; ++lane)
  {
    const std::int64_t at = std::min(lane, count - 1);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      into.X[axis][lane] = from.X[axis][at];
    }
    // Targets have no masses: the kernels sum the sources' masses at them.
    into.Spacing[lane] = from.Spacing[at];
    into.Square[lane] = from.Square[at];
  }
  return static_cast<int>(count);
}

template <int Dimension>
void NeighbourTree<Dimension>::FindNearby(const NeighbourTree& targets, std::int64_t block,
  std::int64_t last, double reach, Neighbourhood& found) const
{
  // Blocks that are neighbours in the order share one search through the boxes, for the box around
  // all of them. Select() then tests each point exactly. 8 blocks of 8 points have nearly the same
  // neighbours, while a larger group would pass many points to Select() that it rejects.
  constexpr std::int64_t together = 8;
  if (block < found.First || block >= found.Last)
  {
    found.First = block;
    found.Last = std::min((block / together + 1) * together, last);
    const BlockBounds<Dimension> target = targets.Boxes.BoundsOf(found.First, found.Last);
    // A block can be in reach if the gap d between both boxes satisfies d^2 < reach * (h^2 + k^2)
    // for the largest spacings h and k in them.
    this->Boxes.Find(
      [&](const BlockBounds<Dimension>& box) {
        return squaredGap<Dimension>(box, target) < reach * (box.Largest + target.Largest);
      },
      found.Blocks);
  }
  if (found.Points.size() < found.Blocks.size() * repulsionBlock)
  {
    found.Points.resize(found.Blocks.size() * repulsionBlock);
  }
  // The points of the listed blocks that may reach the target block, by their numbers in the order.
  found.Count = this->Kernels.Select(targets.Boxes[block], reach, this->Points(),
    found.Blocks.data(), static_cast<std::int64_t>(found.Blocks.size()), found.Points.data());
}

template class NeighbourTree<2>;
template class NeighbourTree<3>;

} // namespace RectifiedTransport

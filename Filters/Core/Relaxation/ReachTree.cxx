// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/ReachTree.h"

#include "Core/Geometry/BoxTree.h"
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/Polls.h"

#include <algorithm>
#include <limits>

namespace RectifiedTransport
{

namespace
{

template <int Dimension>
struct NumberedPoint
{
  ScaledPoint<Dimension> Point;
  std::int64_t Number;
};

// Whether a is before b along an axis. Equal coordinates are compared along the next ones, and
// coincident points by their numbers.
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

constexpr std::int64_t wholeBlock = repulsionBlock;

template <int Dimension>
void join(ReachBounds<Dimension>& bounds, const ReachBounds<Dimension>& other)
{
  for (int axis = 0; axis < Dimension; ++axis)
  {
    bounds.Low[axis] = std::min(bounds.Low[axis], other.Low[axis]);
    bounds.High[axis] = std::max(bounds.High[axis], other.High[axis]);
  }
  bounds.Square = std::max(bounds.Square, other.Square);
}

template <int Dimension>
bool isInReach(const ReachBounds<Dimension>& a, const ReachBounds<Dimension>& b, double reach)
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
  return squared < reach * (a.Square + b.Square);
}

} // namespace

template <int Dimension>
void ReachTree<Dimension>::Begin(std::int64_t points)
{
  this->Count = points;
  this->Sorted.resize(static_cast<std::size_t>((points + repulsionBlock - 1) / repulsionBlock));
  this->MakeBoxes();
}

template <int Dimension>
void ReachTree<Dimension>::End()
{
  ScaledPoint<Dimension> missing{};
  missing.Square = -std::numeric_limits<double>::infinity();
  for (std::int64_t i = this->Count; i < this->Blocks() * repulsionBlock; ++i)
  {
    this->Set(i, missing);
  }
  this->Update();
}

template <int Dimension>
void ReachTree<Dimension>::BuildInOrder(
  const std::vector<ScaledPoint<Dimension>>& points, Progress& progress)
{
  this->Begin(static_cast<std::int64_t>(points.size()));
  progress.Check();
  constexpr std::int64_t grain = 512 * wholeBlock;
  progress.For(this->Count, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      this->Set(i, points[static_cast<std::size_t>(i)]);
    }
  });
  this->End();
  progress.Check();
}

template <int Dimension>
void ReachTree<Dimension>::Build(
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
  // Parents are before their children.
  Polls polls(progress);
  for (const Box& box : this->Boxes)
  {
    auto* first = numbered.data() + box.First * repulsionBlock;
    auto* last = numbered.data() + std::min(box.Last * repulsionBlock, this->Size());
    const int axis = box.Second < 0 ? 0 : widestAxis<Dimension>(first, last);
    const auto before = [&polls, axis](const auto& a, const auto& b) {
      polls.Count();
      return isBefore<Dimension>(a, b, axis);
    };
    if (box.Second < 0)
    {
      std::sort(first, last, before);
      continue;
    }
    const std::int64_t middle = this->Boxes[static_cast<std::size_t>(box.Second)].First;
    std::nth_element(first, numbered.data() + middle * repulsionBlock, last, before);
  }
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

// The tree of halves of the blocks, without places yet.
template <int Dimension>
void ReachTree<Dimension>::MakeBoxes()
{
  this->BlockBox.assign(static_cast<std::size_t>(this->Blocks()), 0);
  this->Boxes.clear();
  if (this->Blocks() == 0)
  {
    return;
  }
  this->Boxes = makeBoxTree<Box>(
    this->Blocks(),
    [](std::int64_t first, std::int64_t last) {
      Box box{};
      box.First = first;
      box.Last = last;
      box.Second = -1;
      return box;
    },
    [](const Box& box) { return (box.First + box.Last) / 2; }); // of one block: the first
  for (std::size_t i = 0; i < this->Boxes.size(); ++i)
  {
    if (this->Boxes[i].Second < 0)
    {
      this->BlockBox[static_cast<std::size_t>(this->Boxes[i].First)] = static_cast<std::int64_t>(i);
    }
  }
}

template <int Dimension>
void ReachTree<Dimension>::Bound(Box& box) const
{
  const ScaledBlock<Dimension>& block = this->Sorted[static_cast<std::size_t>(box.First)];
  const std::int64_t count = std::min(this->Size() - box.First * repulsionBlock, wholeBlock);
  box.Square = *std::max_element(block.Square, block.Square + count);
  for (int axis = 0; axis < Dimension; ++axis)
  {
    const double* x = block.X[axis];
    box.Low[axis] = *std::min_element(x, x + count);
    box.High[axis] = *std::max_element(x, x + count);
  }
}

template <int Dimension>
ScaledPoint<Dimension> ReachTree<Dimension>::Get(std::int64_t i) const
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
void ReachTree<Dimension>::Set(std::int64_t i, const ScaledPoint<Dimension>& point)
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

template <int Dimension>
void ReachTree<Dimension>::Update()
{
  for (std::size_t i = this->Boxes.size(); i-- > 0;)
  {
    Box& box = this->Boxes[i];
    if (box.Second < 0)
    {
      this->Bound(box);
      continue;
    }
    ReachBounds<Dimension>& bounds = box;
    bounds = this->Boxes[i + 1];
    join<Dimension>(bounds, this->Boxes[static_cast<std::size_t>(box.Second)]);
  }
}

template <int Dimension>
int ReachTree<Dimension>::Fill(std::int64_t block, RepulsionBlock<Dimension>& into) const
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
    into.Spacing[lane] = from.Spacing[at];
    into.Square[lane] = from.Square[at];
  }
  return static_cast<int>(count);
}

template <int Dimension>
void ReachTree<Dimension>::FindBlocks(const ReachTree& targets, double reach, InReach& found) const
{
  ReachBounds<Dimension> target = targets.BoxOf(found.First);
  for (std::int64_t block = found.First + 1; block < found.Last; ++block)
  {
    join<Dimension>(target, targets.BoxOf(block));
  }
  found.Blocks.clear();
  std::int64_t stack[64]; // more than the tree's depth
  int depth = 0;
  if (!this->Boxes.empty())
  {
    stack[depth++] = 0;
  }
  while (depth > 0)
  {
    const std::int64_t at = stack[--depth];
    const Box& box = this->Boxes[static_cast<std::size_t>(at)];
    if (!isInReach<Dimension>(box, target, reach))
    {
      continue;
    }
    if (box.Second < 0)
    {
      found.Blocks.push_back(box.First);
      continue;
    }
    stack[depth++] = box.Second;
    stack[depth++] = at + 1;
  }
}

template <int Dimension>
void ReachTree<Dimension>::FindInReach(const ReachTree& targets, std::int64_t block,
  std::int64_t last, double reach, InReach& found) const
{
  constexpr std::int64_t together = 8;
  if (block < found.First || block >= found.Last)
  {
    found.First = block;
    found.Last = std::min((block / together + 1) * together, last);
    this->FindBlocks(targets, reach, found);
  }
  if (found.Points.size() < found.Blocks.size() * repulsionBlock)
  {
    found.Points.resize(found.Blocks.size() * repulsionBlock);
  }
  found.Count = this->Kernels.Select(targets.BoxOf(block), reach, this->Points(),
    found.Blocks.data(), static_cast<std::int64_t>(found.Blocks.size()), found.Points.data());
}

template class ReachTree<2>;
template class ReachTree<3>;

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/ReachTree.h"

#include "Core/Geometry/BoxTree.h"
#include "Core/Parallel/Progress.h"
#include "Core/Relaxation/Polls.h"

#include <algorithm>
#include <limits>
#include <utility>

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

} // namespace

template <int Dimension>
void ReachTree<Dimension>::Build(std::vector<ScaledPoint<Dimension>> points, Progress& progress)
{
  this->Sorted = std::move(points);
  std::vector<NumberedPoint<Dimension>> numbered;
  numbered.reserve(this->Sorted.size());
  for (const auto& point : this->Sorted)
  {
    numbered.push_back({ point, static_cast<std::int64_t>(numbered.size()) });
  }
  progress.Check();
  this->MakeBoxes();
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
  this->Places.resize(this->Sorted.size());
  for (std::size_t i = 0; i < numbered.size(); ++i)
  {
    this->Sorted[i] = numbered[i].Point;
    this->Places[i] = numbered[i].Number;
  }
  progress.Check();
  this->Update();
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
  const std::int64_t first = box.First * repulsionBlock;
  const std::int64_t last = std::min(box.Last * repulsionBlock, this->Size());
  std::fill_n(box.Low, Dimension, std::numeric_limits<double>::infinity());
  std::fill_n(box.High, Dimension, -std::numeric_limits<double>::infinity());
  box.Square = 0.0;
  for (const auto* point = this->Points() + first; point < this->Points() + last; ++point)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      box.Low[axis] = std::min(box.Low[axis], point->X[axis]);
      box.High[axis] = std::max(box.High[axis], point->X[axis]);
    }
    box.Square = std::max(box.Square, point->Square);
  }
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
    const Box& a = this->Boxes[i + 1];
    const Box& b = this->Boxes[static_cast<std::size_t>(box.Second)];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      box.Low[axis] = std::min(a.Low[axis], b.Low[axis]);
      box.High[axis] = std::max(a.High[axis], b.High[axis]);
    }
    box.Square = std::max(a.Square, b.Square);
  }
}

template <int Dimension>
int ReachTree<Dimension>::Fill(std::int64_t block, RepulsionBlock<Dimension>& into) const
{
  const std::int64_t first = block * repulsionBlock;
  const std::int64_t last = std::min(first + repulsionBlock, this->Size());
  for (int lane = 0; lane < repulsionBlock; ++lane)
  {
    const auto& point = this->Sorted[static_cast<std::size_t>(std::min(first + lane, last - 1))];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      into.X[axis][lane] = point.X[axis];
    }
    into.Spacing[lane] = point.Spacing;
    into.Square[lane] = point.Square;
  }
  return static_cast<int>(last - first);
}

template <int Dimension>
void ReachTree<Dimension>::FindInReach(const ReachTree& targets, std::int64_t block, double reach,
  std::vector<ScaledPoint<Dimension>>& found) const
{
  const Box& target =
    targets.Boxes[static_cast<std::size_t>(targets.BlockBox[static_cast<std::size_t>(block)])];
  const auto isInReach = [&](const double* low, const double* high, double square) {
    double squared = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double gap =
        std::max({ low[axis] - target.High[axis], target.Low[axis] - high[axis], 0.0 });
      squared += gap * gap;
    }
    return squared < reach * (square + target.Square);
  };
  found.clear();
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
    if (!isInReach(box.Low, box.High, box.Square))
    {
      continue;
    }
    if (box.Second >= 0)
    {
      stack[depth++] = box.Second;
      stack[depth++] = at + 1;
      continue;
    }
    const std::int64_t first = box.First * repulsionBlock;
    const std::int64_t last = std::min(first + repulsionBlock, this->Size());
    for (const auto* point = this->Points() + first; point < this->Points() + last; ++point)
    {
      if (isInReach(point->X, point->X, point->Square))
      {
        found.push_back(*point);
      }
    }
  }
}

template class ReachTree<2>;
template class ReachTree<3>;

} // namespace RectifiedTransport

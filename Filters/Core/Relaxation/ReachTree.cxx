// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Relaxation/ReachTree.h"

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Whether a is before b along an axis; equal coordinates are compared along the next ones.
template <int Dimension>
bool isBefore(const ScaledPoint<Dimension>& a, const ScaledPoint<Dimension>& b, int axis)
{
  for (int step = 0; step < Dimension; ++step)
  {
    const int at = (axis + step) % Dimension;
    if (a.X[at] != b.X[at])
    {
      return a.X[at] < b.X[at];
    }
  }
  return false;
}

} // namespace

template <int Dimension>
typename ReachTree<Dimension>::Box ReachTree<Dimension>::BoundsOf(
  std::int64_t firstPoint, std::int64_t lastPoint) const
{
  Box box{};
  std::fill_n(box.Low, Dimension, std::numeric_limits<double>::infinity());
  std::fill_n(box.High, Dimension, -std::numeric_limits<double>::infinity());
  for (std::int64_t i = firstPoint; i < lastPoint; ++i)
  {
    const ScaledPoint<Dimension>& point = this->Sorted[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      box.Low[axis] = std::min(box.Low[axis], point.X[axis]);
      box.High[axis] = std::max(box.High[axis], point.X[axis]);
    }
    box.Square = std::max(box.Square, point.Square);
  }
  return box;
}

template <int Dimension>
void ReachTree<Dimension>::Build(std::vector<ScaledPoint<Dimension>> points, Progress& progress)
{
  struct Task
  {
    std::int64_t First; // tiles
    std::int64_t Last;
    std::int64_t Parent; // of a second child, else -1
  };
  this->Sorted = std::move(points);
  this->Boxes.clear();
  const std::int64_t count = this->Size();
  std::vector<std::pair<ScaledPoint<Dimension>, std::int64_t>> sort;
  sort.reserve(this->Sorted.size());
  for (const auto& point : this->Sorted)
  {
    sort.emplace_back(point, static_cast<std::int64_t>(sort.size()));
  }
  const auto sortAlong = [&](const Task& task, int axis, std::int64_t middle) {
    const auto before = [axis](const auto& a, const auto& b) {
      return isBefore<Dimension>(a.first, b.first, axis) ||
        (!isBefore<Dimension>(b.first, a.first, axis) && a.second < b.second);
    };
    const auto begin = sort.begin() + task.First * repulsionTile;
    const auto end = sort.begin() + std::min(task.Last * repulsionTile, count);
    if (middle < 0)
    {
      std::sort(begin, end, before);
      return;
    }
    std::nth_element(begin, sort.begin() + middle * repulsionTile, end, before);
  };
  this->TileBox.assign(static_cast<std::size_t>(this->Tiles()), 0);
  std::vector<Task> tasks;
  if (count > 0)
  {
    tasks.push_back({ 0, this->Tiles(), -1 });
  }
  while (!tasks.empty())
  {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto at = static_cast<std::int64_t>(this->Boxes.size());
    if (task.Parent >= 0)
    {
      this->Boxes[static_cast<std::size_t>(task.Parent)].Second = at;
    }
    Box box{};
    box.First = task.First;
    box.Last = task.Last;
    box.Second = -1;
    this->Boxes.push_back(box);
    if (task.Last - task.First == 1)
    {
      this->TileBox[static_cast<std::size_t>(task.First)] = at;
      sortAlong(task, 0, -1);
      continue;
    }
    double low[Dimension];
    double high[Dimension];
    std::fill_n(low, Dimension, std::numeric_limits<double>::infinity());
    std::fill_n(high, Dimension, -std::numeric_limits<double>::infinity());
    for (std::int64_t i = task.First * repulsionTile;
         i < std::min(task.Last * repulsionTile, count); ++i)
    {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        low[axis] = std::min(low[axis], sort[static_cast<std::size_t>(i)].first.X[axis]);
        high[axis] = std::max(high[axis], sort[static_cast<std::size_t>(i)].first.X[axis]);
      }
    }
    int axis = 0;
    for (int r = 1; r < Dimension; ++r)
    {
      axis = high[r] - low[r] > high[axis] - low[axis] ? r : axis;
    }
    const std::int64_t middle = (task.First + task.Last) / 2;
    sortAlong(task, axis, middle);
    tasks.push_back({ middle, task.Last, at });
    tasks.push_back({ task.First, middle, -1 });
    if (task.Last - task.First > 64)
    {
      progress.Check();
    }
  }
  this->Places.resize(this->Sorted.size());
  for (std::size_t i = 0; i < sort.size(); ++i)
  {
    this->Sorted[i] = sort[i].first;
    this->Places[i] = sort[i].second;
  }
  this->Update();
}

template <int Dimension>
void ReachTree<Dimension>::Update()
{
  for (std::size_t i = this->Boxes.size(); i-- > 0;)
  {
    Box& box = this->Boxes[i];
    Box found{};
    if (box.Second < 0)
    {
      found =
        this->BoundsOf(box.First * repulsionTile, std::min(box.Last * repulsionTile, this->Size()));
    }
    else
    {
      const Box& a = this->Boxes[i + 1];
      const Box& b = this->Boxes[static_cast<std::size_t>(box.Second)];
      for (int axis = 0; axis < Dimension; ++axis)
      {
        found.Low[axis] = std::min(a.Low[axis], b.Low[axis]);
        found.High[axis] = std::max(a.High[axis], b.High[axis]);
      }
      found.Square = std::max(a.Square, b.Square);
    }
    found.First = box.First;
    found.Last = box.Last;
    found.Second = box.Second;
    box = found;
  }
}

template <int Dimension>
int ReachTree<Dimension>::Fill(std::int64_t tile, RepulsionTile<Dimension>& into) const
{
  const std::int64_t first = tile * repulsionTile;
  const std::int64_t last = std::min(first + repulsionTile, this->Size());
  for (int lane = 0; lane < repulsionTile; ++lane)
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
void ReachTree<Dimension>::FindInReach(const ReachTree& targets, std::int64_t tile, double reach,
  std::vector<ScaledPoint<Dimension>>& found) const
{
  const Box& target =
    targets.Boxes[static_cast<std::size_t>(targets.TileBox[static_cast<std::size_t>(tile)])];
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
    const std::int64_t first = box.First * repulsionTile;
    const std::int64_t last = std::min(first + repulsionTile, this->Size());
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

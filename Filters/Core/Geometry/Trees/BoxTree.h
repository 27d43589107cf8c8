// SPDX-License-Identifier: BSD-3-Clause
// Binary trees of bounding boxes over items in an array: how they are made.
#ifndef RectifiedTransport_BoxTree_h
#define RectifiedTransport_BoxTree_h

#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// Makes the boxes of [0, count) in depth-first order: make(first, last) makes the box of some
// items, and divide(box) puts these in two parts; it returns where the second one begins, the first
// item for a leaf. A box has First and Last, its items. The first child of a box is the next one in
// the vector; its member Second, -1 in leaves, becomes the number of the other one.
template <class Box, class Make, class Divide>
std::vector<Box> makeBoxTree(std::int64_t count, const Make& make, const Divide& divide)
{
  struct Task
  {
    std::int64_t First;
    std::int64_t Last;
    std::int64_t Parent; // the box whose second child this is; else -1
  };
  std::vector<Box> boxes;
  std::vector<Task> tasks{ { 0, count, -1 } };
  while (!tasks.empty())
  {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto number = static_cast<std::int64_t>(boxes.size());
    if (task.Parent >= 0)
    {
      boxes[static_cast<std::size_t>(task.Parent)].Second = number;
    }
    boxes.push_back(make(task.First, task.Last));
    const std::int64_t middle = divide(boxes.back());
    if (middle > task.First)
    {
      tasks.push_back({ middle, task.Last, number });
      tasks.push_back({ task.First, middle, -1 });
    }
  }
  return boxes;
}

// Partitions items about the median of a sample of their values: those below it before the others,
// or, if there are none, those equal to it before those above. Returns where the second part
// begins: `last` if all values are equal. Adds the items that it reads to the progress.
// Throws Cancelled.
template <class Item, class Value>
std::int64_t partitionAboutMedian(
  Item* items, std::int64_t first, std::int64_t last, const Value& value, Progress& progress)
{
  constexpr std::int64_t mostAtOnce = std::int64_t{ 1 } << 15; // between two polls
  // The median of 63 samples is near that of all, at a cost that does not grow with the count.
  std::array<double, 63> sample;
  const std::int64_t count = last - first;
  const std::int64_t taken = std::min<std::int64_t>(count, sample.size());
  for (std::int64_t i = 0; i < taken; ++i)
  {
    sample[static_cast<std::size_t>(i)] = value(items[first + i * count / taken]);
  }
  const auto median = sample.begin() + taken / 2;
  std::nth_element(sample.begin(), median, sample.begin() + taken);
  const double pivot = *median;
  // The second try, with the values equal to the pivot in the first part, is for many equal values.
  for (const bool withEqual : { false, true })
  {
    const auto isBelow = [&](const Item& item) {
      return withEqual ? value(item) <= pivot : value(item) < pivot;
    };
    std::int64_t middle = first;
    std::int64_t end = last;
    while (middle < end)
    {
      const std::int64_t open = end - middle;
      while (middle < end && open - (end - middle) < mostAtOnce)
      {
        if (isBelow(items[middle]))
        {
          ++middle;
        }
        else if (!isBelow(items[end - 1]))
        {
          --end;
        }
        else
        {
          std::swap(items[middle++], items[--end]);
        }
      }
      progress.Add(open - (end - middle));
    }
    if (middle > first)
    {
      return middle;
    }
  }
  return last;
}

} // namespace RectifiedTransport

#endif

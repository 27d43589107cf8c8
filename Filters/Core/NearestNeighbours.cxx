// SPDX-License-Identifier: BSD-3-Clause
#include "NearestNeighbours.h"

#include "Pacer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t leafPoints = 8;

struct TreePoint
{
  double X[3];
  std::int64_t Id;
};

// The points [First, Last) in their bounding box. A leaf has no child; else the first child is the
// next box, and Second the other.
struct TreeBox
{
  double Low[3];
  double High[3];
  std::int64_t First;
  std::int64_t Last;
  std::int64_t Second;
};

class PointTree
{
public:
  PointTree(const double* points, std::int64_t count)
    : Points(static_cast<std::size_t>(count))
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      TreePoint& point = this->Points[static_cast<std::size_t>(i)];
      std::copy_n(points + 3 * i, 3, point.X);
      point.Id = i;
    }
  }

  // False if the host wants to stop.
  bool Build(Pacer& pacer)
  {
    struct Task
    {
      std::int64_t First;
      std::int64_t Last;
      std::int64_t Parent; // whose second child it is, -1: none's
    };
    constexpr std::int64_t reported = std::int64_t{ 1 } << 15;
    std::int64_t done = 0;
    pacer.NextSlice(reported);
    std::vector<Task> tasks{ { 0, static_cast<std::int64_t>(this->Points.size()), -1 } };
    while (!tasks.empty())
    {
      const Task task = tasks.back();
      tasks.pop_back();
      if (task.Last - task.First > reported && pacer.ShouldStop())
      {
        return false;
      }
      const auto box = static_cast<std::int64_t>(this->Boxes.size());
      if (task.Parent >= 0)
      {
        this->Boxes[static_cast<std::size_t>(task.Parent)].Second = box;
      }
      this->Boxes.push_back(this->Bound(task.First, task.Last));
      const std::int64_t middle = this->Divide(this->Boxes.back());
      if (middle > task.First)
      {
        tasks.push_back({ middle, task.Last, box });
        tasks.push_back({ task.First, middle, -1 });
        continue;
      }
      done += task.Last - task.First;
      if (done >= reported)
      {
        if (!pacer.EndSlice(done))
        {
          return false;
        }
        done = 0;
        pacer.NextSlice(reported);
      }
    }
    return true;
  }

  const TreePoint& At(std::int64_t place) const
  {
    return this->Points[static_cast<std::size_t>(place)];
  }

  // The least squared distance of a point from another one, or `best` if that is less.
  double Search(const TreePoint& point, double best, std::int64_t box = 0) const
  {
    const TreeBox& at = this->Boxes[static_cast<std::size_t>(box)];
    if (at.Second < 0)
    {
      for (std::int64_t i = at.First; i < at.Last && best > 0.0; ++i)
      {
        const TreePoint& other = this->At(i);
        double squared = 0.0;
        for (int r = 0; r < 3; ++r)
        {
          squared += (other.X[r] - point.X[r]) * (other.X[r] - point.X[r]);
        }
        best = other.Id != point.Id && squared < best ? squared : best;
      }
      return best;
    }
    const std::int64_t children[2] = { box + 1, at.Second };
    const double gaps[2] = { this->Gap(point, children[0]), this->Gap(point, children[1]) };
    const int nearer = gaps[1] < gaps[0] ? 1 : 0;
    for (const int child : { nearer, 1 - nearer })
    {
      if (gaps[child] < best)
      {
        best = this->Search(point, best, children[child]);
      }
    }
    return best;
  }

private:
  TreeBox Bound(std::int64_t first, std::int64_t last) const
  {
    TreeBox box{ {}, {}, first, last, -1 };
    for (int r = 0; r < 3; ++r)
    {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (std::int64_t i = first; i < last; ++i)
      {
        low = std::min(low, this->At(i).X[r]);
        high = std::max(high, this->At(i).X[r]);
      }
      box.Low[r] = low;
      box.High[r] = high;
    }
    return box;
  }

  // Sorts the points of a box into two parts along its widest axis, about the median of a sample.
  // Returns where the second begins; the first point of the box if it stays whole.
  std::int64_t Divide(const TreeBox& box)
  {
    int axis = 0;
    for (int r = 1; r < 3; ++r)
    {
      axis = box.High[r] - box.Low[r] > box.High[axis] - box.Low[axis] ? r : axis;
    }
    const std::int64_t count = box.Last - box.First;
    if (count <= leafPoints || !(box.High[axis] > box.Low[axis]))
    {
      return box.First;
    }
    std::array<double, 63> sample;
    const std::int64_t taken = std::min<std::int64_t>(count, sample.size());
    for (std::int64_t i = 0; i < taken; ++i)
    {
      sample[static_cast<std::size_t>(i)] = this->At(box.First + i * count / taken).X[axis];
    }
    const auto middle = sample.begin() + taken / 2;
    std::nth_element(sample.begin(), middle, sample.begin() + taken);
    // Points on the pivot go up, unless all others are above it too.
    const double pivot = *middle;
    const bool lowest = !(pivot > box.Low[axis]);
    const auto begin = this->Points.begin();
    const auto second =
      std::partition(begin + box.First, begin + box.Last, [=](const TreePoint& point) {
        return lowest ? point.X[axis] <= pivot : point.X[axis] < pivot;
      });
    return second - begin;
  }

  // The squared distance of a point from a box.
  double Gap(const TreePoint& point, std::int64_t box) const
  {
    const TreeBox& at = this->Boxes[static_cast<std::size_t>(box)];
    double squared = 0.0;
    for (int r = 0; r < 3; ++r)
    {
      const double gap = std::max({ at.Low[r] - point.X[r], point.X[r] - at.High[r], 0.0 });
      squared += gap * gap;
    }
    return squared;
  }

  std::vector<TreePoint> Points;
  std::vector<TreeBox> Boxes;
};

} // namespace

bool nearestDistances(const double* points, std::int64_t count, double* distances,
  const Executor& executor, const Monitor& monitor)
{
  Pacer pacer(monitor);
  pacer.BeginStage(0.4, count);
  PointTree tree(points, count);
  if (!tree.Build(pacer))
  {
    return false;
  }
  pacer.BeginStage(1.0, count);
  constexpr std::int64_t grain = 512;
  for (std::int64_t begin = 0; begin < count;)
  {
    const std::int64_t slice =
      std::min(count - begin, pacer.NextSlice(grain * executor.Concurrency()));
    executor.For(slice, grain, [&](std::int64_t first, std::int64_t last) {
      // Neighbours in the tree are neighbours in space.
      for (std::int64_t i = begin + first; i < begin + last; ++i)
      {
        const TreePoint& point = tree.At(i);
        distances[point.Id] =
          std::sqrt(tree.Search(point, std::numeric_limits<double>::infinity()));
      }
    });
    begin += slice;
    if (!pacer.EndSlice(slice))
    {
      return false;
    }
  }
  return true;
}

} // namespace RectifiedTransport

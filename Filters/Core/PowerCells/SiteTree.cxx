// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/SiteTree.h"

#include "Core/Parallel/Progress.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t leafSites = 6;

} // namespace

void SiteTree::Build(ConstPointSpan<2> sites, Progress& progress)
{
  struct Task
  {
    std::int64_t First;
    std::int64_t Last;
    std::int64_t Parent; // of a second child, else -1
  };
  this->Sites.resize(static_cast<std::size_t>(sites.size()));
  this->Boxes.clear();
  for (std::int64_t i = 0; i < sites.size(); ++i)
  {
    this->Sites[static_cast<std::size_t>(i)] = { { sites[i][0], sites[i][1] }, 0.0, i };
  }
  std::vector<Task> tasks{ { 0, sites.size(), -1 } };
  while (!tasks.empty())
  {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto number = static_cast<std::int64_t>(this->Boxes.size());
    if (task.Parent >= 0)
    {
      this->Boxes[static_cast<std::size_t>(task.Parent)].Second = number;
    }
    Box box{ {}, {}, 0.0, task.First, task.Last, -1 };
    this->Bound(box);
    this->Boxes.push_back(box);
    progress.Add(task.Last - task.First);
    if (task.Last - task.First <= leafSites)
    {
      continue;
    }
    const std::size_t axis = box.High[1] - box.Low[1] > box.High[0] - box.Low[0] ? 1 : 0;
    const std::int64_t middle = task.First + (task.Last - task.First) / 2;
    const auto at = [this](std::int64_t i) { return this->Sites.begin() + i; };
    std::nth_element(at(task.First), at(middle), at(task.Last),
      [axis](const WeightedSite& a, const WeightedSite& b) {
        return std::make_pair(a.X[axis], a.Id) < std::make_pair(b.X[axis], b.Id);
      });
    tasks.push_back({ middle, task.Last, number });
    tasks.push_back({ task.First, middle, -1 });
  }
}

void SiteTree::Bound(Box& box) const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  box.Low.fill(infinity);
  box.High.fill(-infinity);
  for (std::int64_t i = box.First; i < box.Last; ++i)
  {
    for (std::size_t a = 0; a < 2; ++a)
    {
      box.Low[a] = std::min(box.Low[a], this->At(i).X[a]);
      box.High[a] = std::max(box.High[a], this->At(i).X[a]);
    }
  }
}

void SiteTree::SetWeights(const double* weights)
{
  for (WeightedSite& site : this->Sites)
  {
    site.Weight = weights[site.Id];
  }
  // Children come after their parents.
  for (auto number = static_cast<std::int64_t>(this->Boxes.size()); number-- > 0;)
  {
    Box& box = this->Boxes[static_cast<std::size_t>(number)];
    if (box.Second >= 0)
    {
      box.LargestWeight =
        std::max(this->BoxAt(number + 1).LargestWeight, this->BoxAt(box.Second).LargestWeight);
      continue;
    }
    box.LargestWeight = -std::numeric_limits<double>::infinity();
    for (std::int64_t i = box.First; i < box.Last; ++i)
    {
      box.LargestWeight = std::max(box.LargestWeight, this->At(i).Weight);
    }
  }
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Quality/NearestNeighbours.h"

#include "Core/Geometry/Trees/ItemTree.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// For so few points, the distances take less time than further boxes.
constexpr std::int64_t leafPoints = 8;

// The tree moves the points themselves, so that those of a leaf are contiguous; Id is the number
// that a point was given with.
struct TreePoint
{
  double X[3];
  std::int64_t Id;
};

// Points between two checks for cancellation.
constexpr std::int64_t mostAtOnce = std::int64_t{ 1 } << 15;

class PointTree
{
public:
  explicit PointTree(std::int64_t count)
    : Points(count)
  {
  }

  // Throws Cancelled.
  void Build(ConstPointSpan<3> points, Progress& progress)
  {
    const std::int64_t count = this->Points.size();
    // Every level of the tree reads each point twice: for the bounds and for the partition.
    std::int64_t passes = 2;
    for (std::int64_t rest = count; rest > leafPoints; rest /= 2)
    {
      passes += 2;
    }
    progress.Expect(passes * count);
    progress.ForEachInOrder(count, mostAtOnce, [&](std::int64_t i) {
      TreePoint& point = this->Points.data()[i];
      std::copy_n(points[i], 3, point.X);
      point.Id = i;
    });
    this->Boxes = makeBoxTree<ItemBox>(
      count,
      [&](std::int64_t first, std::int64_t last) {
        ItemBox made{ {}, first, last, -1 };
        this->Bound(made, progress);
        return made;
      },
      [&](const ItemBox& box) { return this->Divide(box, progress); });
  }

  const TreePoint& At(std::int64_t place) const { return this->Points.data()[place]; }
  // The bounds of all points.
  const ItemBox& Bounds() const { return this->Boxes.front(); }

  // Returns the least squared distance of a point to another one, or `best` if that is less. The
  // nearer child is searched first, so that the other one is often skipped.
  double Search(const TreePoint& point, double best, std::int64_t box = 0) const
  {
    // A leaf is searched point by point; coincident points end the search.
    const ItemBox& at = this->Boxes[static_cast<std::size_t>(box)];
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
    // A child farther than the best distance cannot hold a nearer point.
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

  // The squared distance of a point from a box; infinite or NaN from one without points.
  static double GapTo(const TreePoint& point, const ItemBox& box)
  {
    double squared = 0.0;
    for (int r = 0; r < 3; ++r)
    {
      const double gap = std::max({ box.Low[r] - point.X[r], point.X[r] - box.High[r], 0.0 });
      squared += gap * gap;
    }
    return squared;
  }

private:
  // Extends a box by its points, in pieces that may be cancelled in between.
  void Bound(ItemBox& box, Progress& progress) const
  {
    for (std::int64_t first = box.First; first < box.Last; first += mostAtOnce)
    {
      const std::int64_t last = std::min(first + mostAtOnce, box.Last);
      for (std::int64_t i = first; i < last; ++i)
      {
        box.Add(this->At(i).X);
      }
      progress.Add(last - first);
    }
  }
  // Partitions the points of a box at the median along its widest axis. Returns where the second
  // part begins, or the first point of the box if it is a leaf.
  std::int64_t Divide(const ItemBox& box, Progress& progress)
  {
    const std::size_t axis = box.Longest();
    if (box.Last - box.First <= leafPoints || !(box.Length(axis) > 0.0))
    {
      return box.First;
    }
    return partitionAboutMedian(
      this->Points.data(), box.First, box.Last,
      [axis](const TreePoint& point) { return point.X[axis]; }, progress);
  }
  double Gap(const TreePoint& point, std::int64_t box) const
  {
    return GapTo(point, this->Boxes[static_cast<std::size_t>(box)]);
  }

  LargeBuffer<TreePoint> Points;
  std::vector<ItemBox> Boxes;
};

constexpr std::int64_t neighbourGrain = 512;

constexpr std::size_t mostAsked = std::size_t{ 1 } << 18; // points that a rank asks about at a time

// A point and the least squared distance known so far.
struct Query
{
  double X[3];
  double Best;
};

// Answers the queries of other ranks, whose points have no number here.
std::vector<double> answersTo(
  const std::vector<Query>& queries, const PointTree& tree, Progress& progress)
{
  std::vector<double> answers(queries.size());
  progress.ForEach(
    static_cast<std::int64_t>(queries.size()), neighbourGrain,
    [&](std::int64_t i) {
      const Query& query = queries[static_cast<std::size_t>(i)];
      constexpr std::int64_t notHere = -1;
      // The smaller of the known squared distance and that to the nearest point here.
      answers[static_cast<std::size_t>(i)] =
        tree.Search({ { query.X[0], query.X[1], query.X[2] }, notHere }, query.Best);
    },
    neighbourGrain);
  return answers;
}

// Lowers the squared distances of this rank's points to those from the points of other ranks. The
// other ranks answer in turn, only for points that are nearer to the rank's box than to a known
// neighbour. Collective.
void searchOnRanks(const PointTree& tree, std::int64_t count, double* squared, const Ranks& ranks,
  Progress& progress)
{
  // All ranks know the boxes of all points.
  const std::vector<ItemBox> boxes = gatherValues(ranks, tree.Bounds());
  // One step for each other rank.
  Parts parts(progress, ranks.Count() - 1);
  for (int step = 1; step < ranks.Count(); ++step)
  {
    Progress& part = parts[step - 1];
    // In step s, each rank asks the rank s after it, so that all ranks answer at the same time.
    const auto other = static_cast<std::size_t>((ranks.Own() + step) % ranks.Count());
    // A rank without points has nothing to answer.
    std::int64_t next = boxes[other].Last > 0 ? 0 : count;
    do
    {
      std::vector<std::vector<Query>> queries(boxes.size());
      std::vector<std::int64_t> asked;
      for (; next < count && asked.size() < mostAsked; ++next)
      {
        const TreePoint& point = tree.At(next);
        const double best = squared[point.Id];
        if (PointTree::GapTo(point, boxes[other]) < best)
        {
          // The known distance goes along and prunes the search on the other rank.
          queries[other].push_back({ { point.X[0], point.X[1], point.X[2] }, best });
          asked.push_back(point.Id);
        }
      }
      std::vector<std::vector<double>> answers;
      for (const std::vector<Query>& those : exchangeValues(ranks, std::move(queries)))
      {
        answers.push_back(answersTo(those, tree, part));
      }
      const std::vector<double> found = exchangeValues(ranks, std::move(answers))[other];
      for (std::size_t i = 0; i < asked.size(); ++i)
      {
        squared[asked[i]] = found[i];
      }
    } while (!onAllRanks(ranks, next >= count));
  }
}

} // namespace

// Squared distances are compared, also among ranks; roots are taken once at the end.
void nearestDistances(ConstPointSpan<3> points, double* distances, const Context& context)
{
  const bool areSeveral = context.Group->AreSeveral();
  Progress progress(context);
  Stages stages(progress,
    { { "tree", 4 }, { "search", areSeveral ? 3.0 : 6.0 }, { "ranks", areSeveral ? 3.0 : 0.0 } });
  PointTree tree(points.size());
  tree.Build(points, stages["tree"]);
  stages["search"].ForEach(
    points.size(), neighbourGrain,
    [&](std::int64_t i) {
      // Points that are consecutive in the tree are neighbours in space, so the caches help.
      const TreePoint& point = tree.At(i);
      const double squared = tree.Search(point, std::numeric_limits<double>::infinity());
      distances[point.Id] = areSeveral ? squared : std::sqrt(squared);
    },
    neighbourGrain);
  if (areSeveral)
  {
    searchOnRanks(tree, points.size(), distances, *context.Group, stages["ranks"]);
    for (std::int64_t i = 0; i < points.size(); ++i)
    {
      distances[i] = std::sqrt(distances[i]);
    }
  }
}

} // namespace RectifiedTransport

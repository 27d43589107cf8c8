// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/MergePoints.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Geometry/Trees/Bins.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DisjointSets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// A box of a lattice whose boxes are twice the distance wide.
using Box = std::array<std::int64_t, 3>;

// All bits of the three numbers are mixed, as neighbouring boxes differ only in their last bits.
std::uint64_t hash(const Box& box)
{
  std::uint64_t mixed = 0;
  for (const std::int64_t i : box)
  {
    mixed = mixBits(mixed ^ static_cast<std::uint64_t>(i));
  }
  return mixed;
}

// Clusters of points, each a tree of indices whose root has the lowest coordinates.
class Clusters
{
public:
  Clusters(ConstPointSpan<3> points, double distance, std::int64_t* parents)
    : Points(points)
    , Width(2.0 * distance)
    , Parents(parents)
    , Table(hashTableSize(points.size()), -1)
  {
  }

  // Joins a point with those in its box. The hash table has one point for each box that is not
  // empty.
  void Enter(std::int64_t point)
  {
    std::int64_t& own = this->Table.data()[this->PlaceOf(this->BoxOf(point))];
    if (own < 0)
    {
      own = point;
    }
    this->Join(own, point);
  }

  // Joins a point with those of the seven boxes beside the half of its box that it is in; all
  // points must be entered. Two points nearer than half of a width are in the same box or find each
  // other in this way.
  void JoinBeside(std::int64_t point)
  {
    const Box box = this->BoxOf(point);
    Box side;
    for (std::size_t a = 0; a < 3; ++a)
    {
      // The lower or the upper half of the box along the axis.
      const double place = this->Points[point][a] / this->Width;
      side[a] = place - std::floor(place) < 0.5 ? -1 : 1;
    }
    for (int corner = 1; corner < 8; ++corner)
    {
      // Bit a of `corner` moves along axis a.
      const Box beside{ box[0] + (corner & 1 ? side[0] : 0), box[1] + (corner & 2 ? side[1] : 0),
        box[2] + (corner & 4 ? side[2] : 0) };
      const std::int64_t found = this->Table.data()[this->PlaceOf(beside)];
      if (found >= 0)
      {
        this->Join(found, point);
      }
    }
  }

private:
  // Returns the numbers of a point's box, floor(x / width) along each axis.
  Box BoxOf(std::int64_t point) const
  {
    Box box;
    for (std::size_t a = 0; a < 3; ++a)
    {
      constexpr double most = 0x1p61; // boxes farther away are one
      const double low = std::floor(this->Points[point][a] / this->Width);
      box[a] = static_cast<std::int64_t>(std::max(-most, std::min(low, most)));
    }
    return box;
  }

  // The slot of the table that has a box, or that is free for it. Collisions are resolved by linear
  // probing.
  std::uint64_t PlaceOf(const Box& box) const
  {
    const auto mask = static_cast<std::uint64_t>(this->Table.size() - 1);
    std::uint64_t place = hash(box) & mask;
    while (this->Table.data()[place] >= 0 && this->BoxOf(this->Table.data()[place]) != box)
    {
      place = (place + 1) & mask;
    }
    return place;
  }

  // Joins two clusters; the root is the lower one of the roots.
  void Join(std::int64_t a, std::int64_t b)
  {
    a = rootOf(this->Parents, a);
    b = rootOf(this->Parents, b);
    if (a != b)
    {
      // By coordinates, not numbers: the result does not depend on the order of points.
      const bool isLess = std::lexicographical_compare(
        this->Points[a], this->Points[a] + 3, this->Points[b], this->Points[b] + 3);
      this->Parents[isLess ? b : a] = isLess ? a : b;
    }
  }

  ConstPointSpan<3> Points;
  double Width;
  std::int64_t* Parents;
  LargeBuffer<std::int64_t> Table; // a point of each box; -1 in free slots
};

} // namespace

bool mergeNearPoints(
  ConstPointSpan<3> points, double distance, std::int64_t* firsts, const Context& context)
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const std::int64_t count = points.size();
  Progress progress(context);
  Stages stages(
    progress, { { "equal", 3 }, { "clusters", 2 }, { "neighbours", 4 }, { "firsts", 1 } });
  mergePoints<3>(points, firsts, stages["equal"]);
  // Points with equal coordinates are merged first: only one of them enters the table.
  // These are marked before the clusters change the same array.
  LargeBuffer<bool> isDistinct(count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    isDistinct.data()[i] = firsts[i] == i;
  }
  // Two passes: boxes first, then the boxes beside; all points must be in the table before.
  Clusters clusters(points, distance, firsts);
  const auto forDistinct = [&](Progress& stage, void (Clusters::*step)(std::int64_t)) {
    stage.ForEachInOrder(
      count, grain,
      [&](std::int64_t i) {
        if (isDistinct.data()[i])
        {
          (clusters.*step)(i);
        }
      },
      grain);
  };
  forDistinct(stages["clusters"], &Clusters::Enter);
  forDistinct(stages["neighbours"], &Clusters::JoinBeside);
  // At last each entry is its root instead of a parent.
  bool isMerged = false;
  stages["firsts"].ForEachInOrder(
    count, grain,
    [&](std::int64_t i) {
      firsts[i] = rootOf(firsts, i);
      // Merges of equal coordinates do not count.
      isMerged = isMerged || !std::equal(points[i], points[i] + 3, points[firsts[i]]);
    },
    grain);
  return isMerged;
}

std::vector<RepeatedTriangle> findRepeatedTriangles(
  const TriangleSurface& surface, const Context& context)
{
  using Triple = std::array<std::int64_t, 3>;
  const auto pointsOf = [&surface](std::int64_t triangle) {
    const std::int64_t* ids = surface.Triangles + 3 * triangle;
    Triple points{ ids[0], ids[1], ids[2] };
    // Any order of corners gives the same triple.
    std::sort(points.begin(), points.end());
    return points;
  };
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  Progress progress(context);
  Stages stages(progress, { { "lists", 1 }, { "comparison", 1 } });
  // Triangles are listed by their lowest points, so that few are compared with each other.
  Bins<std::int64_t> triangles;
  triangles.Fill(static_cast<std::size_t>(surface.Points.size()), [&](const auto& add) {
    for (std::int64_t triangle = 0; triangle < surface.NumberOfTriangles; ++triangle)
    {
      const Triple points = pointsOf(triangle);
      // Triangles with a point twice are no triangles.
      if (points[0] != points[1] && points[1] != points[2])
      {
        add(static_cast<std::size_t>(points[0]), triangle);
      }
    }
    stages["lists"].Check();
  });
  std::vector<RepeatedTriangle> repeated;
  std::vector<std::pair<Triple, std::int64_t>> group;
  Progress& comparison = stages["comparison"];
  comparison.ForInOrder(surface.Points.size(), grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t point = begin; point < end; ++point)
    {
      group.clear();
      for (const std::int64_t triangle : triangles[static_cast<std::size_t>(point)])
      {
        group.emplace_back(pointsOf(triangle), triangle);
      }
      std::sort(group.begin(), group.end());
      auto first = group.begin();
      // Equal triples follow each other, the lowest triangle first.
      for (auto next = group.begin(); next != group.end(); ++next)
      {
        // The first triangle of a group of equal triples.
        if (next->first != first->first)
        {
          first = next;
        }
        else if (next != first)
        {
          repeated.push_back({ next->second, first->second });
        }
      }
    }
  });
  std::sort(repeated.begin(), repeated.end(),
    [](const auto& a, const auto& b) { return a.Triangle < b.Triangle; });
  return repeated;
}

} // namespace RectifiedTransport

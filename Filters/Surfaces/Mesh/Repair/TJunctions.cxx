// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/TJunctions.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Trees/ItemTree.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"
#include "Surfaces/Mesh/EdgeSides.h"
#include "Surfaces/Mesh/PlaceOnSide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Leaves of the tree are small: a test of a box costs about as much as that of a point.
constexpr std::int64_t pointsOfLeaf = 8;

// Whether a segment passes through a box with a margin: the intervals of the parameter in the
// slabs of all axes have a common part.
bool passes(const PointBounds& box, const double* from, const double* to, double margin)
{
  double enters = 0.0;
  double leaves = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // The slab of the axis, seen from the segment's begin.
    const double low = box.Low[axis] - margin - from[axis];
    const double high = box.High[axis] + margin - from[axis];
    const double by = to[axis] - from[axis];
    // Parallel to the slab, the segment is within it everywhere or nowhere.
    if (by == 0.0)
    {
      if (low > 0.0 || high < 0.0)
      {
        return false;
      }
      continue;
    }
    // The parameters at which the line enters and leaves the slab.
    enters = std::max(enters, std::min(low / by, high / by));
    leaves = std::min(leaves, std::max(low / by, high / by));
  }
  return enters <= leaves;
}

// A point on an open side, and whether what is cut there has a counterpart.
struct Found
{
  TJunction Junction;
  std::size_t OpenSide;
  bool IsMatched = false;
};

// A part of an open side, from a T-junction or an end to the next one.
struct SidePart
{
  std::int64_t Low;
  std::int64_t High;
  std::int64_t Triangle;
  std::size_t Before; // the T-junction at its begin; noJunction at an end of the side
  std::size_t After;
};
constexpr std::size_t noJunction = std::numeric_limits<std::size_t>::max();

// Candidates are ends of open sides on other open sides (by a tree of boxes). They count if a
// part of the side between two of them is also a part of a side of another triangle.
class TJunctionSearch
{
public:
  TJunctionSearch(ConstPointSpan<3> points, const std::vector<OpenSide>& openSides)
    : Points(points)
    , OpenSides(openSides)
  {
  }

  // Without open sides there are no ends, and nothing is found: closed surfaces cost nothing more.
  std::vector<TJunction> Run(double rounding, Progress& progress)
  {
    std::vector<std::int64_t> ends;
    ends.reserve(2 * this->OpenSides.size());
    for (const OpenSide& side : this->OpenSides)
    {
      ends.push_back(side.From);
      ends.push_back(side.To);
      progress.Add(1);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    progress.Check();
    if (ends.empty())
    {
      return {};
    }
    PointBounds bounds;
    for (const std::int64_t end : ends)
    {
      bounds.Add(this->Points[end]);
    }
    const PlaceOnSide placeOnSide(bounds, rounding);
    // The tree bisects the ends at medians of their coordinates; a segment visits only the boxes
    // that it passes within the tolerance.
    const ItemTree tree(
      std::move(ends), pointsOfLeaf,
      [this](std::int64_t end, PointBounds& box) { box.Add(this->Points[end]); },
      [this](std::int64_t end, std::size_t axis) { return this->Points[end][axis]; }, progress);
    for (std::size_t i = 0; i < this->OpenSides.size(); ++i)
    {
      this->Search(i, placeOnSide, tree, progress);
    }
    this->Match(progress);
    return this->Matched();
  }

private:
  // Appends the points on a side to All, sorted along it. The corners of the side's own triangle
  // are none.
  void Search(
    std::size_t number, const PlaceOnSide& placeOnSide, const ItemTree& tree, Progress& progress)
  {
    const OpenSide& side = this->OpenSides[number];
    const double* from = this->Points[side.From];
    const double* to = this->Points[side.To];
    const std::size_t first = this->All.size();
    std::int64_t visited = 1;
    const auto isNear = [&](const PointBounds& box) {
      return passes(box, from, to, placeOnSide.Tolerance());
    };
    tree.VisitNear(isNear, [&](std::int64_t point) {
      ++visited;
      // The triangle's own corners are not within its side.
      const bool isOwn = point == side.From || point == side.To || point == side.Opposite;
      // 0 says that the point is not on the side.
      const double place = isOwn ? 0.0 : placeOnSide.Of(from, to, this->Points[point]);
      if (place > 0.0)
      {
        this->All.push_back({ { side.Side, point, place }, number });
      }
    });
    // Points at one place along the side are ordered by their numbers, as the tree's order is
    // arbitrary.
    std::sort(this->All.begin() + static_cast<std::ptrdiff_t>(first), this->All.end(),
      [](const Found& a, const Found& b) {
        return std::tie(a.Junction.Place, a.Junction.Point) <
          std::tie(b.Junction.Place, b.Junction.Point);
      });
    progress.Add(visited);
  }

  // Marks the T-junctions at the ends of those parts of sides that two triangles have: after
  // sorting by ends, equal parts are neighbours.
  void Match(Progress& progress)
  {
    std::vector<SidePart> parts;
    parts.reserve(this->OpenSides.size() + this->All.size());
    std::size_t next = 0;
    for (std::size_t number = 0; number < this->OpenSides.size(); ++number)
    {
      const OpenSide& side = this->OpenSides[number];
      std::int64_t begin = side.From;
      std::size_t before = noJunction;
      // One part goes from the last T-junction, or the side's begin, to the next one or the end.
      const auto add = [&](std::int64_t end, std::size_t after) {
        parts.push_back(
          { std::min(begin, end), std::max(begin, end), side.Side / 3, before, after });
        begin = end;
        before = after;
      };
      for (; next < this->All.size() && this->All[next].OpenSide == number; ++next)
      {
        add(this->All[next].Junction.Point, next);
      }
      add(side.To, noJunction);
      progress.Add(1);
    }
    // Ends are ordered low to high, because the two triangles of an edge pass it in opposite
    // directions.
    std::sort(parts.begin(), parts.end(), [](const SidePart& a, const SidePart& b) {
      return std::tie(a.Low, a.High, a.Triangle) < std::tie(b.Low, b.High, b.Triangle);
    });
    progress.Check();
    for (std::size_t i = 1; i < parts.size(); ++i)
    {
      const SidePart& one = parts[i - 1];
      const SidePart& two = parts[i];
      // Two triangles have this part: its ends are true T-junctions.
      if (one.Low == two.Low && one.High == two.High && one.Triangle != two.Triangle)
      {
        for (const std::size_t junction : { one.Before, one.After, two.Before, two.After })
        {
          if (junction != noJunction)
          {
            this->All[junction].IsMatched = true;
          }
        }
      }
      progress.Add(1);
    }
  }

  // The matched T-junctions. A triangle that is nearly a line may have a point on two sides; it
  // counts on the first one.
  std::vector<TJunction> Matched() const
  {
    std::vector<TJunction> junctions;
    std::vector<std::int64_t> before; // on other sides of the triangle, ascending
    std::size_t own = 0;              // the first one of the side
    for (const Found& found : this->All)
    {
      const TJunction& next = found.Junction;
      if (!junctions.empty() && junctions.back().Side != next.Side)
      {
        if (junctions.back().Side / 3 != next.Side / 3)
        {
          before.clear();
          own = junctions.size();
        }
        for (; own < junctions.size(); ++own)
        {
          before.push_back(junctions[own].Point);
        }
        std::sort(before.begin(), before.end());
      }
      if (found.IsMatched && !std::binary_search(before.begin(), before.end(), next.Point))
      {
        junctions.push_back(next);
      }
    }
    return junctions;
  }

  ConstPointSpan<3> Points;
  const std::vector<OpenSide>& OpenSides;
  std::vector<Found> All; // by sides and places
};

// The largest coordinate, and whether all are floats: together they give the rounding.
struct CoordinateRange
{
  void Add(const double* x)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double far = std::abs(x[axis]);
      this->Farthest = std::max(this->Farthest, far);
      // A double that is a float converts there and back unchanged.
      this->AreFloats = this->AreFloats && far <= std::numeric_limits<float>::max() &&
        static_cast<double>(static_cast<float>(x[axis])) == x[axis];
    }
  }
  // The maximum and the conjunction are associative and exact: the same for any number of threads.
  static CoordinateRange Union(const CoordinateRange& one, const CoordinateRange& more)
  {
    return { std::max(one.Farthest, more.Farthest), one.AreFloats && more.AreFloats };
  }
  double Rounding() const
  {
    // As for doubles: four units in the last place of the largest coordinate.
    constexpr double units = 4.0;
    return units * this->Farthest *
      (this->AreFloats ? static_cast<double>(std::numeric_limits<float>::epsilon())
                       : std::numeric_limits<double>::epsilon());
  }

  double Farthest = 0.0;
  bool AreFloats = true;
};

} // namespace

// Only points of triangles count. A stray point far away would raise the tolerance, and one with
// more digits would hide that the others are floats.
double roundingOfCorners(const TriangleSurface& surface, Progress& progress)
{
  // The reduction has fixed ranges of so many triangles.
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  const CoordinateRange all = reduceEach(
    progress, surface.NumberOfTriangles, grain, CoordinateRange(),
    [&](std::int64_t triangle, CoordinateRange& found) {
      for (std::int64_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
      {
        found.Add(surface.Points[surface.Triangles[corner]]);
      }
    },
    CoordinateRange::Union);
  return all.Rounding();
}

double roundingOfPoints(ConstPointSpan<3> points)
{
  CoordinateRange all;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    all.Add(points[i]);
  }
  return all.Rounding();
}

// Merged points and left out triangles are passed as functions, so that the surface is not copied.
std::vector<OpenSide> openSidesOf(
  const TriangleSurface& surface, const SideOptions& options, Progress& progress)
{
  const auto pointOf = [&surface, &options](std::int64_t corner) {
    const std::int64_t point = surface.Triangles[corner];
    return options.Merged ? options.Merged[point] : point;
  };
  // After merging, a triangle may have a point twice: its sides are no edges of a surface.
  const auto isLeftOut = [&pointOf, &options](std::int64_t triangle) {
    const std::int64_t a = pointOf(3 * triangle);
    const std::int64_t b = pointOf(3 * triangle + 1);
    const std::int64_t c = pointOf(3 * triangle + 2);
    return a == b || b == c || c == a || (options.IsLeftOut && options.IsLeftOut[triangle] != 0);
  };
  const std::int64_t count = 3 * surface.NumberOfTriangles;
  LargeBuffer<unsigned char> isOpen(count, 0);
  visitEdges(surface.NumberOfTriangles, surface.Points.size(), pointOf, isLeftOut, progress,
    [&isOpen](const std::int64_t* sides, std::int64_t number) {
      // Visits are on any thread, and each writes to a side of its own.
      isOpen.data()[sides[0]] = number == 1 ? 1 : 0;
    });
  // In the order of the sides, whatever the order in which threads visited the edges.
  std::vector<OpenSide> open;
  for (std::int64_t side = 0; side < count; ++side)
  {
    if (isOpen.data()[side] != 0)
    {
      open.push_back({ side, pointOf(side), pointOf(nextSide(side)), pointOf(lastSide(side)) });
    }
  }
  return open;
}

std::vector<TJunction> findTJunctions(ConstPointSpan<3> points,
  const std::vector<OpenSide>& openSides, double rounding, Progress& progress)
{
  return TJunctionSearch(points, openSides).Run(rounding, progress);
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/Repair/SurfaceRepair.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DegenerateTriangles.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Mesh/Repair/MergePoints.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"
#include "Surfaces/Mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Loops poll for cancellation after so many triangles or points.
constexpr std::int64_t repairGrain = std::int64_t{ 1 } << 13;
constexpr std::int64_t repairAccess = std::int64_t{ 1 } << 16; // units of a first slice

// Compares along each axis, as mergeNearPoints does: no square can underflow.
bool isSamePlace(const double* a, const double* b, double rounding)
{
  return std::abs(a[0] - b[0]) <= rounding && std::abs(a[1] - b[1]) <= rounding &&
    std::abs(a[2] - b[2]) <= rounding;
}

// Returns the longest side and the height over it of a triangle. Coordinates are multiplied by
// `scale`, so that their squares stay within the range of double.
TriangleShape shapeOf(const TriangleSurface& surface, double scale, std::int64_t triangle)
{
  const auto corner = [&](int i) {
    return scale * pointAt(surface.Points, surface.Triangles[3 * triangle + i]);
  };
  return { corner(0), corner(1), corner(2) };
}

} // namespace

// The steps: merge points, keep triangles of three different points, drop repeated ones, orient,
// remove triangles without area by flips, and number what is left.
class SurfaceRepairRun
{
public:
  SurfaceRepairRun(const TriangleSurface& surface, const SurfaceRepairOptions& options)
    : Given(surface)
    , Options(options)
    , Scale(scaleToUnit(largestCoordinate(surface.Points)))
    , Roots(surface.Points.size())
  {
  }

  // The order matters. Merging makes triangles with a point twice, which have no edges and must go
  // first. Repeated triangles make edges of more than two triangles, at which no orientation passes
  // from one to the other, so that they go before it. Flips need an orientation.
  RepairedSurface Run(const Context& context)
  {
    Progress progress(context);
    Stages stages(progress,
      { { "merge", 20 }, { "triangles", 5 }, { "repeated triangles", 5 }, { "orientation", 20 },
        { "flat triangles", 30 }, { "points", 10 }, { "counts", 10 } });
    this->FindRoots(stages["merge"]);
    this->KeepTriangles(stages["triangles"]);
    this->LeaveOutRepeated(stages["repeated triangles"]);
    this->Orient(stages["orientation"]);
    this->RemoveDegenerate(stages["flat triangles"]);
    this->NumberPoints(stages["points"]);
    this->CountRepairs();
    stages["counts"].EndSlice(1);
    return std::move(this->Made);
  }

private:
  std::int64_t RootOf(std::int64_t point) { return rootOf(this->Roots.data(), point); }

  // Finds for each point the first one that it is merged with, as trees.
  // The trees have one root for each cluster, its lowest given point: uniteSets joins to the lower
  // root.
  void FindRoots(Progress& progress)
  {
    const std::int64_t points = this->Given.Points.size();
    std::iota(this->Roots.data(), this->Roots.data() + points, std::int64_t{ 0 });
    if (this->Options.MergesEqualPoints)
    {
      this->MergePlaces(progress);
    }
    progress.ForEachInOrder(
      this->Given.NumberOfTriangles, repairGrain,
      [this](std::int64_t triangle) {
        const std::int64_t* ids = this->Given.Triangles + 3 * triangle;
        for (int i = 0; i < 3; ++i)
        {
          this->MergeEnds(ids[i], ids[(i + 1) % 3]);
        }
      },
      repairAccess);
  }

  // By place, whether an edge joins the points or not.
  // Closes cracks between points at one place, as between faces that have points of their own. With
  // a tolerance it takes the clusters of mergeNearPoints, else only equal coordinates.
  void MergePlaces(const Context& context)
  {
    const std::int64_t points = this->Given.Points.size();
    LargeBuffer<std::int64_t> merged(points);
    if (this->Options.Rounding > 0.0)
    {
      mergeNearPoints(this->Given.Points, this->Options.Rounding, merged.data(), context);
    }
    else
    {
      mergePoints<3>(this->Given.Points, merged.data(), context);
    }
    for (std::int64_t i = 0; i < points; ++i)
    {
      uniteSets(this->Roots.data(), i, merged.data()[i]);
    }
  }

  // The ends of an edge of no length become one point.
  void MergeEnds(std::int64_t a, std::int64_t b)
  {
    if (isSamePlace(this->Given.Points[a], this->Given.Points[b], this->Options.Rounding))
    {
      uniteSets(this->Roots.data(), a, b);
    }
  }

  // Keeps the triangles of three different points.
  // A triangle whose corners have one root has become an edge or a point, without an area. What is
  // left is compacted: triangle t has three entries in Triangles and Corners, one in Origins.
  void KeepTriangles(Progress& progress)
  {
    const std::int64_t count = this->Given.NumberOfTriangles;
    this->Triangles = LargeBuffer<std::int64_t>(3 * count);
    this->Corners = LargeBuffer<std::int64_t>(3 * count);
    this->Origins = LargeBuffer<std::int64_t>(count);
    progress.ForEachInOrder(
      count, repairGrain,
      [this](std::int64_t triangle) {
        const std::int64_t* ids = this->Given.Triangles + 3 * triangle;
        // Triangles have roots as points, and the given points as corners.
        const std::array<std::int64_t, 3> roots{ this->RootOf(ids[0]), this->RootOf(ids[1]),
          this->RootOf(ids[2]) };
        if (roots[0] != roots[1] && roots[1] != roots[2] && roots[2] != roots[0])
        {
          std::copy(roots.begin(), roots.end(), this->Triangles.data() + 3 * this->Count);
          std::copy_n(ids, 3, this->Corners.data() + 3 * this->Count);
          this->Origins.data()[this->Count++] = triangle;
        }
      },
      repairAccess);
  }

  // If triangles have the same points, the first one stays.
  // A face that a file has twice would make all its edges non-manifold.
  void LeaveOutRepeated(const Context& context)
  {
    const std::vector<RepeatedTriangle> repeated = findRepeatedTriangles(this->Left(), context);
    for (const RepeatedTriangle& one : repeated)
    {
      // In numbers of the given triangles.
      this->Made.AllRepeated.push_back(
        { this->Origins.data()[one.Triangle], this->Origins.data()[one.First] });
    }
    auto next = repeated.begin();
    std::int64_t count = 0;
    for (std::int64_t triangle = 0; triangle < this->Count; ++triangle)
    {
      if (next != repeated.end() && next->Triangle == triangle)
      {
        ++next;
        continue;
      }
      this->Move(triangle, count++);
    }
    this->Count = count;
  }

  // Moves a triangle to a place before it, or leaves it where it is.
  void Move(std::int64_t triangle, std::int64_t place)
  {
    std::copy_n(this->Triangles.data() + 3 * triangle, 3, this->Triangles.data() + 3 * place);
    std::copy_n(this->Corners.data() + 3 * triangle, 3, this->Corners.data() + 3 * place);
    this->Origins.data()[place] = this->Origins.data()[triangle];
  }

  TriangleSurface Left() const
  {
    return { this->Given.Points, this->Triangles.data(), this->Count };
  }

  // Flips need neighbours of one orientation.
  void Orient(const Context& context)
  {
    Progress progress(context);
    Stages stages(progress, { { "edges", 7 }, { "orientation", 3 } });
    // An edge is reversed if its two triangles pass it in the same direction.
    const SurfaceEdges edges(this->Left(), stages["edges"]);
    // Most surfaces are oriented already.
    if (edges.Reversed() == 0)
    {
      return;
    }
    LargeBuffer<std::int64_t> oriented(3 * this->Count);
    orientSurface(this->Left(), edges, oriented.data(), stages["orientation"]);
    for (std::int64_t triangle = 0; triangle < this->Count; ++triangle)
    {
      // orientSurface swaps corners 1 and 2 of what it turns; the given corners must follow.
      if (oriented.data()[3 * triangle + 1] != this->Triangles.data()[3 * triangle + 1])
      {
        std::swap(
          this->Triangles.data()[3 * triangle + 1], this->Triangles.data()[3 * triangle + 2]);
        std::swap(this->Corners.data()[3 * triangle + 1], this->Corners.data()[3 * triangle + 2]);
      }
    }
  }

  // Scaled coordinates keep the squares in heights from overflow and underflow.
  void RemoveDegenerate(const Context& context)
  {
    const std::int64_t points = this->Given.Points.size();
    // -1: the point has not lost a triangle.
    this->Nearest = { points, -1 };
    LargeBuffer<double> scaled(3 * points);
    for (std::int64_t i = 0; i < 3 * points; ++i)
    {
      scaled.data()[i] = this->Scale * this->Given.Points.data()[i];
    }
    removeDegenerateTriangles({ { scaled.data(), points }, this->Triangles.data(),
                                this->Corners.data(), this->Origins.data(), this->Count },
      this->Scale * this->Options.Rounding, this->Nearest.data(), context);
  }

  // Numbers the points that are left in their order, and moves the triangles that are together.
  // A removed triangle has -1 as its points. Positions stay those of the given points, not scaled,
  // so that what needs no repair keeps its bits.
  void NumberPoints(Progress& progress)
  {
    const std::int64_t points = this->Given.Points.size();
    LargeBuffer<std::int64_t> numbers(points, -1); // by roots
    std::int64_t triangles = 0;
    for (std::int64_t triangle = 0; triangle < this->Count; ++triangle)
    {
      const std::int64_t* ids = this->Triangles.data() + 3 * triangle;
      if (ids[0] >= 0)
      {
        for (int i = 0; i < 3; ++i)
        {
          numbers.data()[ids[i]] = 0;
        }
        this->Move(triangle, triangles++);
      }
    }
    this->Count = triangles;
    std::int64_t used = 0;
    for (std::int64_t point = 0; point < points; ++point)
    {
      // Numbers ascend with the given points.
      numbers.data()[point] = numbers.data()[point] < 0 ? -1 : used++;
    }
    progress.Check();
    RepairedSurface& made = this->Made;
    // The result owns its arrays: 3 coordinates a point, 3 points and 3 corners a triangle.
    made.Positions = LargeBuffer<double>(3 * used);
    made.FirstGiven = LargeBuffer<std::int64_t>(used);
    made.NewPoints = LargeBuffer<std::int64_t>(points);
    for (std::int64_t point = 0; point < points; ++point)
    {
      const std::int64_t number = numbers.data()[point];
      if (number >= 0)
      {
        std::copy_n(this->Given.Points[point], 3, made.Positions.data() + 3 * number);
        made.FirstGiven.data()[number] = point;
      }
      made.NewPoints.data()[point] = this->NumberOf(point, numbers.data());
    }
    made.Triangles = LargeBuffer<std::int64_t>(3 * triangles);
    made.GivenCorners = LargeBuffer<std::int64_t>(3 * triangles);
    made.Origins = LargeBuffer<std::int64_t>(triangles);
    for (std::int64_t corner = 0; corner < 3 * triangles; ++corner)
    {
      made.Triangles.data()[corner] = numbers.data()[this->Triangles.data()[corner]];
    }
    std::copy_n(this->Corners.data(), 3 * triangles, made.GivenCorners.data());
    std::copy_n(this->Origins.data(), triangles, made.Origins.data());
  }

  // The number of a point's root. A point that only triangles without area have gets the number of
  // the nearest point that is left.
  std::int64_t NumberOf(std::int64_t point, const std::int64_t* numbers)
  {
    constexpr int most = 1000; // two such points may be the nearest of each other
    std::int64_t root = this->RootOf(point);
    for (int i = 0; i < most && numbers[root] < 0 && this->Nearest.data()[root] >= 0; ++i)
    {
      root = this->Nearest.data()[root];
    }
    return numbers[root];
  }

  // A given triangle without any part has no area, unless it is repeated.
  // The array serves twice: first by given points, then by given triangles.
  void CountRepairs()
  {
    const std::int64_t points = this->Given.Points.size();
    const std::int64_t triangles = this->Given.NumberOfTriangles;
    LargeBuffer<unsigned char> isUsed(std::max(points, triangles), 0);
    for (std::int64_t corner = 0; corner < 3 * triangles; ++corner)
    {
      isUsed.data()[this->Given.Triangles[corner]] = 1;
    }
    SurfaceRepairs& counts = this->Made.Counts;
    for (std::int64_t point = 0; point < points; ++point)
    {
      const bool used = isUsed.data()[point] != 0;
      counts.UnusedPoints += used ? 0 : 1;
      // Unused points count once, as unused.
      counts.MergedPoints += used && this->RootOf(point) != point ? 1 : 0;
    }
    std::fill_n(isUsed.data(), triangles, static_cast<unsigned char>(0));
    for (std::int64_t triangle = 0; triangle < this->Count; ++triangle)
    {
      isUsed.data()[this->Origins.data()[triangle]] = 1;
    }
    for (const RepeatedTriangle& one : this->Made.AllRepeated)
    {
      isUsed.data()[one.Triangle] = 1;
    }
    counts.FlatTriangles = std::count(isUsed.data(), isUsed.data() + triangles, 0);
    counts.Repeated = static_cast<std::int64_t>(this->Made.AllRepeated.size());
  }

  const TriangleSurface Given;
  const SurfaceRepairOptions Options;
  const double Scale;
  LargeBuffer<std::int64_t> Roots;     // by points
  LargeBuffer<std::int64_t> Triangles; // three roots a triangle
  LargeBuffer<std::int64_t> Corners;   // three given points a triangle
  LargeBuffer<std::int64_t> Origins;   // given triangles, by triangles
  LargeBuffer<std::int64_t> Nearest; // by roots: the nearest point, in triangles that were left out
  std::int64_t Count = 0;            // number of triangles that are left
  RepairedSurface Made;
};

TriangleSurface RepairedSurface::Surface() const
{
  return { { this->Positions.data(), this->Positions.size() / 3 }, this->Triangles.data(),
    this->Triangles.size() / 3 };
}

double roundingOfDoubles(ConstPointSpan<3> points)
{
  // A few operations on coordinates lose up to about four units in the last place.
  constexpr double units = 4.0;
  return units * std::numeric_limits<double>::epsilon() * largestCoordinate(points);
}

bool needsRepair(const TriangleSurface& surface, double rounding, const Context& context)
{
  Progress progress(context);
  const double scale = scaleToUnit(largestCoordinate(surface.Points));
  LargeBuffer<unsigned char> isUsed(surface.Points.size(), 0);
  bool isFlat = false;
  progress.ForInOrder(
    surface.NumberOfTriangles, repairGrain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t triangle = first; triangle < last && !isFlat; ++triangle)
      {
        for (int i = 0; i < 3; ++i)
        {
          isUsed.data()[surface.Triangles[3 * triangle + i]] = 1;
        }
        // Height and rounding in the same scaled unit.
        isFlat = shapeOf(surface, scale, triangle).Height <= scale * rounding;
      }
    },
    repairAccess);
  return isFlat ||
    std::find(isUsed.data(), isUsed.data() + isUsed.size(), 0) != isUsed.data() + isUsed.size();
}

RepairedSurface repairSurface(
  const TriangleSurface& surface, const SurfaceRepairOptions& options, const Context& context)
{
  return SurfaceRepairRun(surface, options).Run(context);
}

} // namespace RectifiedTransport

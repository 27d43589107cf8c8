// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/CutOpenSurface.h"

#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

// Loops poll for cancellation after so many corners.
constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
constexpr std::int64_t randomAccess = std::int64_t{ 1 } << 16; // units of a first slice

} // namespace

CutOpenSurface::CutOpenSurface(
  const TriangleSurface& given, const SeamOptions& options, Progress& progress)
  : GivenTriangles(given)
{
  Stages stages(progress, { { "seams", 98 }, { "points", 2 } });
  this->Disks.emplace(given, options, stages["seams"]);
  this->NumberPoints(stages["points"]);
}

// Numbers the points: a given point keeps its number for the first place in the cut surface that
// its triangles have; each further place gets a copy after all given points. Copies of a point are
// a linked list, as there are few.
void CutOpenSurface::NumberPoints(Progress& progress)
{
  const std::int64_t given = this->GivenTriangles.Points.size();
  const std::int64_t corners = 3 * this->GivenTriangles.NumberOfTriangles;
  this->CutPoints.assign(static_cast<std::size_t>(given), -1);
  this->Origins.resize(static_cast<std::size_t>(given));
  std::iota(this->Origins.begin(), this->Origins.end(), std::int64_t{ 0 });
  this->NextCopy.assign(static_cast<std::size_t>(given), -1);
  this->Corners = LargeBuffer<std::int64_t>(corners);
  progress.ForEachInOrder(
    corners, grain,
    [&](std::int64_t corner) {
      const std::int64_t point = this->GivenTriangles.Triangles[corner];
      const std::int64_t wanted = this->Disks->CornersOf(corner / 3)[corner % 3];
      std::int64_t& own = this->CutPoints[static_cast<std::size_t>(point)];
      // The first triangle of a point decides which copy it is.
      own = own < 0 ? wanted : own;
      this->Corners.data()[corner] = wanted < 0 ? point : this->CopyAt(point, wanted);
    },
    randomAccess);
  // Points of triangles without area alone get the place of what they were merged with.
  for (std::int64_t point = 0; point < given; ++point)
  {
    std::int64_t& cutPoint = this->CutPoints[static_cast<std::size_t>(point)];
    cutPoint = cutPoint < 0 ? this->Disks->PointOf(point) : cutPoint;
  }
}

// The copy of a given point that is at a point of the cut surface; appended if there is none.
std::int64_t CutOpenSurface::CopyAt(std::int64_t given, std::int64_t cutPoint)
{
  std::int64_t copy = given;
  while (this->PointOf(copy) != cutPoint)
  {
    std::int64_t& next = this->NextCopy[static_cast<std::size_t>(copy)];
    if (next >= 0)
    {
      copy = next;
      continue;
    }
    copy = next = this->NumberOfPoints();
    this->NextCopy.push_back(-1);
    this->CutPoints.push_back(cutPoint);
    this->Origins.push_back(given);
  }
  return copy;
}

// Where the copies of the points at the place of a corner are: the triangle's other corners may be
// merged with this one, and have copies of their own.
std::vector<std::int64_t> CutOpenSurface::PlacesOf(std::int64_t corner) const
{
  const std::int64_t own = this->Disks->PointOf(this->GivenTriangles.Triangles[corner]);
  const std::int64_t first = corner - corner % 3;
  std::vector<std::int64_t> places;
  for (std::int64_t i = first; i < first + 3; ++i)
  {
    const std::int64_t given = this->GivenTriangles.Triangles[i];
    if (this->Disks->PointOf(given) != own)
    {
      continue;
    }
    // The given point and its copies, along the list.
    for (std::int64_t copy = given; copy >= 0;
         copy = this->NextCopy[static_cast<std::size_t>(copy)])
    {
      places.push_back(this->PointOf(copy));
    }
  }
  return places;
}

// For each triangle without area, the three places among all copies with the least longest side in
// the maximum norm of the square. A few copies a point make at most some dozens of triples.
void CutOpenSurface::PlaceDegenerate(ConstPointSpan<2> positions)
{
  const auto distance = [&](std::int64_t a, std::int64_t b) {
    const double* p = positions[a];
    const double* q = positions[b];
    return std::max(std::abs(p[0] - q[0]), std::abs(p[1] - q[1]));
  };
  for (std::int64_t corner = 0; corner < this->Corners.size(); corner += 3)
  {
    const std::int64_t* given = this->GivenTriangles.Triangles + corner;
    const bool isPlaced = std::all_of(
      given, given + 3, [this](std::int64_t point) { return this->Disks->PointOf(point) >= 0; });
    // Triangles with area have their places already.
    if (this->Disks->DiskOf(corner / 3) >= 0 || !isPlaced)
    {
      continue;
    }
    // The triangle then has the copies on one side of a seam, not edges across the square.
    double least = std::numeric_limits<double>::infinity();
    std::array<std::int64_t, 3> nearest{};
    for (const std::int64_t a : this->PlacesOf(corner))
    {
      for (const std::int64_t b : this->PlacesOf(corner + 1))
      {
        for (const std::int64_t c : this->PlacesOf(corner + 2))
        {
          const double longest = std::max({ distance(a, b), distance(b, c), distance(c, a) });
          if (longest < least)
          {
            least = longest;
            nearest = { a, b, c };
          }
        }
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Corners.data()[corner + static_cast<std::int64_t>(i)] =
        // A merged corner may get a place that its own point has no copy at.
        this->CopyAt(given[i], nearest[i]);
    }
  }
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/SeamMesh.h"

#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DisjointSets.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t sidesPolled = std::int64_t{ 1 } << 16; // sides between two polls

} // namespace

SeamMesh::SeamMesh(std::vector<Point<3>> points, std::vector<std::int64_t> triangles,
  std::vector<std::int64_t> origins, const Context& context)
  : Points(std::move(points))
  , Triangles(std::move(triangles))
  , Origins(std::move(origins))
  , Seams(this->Triangles.size(), 0)
  , Degrees(this->Points.size(), 0)
{
  Progress progress(context);
  Stages stages(progress, { { "edges", 6 }, { "corners", 4 } });
  this->Edges = std::make_unique<SurfaceEdges>(
    TriangleSurface{ this->Points, this->Triangles.data(), this->NumberOfTriangles() },
    stages["edges"]);
  Progress& corners = stages["corners"].Expect(2 * this->NumberOfSides());
  // Each corner is named by the side that begins there: a point's list has its triangles.
  this->Corners.Fill(this->Points.size(), [&](const auto& add) {
    for (std::int64_t side = 0; side < this->NumberOfSides(); ++side)
    {
      add(static_cast<std::size_t>(this->From(side)), side);
      corners.Add(1);
    }
  });
  // The boundary is a seam from the beginning.
  for (std::int64_t side = 0; side < this->NumberOfSides(); ++side)
  {
    if (this->Other(side) < 0)
    {
      this->SetSeam(side, true);
    }
  }
}

// The seams of the result are its boundary alone.
SeamMesh SeamMesh::With(const std::vector<Point<3>>& points,
  const std::vector<std::int64_t>& triangles, const std::vector<std::int64_t>& origins,
  const Context& context) const
{
  // The numbers of what was there stay.
  const auto joined = [](auto all, const auto& further) {
    all.insert(all.end(), further.begin(), further.end());
    return all;
  };
  return { joined(this->Points, points), joined(this->Triangles, triangles),
    joined(this->Origins, origins), context };
}

// The unit is that of the points, which CutSurface divides by the largest coordinate.
double SeamMesh::Length(std::int64_t side) const
{
  return std::sqrt(
    squaredDistance(this->Position(this->From(side)), this->Position(this->To(side))));
}

// The length of a path.
double SeamMesh::LengthOf(const std::vector<std::int64_t>& sides) const
{
  return std::accumulate(sides.begin(), sides.end(), 0.0,
    [this](double length, std::int64_t side) { return length + this->Length(side); });
}

// Both sides of an edge have the mark; the degree of a point is the number of seam edges there.
void SeamMesh::SetSeam(std::int64_t side, bool isSeam)
{
  if (this->IsSeam(side) == isSeam)
  {
    return;
  }
  const auto mark = static_cast<unsigned char>(isSeam ? 1 : 0);
  this->Seams[static_cast<std::size_t>(side)] = mark;
  if (this->Other(side) >= 0)
  {
    this->Seams[static_cast<std::size_t>(this->Other(side))] = mark;
  }
  this->Degrees[static_cast<std::size_t>(this->From(side))] += isSeam ? 1 : -1;
  this->Degrees[static_cast<std::size_t>(this->To(side))] += isSeam ? 1 : -1;
}

// All edges of a path at once.
void SeamMesh::SetSeams(const std::vector<std::int64_t>& sides, bool isSeam)
{
  for (const std::int64_t side : sides)
  {
    this->SetSeam(side, isSeam);
  }
}

// Union-find over the corners: those of one point that are on the same side of all seams there join
// across the edges that are no seams. Each tree is a point of the cut. The roots are the lowest
// corners, so that the points' numbers ascend with their first corners.
SeamMesh::Cut SeamMesh::MakeCut(Progress& progress) const
{
  Cut cut;
  std::vector<std::int64_t>& corners = cut.Triangles; // at first trees of corners
  // Corner i is its own tree at first.
  corners.resize(this->Triangles.size());
  std::iota(corners.begin(), corners.end(), std::int64_t{ 0 });
  const auto forSides = [&](const auto& visit) {
    for (std::int64_t side = 0; side < this->NumberOfSides(); ++side)
    {
      visit(side);
      progress.CheckEvery(sidesPolled, side);
    }
  };
  // Each inner edge that is no seam joins the corners at both of its ends, once.
  forSides([&](std::int64_t side) {
    if (this->IsFirst(side) && !this->IsSeam(side))
    {
      joinCorners(this->Triangles.data(), side, this->Other(side),
        [&](std::int64_t a, std::int64_t b) { uniteSets(corners.data(), a, b); });
    }
  });
  // Roots have their numbers before other corners of their trees, as they are the lowest.
  std::vector<std::int64_t> numbers(corners.size());
  forSides([&](std::int64_t side) {
    const std::int64_t root = rootOf(corners.data(), side); // the lowest corner of its tree
    if (root == side)
    {
      // A root is the first corner of its point: the point gets the next number.
      numbers[static_cast<std::size_t>(side)] = static_cast<std::int64_t>(cut.Origins.size());
      cut.Origins.push_back(this->From(side));
    }
    else
    {
      numbers[static_cast<std::size_t>(side)] = numbers[static_cast<std::size_t>(root)];
    }
  });
  cut.Triangles = std::move(numbers);
  return cut;
}

} // namespace RectifiedTransport

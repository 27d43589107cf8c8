// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/DiskMesh.h"

#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"
#include "Surfaces/Mesh/UnitScale.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <string>

namespace RectifiedTransport
{

namespace
{

// Loops poll for cancellation after so many points or triangles.
constexpr std::int64_t diskGrain = std::int64_t{ 1 } << 13;
constexpr std::int64_t randomAccess = std::int64_t{ 1 } << 16; // units of a first slice
constexpr std::size_t fewestBoundaryPoints = 4;                // one for each corner of the square

// Returns a number with its noun, as "1 handle" or "2 handles".
std::string counted(std::int64_t count, const char* one, const char* many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// What is wrong and what helps, as the predicate of a sentence whose subject is the surface.
std::string describe(DiskDefect defect, std::int64_t count, std::int64_t first)
{
  const std::string id = std::to_string(first);
  switch (defect)
  {
    case DiskDefect::PointsNotFinite:
      return "has " + counted(count, "point that is", "points that are") +
        " not finite; the first is point " + id;
    case DiskDefect::NoTriangles:
      return "has no triangles";
    case DiskDefect::TrianglesWithoutArea:
      return "has " + counted(count, "triangle", "triangles") +
        " without area, the first is triangle " + id + "; move their points apart";
    case DiskDefect::UnusedPoints:
      return "has " + counted(count, "point that is", "points that are") +
        " in no triangle, the first is point " + id + "; remove them (Clean does)";
    case DiskDefect::NonManifoldEdges:
      return "has " + counted(count, "non-manifold edge", "non-manifold edges") +
        "; every edge must be one of at most two triangles";
    case DiskDefect::Components:
      return "has " + std::to_string(count) +
        " components that no edges join; it must be one: extract the largest with Connectivity "
        "(Extraction Mode: Extract Largest Region)";
    case DiskDefect::NotOrientable:
      return "is not orientable: it has one side only, as a Moebius strip; cut it open, "
             "for example with Clip";
    case DiskDefect::NonManifoldPoints:
      return "has " + counted(count, "point", "points") +
        " where parts of it touch that no edges join, the first is point " + id +
        "; each part needs a point of its own there";
    case DiskDefect::Closed:
      return "is closed: it has no boundary; cut it open, for example with Clip";
    case DiskDefect::BoundaryLoops:
      return "has " + std::to_string(count) +
        " boundary loops; it must have one: cut it open between them, for example with Clip";
    case DiskDefect::Handles:
      return "has " + counted(count, "handle", "handles") +
        ", as a torus has one; cut it open, for example with Clip, more than once where needed";
    default:
      return "has " + counted(count, "point", "points") +
        " on its boundary; it must have at least 4, one for each corner of the square: Subdivide "
        "adds some";
  }
}

// Returns the area of a triangle in space, |(b - a) x (c - a)| / 2.
double areaOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return 0.5 * (b - a).cross(c - a).norm();
}

} // namespace

NotADisk::NotADisk(DiskDefect defect, std::int64_t count, std::int64_t first)
  : std::runtime_error(describe(defect, count, first))
  , Kind(defect)
  , Number(count)
  , FirstId(first)
{
}

// The order of the checks is that of DiskDefect: each one assumes what those before it have
// checked, and the first that fails is the error. Edges need triangles of three different points,
// which a positive area implies; the boundary walk needs manifold edges and one orientation.
DiskMesh::DiskMesh(const TriangleSurface& surface, const Context& context)
  : Coordinates(3 * surface.Points.size())
  , Triangles(3 * surface.NumberOfTriangles)
  , Shares(surface.NumberOfTriangles)
{
  Progress progress(context);
  Stages stages(progress,
    { { "points", 5 }, { "triangles", 5 }, { "areas", 10 }, { "unused points", 5 }, { "edges", 25 },
      { "orientation", 30 }, { "boundary", 20 } });
  this->CopyPoints(surface.Points, stages["points"]);
  this->CopyTriangles(surface, stages["triangles"]);
  this->FindAreas(stages["areas"]);
  this->RequireUsedPoints(stages["unused points"]);
  this->Sides = std::make_unique<SurfaceEdges>(this->Surface(), stages["edges"]);
  if (this->Sides->NonManifold() > 0)
  {
    throw NotADisk(DiskDefect::NonManifoldEdges, this->Sides->NonManifold());
  }
  this->Orient(stages["orientation"]);
  this->FindBoundary(stages["boundary"]);
}

TriangleSurface DiskMesh::Surface() const
{
  return { { this->Coordinates.data(), this->NumberOfPoints() }, this->Triangles.data(),
    this->NumberOfTriangles() };
}

// Points not finite are counted, not only found, for the message. Coordinates then are from the
// centre of the bounds in units of their longest side, so that areas neither overflow nor vanish.
void DiskMesh::CopyPoints(ConstPointSpan<3> points, Progress& progress)
{
  const std::int64_t count = points.size();
  std::int64_t wrong = 0;
  std::int64_t first = -1;
  Eigen::AlignedBox3d bounds;
  progress.ForEachInOrder(count, diskGrain, [&](std::int64_t i) {
    const Eigen::Map<const Eigen::Vector3d> point(points[i]);
    if (!point.allFinite())
    {
      first = wrong++ == 0 ? i : first;
    }
    bounds.extend(point);
  });
  if (wrong > 0)
  {
    throw NotADisk(DiskDefect::PointsNotFinite, wrong, first);
  }
  const UnitScale scale(bounds);
  this->Length = scale.Unit();
  progress.ForEach(count, diskGrain, [&](std::int64_t i) {
    Eigen::Map<Eigen::Vector3d>(this->Coordinates.data() + 3 * i) =
      scale(Eigen::Map<const Eigen::Vector3d>(points[i]));
  });
}

// Copies three points a triangle. cornerPoint() throws for points that do not exist, so that later
// steps may use the numbers as indices.
void DiskMesh::CopyTriangles(const TriangleSurface& surface, Progress& progress)
{
  if (surface.NumberOfTriangles == 0)
  {
    throw NotADisk(DiskDefect::NoTriangles, 0);
  }
  progress.ForEachInOrder(3 * surface.NumberOfTriangles, diskGrain,
    [&](std::int64_t corner) { this->Triangles.data()[corner] = cornerPoint(surface, corner); });
}

// Areas of triangles, then their shares of the sum.
void DiskMesh::FindAreas(Progress& progress)
{
  std::int64_t wrong = 0;
  std::int64_t first = -1;
  progress.ForEachInOrder(
    this->NumberOfTriangles(), diskGrain,
    [&](std::int64_t t) {
      // The sum is in the order of the triangles, whatever the number of threads.
      const auto corner = [this, t](int i) {
        return Eigen::Map<const Eigen::Vector3d>(
          this->Coordinates.data() + 3 * this->Triangle(t)[i]);
      };
      // |b x c| / 2
      const double area = areaOf(corner(0), corner(1), corner(2));
      this->Shares.data()[t] = area;
      this->TotalArea += area;
      if (!(area > 0.0))
      {
        first = wrong++ == 0 ? t : first;
      }
    },
    randomAccess);
  if (wrong > 0)
  {
    throw NotADisk(DiskDefect::TrianglesWithoutArea, wrong, first);
  }
  progress.ForEach(this->NumberOfTriangles(), diskGrain,
    [this](std::int64_t t) { this->Shares.data()[t] /= this->TotalArea; });
}

// A point in no triangle would have no place in the map.
void DiskMesh::RequireUsedPoints(Progress& progress) const
{
  // By points: 1 if a triangle has the point.
  std::vector<unsigned char> used(static_cast<std::size_t>(this->NumberOfPoints()), 0);
  const std::int64_t* corners = this->Triangles.data();
  progress.ForEachInOrder(
    this->Triangles.size(), diskGrain,
    [&](std::int64_t i) { used[static_cast<std::size_t>(corners[i])] = 1; }, randomAccess);
  const auto unused = std::count(used.begin(), used.end(), 0);
  if (unused > 0)
  {
    throw NotADisk(
      DiskDefect::UnusedPoints, unused, std::find(used.begin(), used.end(), 0) - used.begin());
  }
}

// Turns triangles to the orientation of most of the area. More components than one and surfaces
// with one side are refused.
void DiskMesh::Orient(const Context& context)
{
  // This is read first, because orientSurface writes the triangles in place.
  const std::int64_t reversed = this->Sides->Reversed();
  const SurfaceOrientation found =
    orientSurface(this->Surface(), *this->Sides, this->Triangles.data(), context);
  if (found.Components > 1)
  {
    throw NotADisk(DiskDefect::Components, found.Components);
  }
  if (!found.IsOrientable)
  {
    throw NotADisk(DiskDefect::NotOrientable, 1);
  }
  if (reversed > 0) // their sides have other numbers now
  {
    this->Sides.reset();
    this->Sides = std::make_unique<SurfaceEdges>(this->Surface(), context);
  }
}

// Scales the shares before `first` to 1 - share together, the others to `share`.
// For triangles that close holes: they take part in the map, but their area means nothing, so that
// they get a small share of the square.
void DiskMesh::SetShareFrom(std::int64_t first, double share)
{
  double* const shares = this->Shares.data();
  double* const from = shares + first;
  double* const end = shares + this->Shares.size();
  // Sums of both parts of the shares, to scale each to its new sum.
  const double before = std::accumulate(shares, from, 0.0);
  const double after = std::accumulate(from, end, 0.0);
  std::transform(shares, from, shares, [=](double own) { return own * ((1.0 - share) / before); });
  std::transform(from, end, from, [=](double own) { return own * (share / after); });
}

// Finds the boundary loop, and refuses what is no disk by Euler's formula.
void DiskMesh::FindBoundary(Progress& progress)
{
  const std::int64_t points = this->NumberOfPoints();
  const std::int64_t sides = this->Triangles.size();
  const std::int64_t* from = this->Triangles.data();
  // By points: the side where the fan of triangles about the point begins. On the boundary it is
  // the open side that leaves the point.
  std::vector<std::int64_t> start(static_cast<std::size_t>(points), -1);
  std::vector<std::int64_t> valence(static_cast<std::size_t>(points), 0);
  Stages stages(progress, { { "starts", 1 }, { "pinched points", 2 }, { "loops", 1 } });
  stages["starts"].ForEachInOrder(
    sides, diskGrain,
    [&](std::int64_t side) {
      const auto point = static_cast<std::size_t>(from[side]);
      ++valence[point];
      // An open side takes the place of an inner one.
      if (start[point] < 0 || this->Sides->Other(side) < 0)
      {
        start[point] = side;
      }
    },
    randomAccess);
  Progress& pinches = stages["pinched points"].Expect(points);
  std::int64_t pinched = 0;
  std::int64_t firstPinched = -1;
  // Walks around each point over the shared sides. If the fan has fewer triangles than the point,
  // several fans touch there: a pinched point.
  for (std::int64_t point = 0; point < points; ++point)
  {
    const std::int64_t first = start[static_cast<std::size_t>(point)];
    std::int64_t side = first;
    std::int64_t reached = 0;
    do
    {
      ++reached;
      // The next triangle about the point: across the side that ends there.
      side = this->Sides->Other(lastSide(side));
    } while (side >= 0 && side != first);
    // Triangles of the fan that begins here, against all of the point.
    if (reached != valence[static_cast<std::size_t>(point)])
    {
      firstPinched = pinched++ == 0 ? point : firstPinched;
    }
    pinches.Add(1);
  }
  if (pinched > 0)
  {
    throw NotADisk(DiskDefect::NonManifoldPoints, pinched, firstPinched);
  }

  // Every point has one fan from here on, so that at most one open side leaves it, and the loops
  // are disjoint.
  Progress& search = stages["loops"].Expect(sides);
  std::int64_t loops = 0;
  std::int64_t open = 0;
  std::vector<unsigned char> passed(static_cast<std::size_t>(points), 0);
  // Each open side whose point has not been passed starts a loop; from the end of a side the
  // boundary goes on along the open side of that point.
  for (std::int64_t side = 0; side < sides; ++side)
  {
    search.Add(1);
    open += this->Sides->Other(side) < 0 ? 1 : 0;
    if (this->Sides->Other(side) >= 0 || passed[static_cast<std::size_t>(from[side])])
    {
      continue;
    }
    ++loops;
    this->Loop.clear();
    for (std::int64_t next = side; !passed[static_cast<std::size_t>(from[next])];)
    {
      const std::int64_t point = from[next];
      passed[static_cast<std::size_t>(point)] = 1;
      this->Loop.push_back(point);
      const std::int64_t end = from[nextSide(next)];
      next = start[static_cast<std::size_t>(end)];
    }
  }
  if (loops == 0)
  {
    throw NotADisk(DiskDefect::Closed, 0);
  }
  // Euler's formula: points - edges + triangles = 2 - 2 handles - loops. Inner edges have two
  // sides, open ones have one.
  const std::int64_t edges = (sides + open) / 2;
  // Solved for handles.
  const std::int64_t handles = (2 - loops - (points - edges + sides / 3)) / 2;
  if (loops > 1)
  {
    throw NotADisk(DiskDefect::BoundaryLoops, loops);
  }
  if (handles > 0)
  {
    throw NotADisk(DiskDefect::Handles, handles);
  }
  if (this->Loop.size() < fewestBoundaryPoints)
  {
    throw NotADisk(DiskDefect::FewBoundaryPoints, static_cast<std::int64_t>(this->Loop.size()));
  }
  search.EndSlice(sides);
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/ClosedMesh.h"

#include "Core/Geometry/CoincidentPoints.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/Repair/MergePoints.h"
#include "Surfaces/Mesh/Repair/SplitSurface.h"
#include "Surfaces/Mesh/Repair/TJunctions.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"
#include "Surfaces/Solid/DuplicateTriangles.h"
#include "Surfaces/Solid/OrientedBodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// Points or faces in a slice that looks for cancellation.
constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
// Units of a slice of work with random memory access.
constexpr std::int64_t slow = std::int64_t{ 1 } << 16;

// Adds given triangles; throws std::invalid_argument for points that do not exist.
void addTriangles(const TriangleSurface& surface, Progress& progress, ClosedMesh& mesh)
{
  mesh.Reserve(surface.NumberOfTriangles);
  progress.ForInOrder(
    surface.NumberOfTriangles, grain,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t corner = 3 * first; corner < 3 * last; corner += 3)
      {
        mesh.Add({ cornerPoint(surface, corner), cornerPoint(surface, corner + 1),
          cornerPoint(surface, corner + 2) });
      }
    },
    slow);
}

ClosedMesh::AddFaces facesOf(const TriangleSurface& surface)
{
  return [&surface](ClosedMesh& mesh, Progress& part) { addTriangles(surface, part, mesh); };
}

// The largest coordinate, without its sign.
double farthestIn(const std::array<double, 6>& bounds)
{
  return std::accumulate(bounds.begin(), bounds.end(), 0.0,
    [](double farthest, double x) { return std::max(farthest, std::abs(x)); });
}

// Four units in the last place of the largest coordinate, a power of two; 0 if there is none.
double lastPlacesIn(const std::array<double, 6>& bounds)
{
  const double farthest = farthestIn(bounds);
  // The last place of a double of the exponent e is 2^(e - 52). A power of two lets coordinates be
  // divided by it exactly. Where it would be subnormal, coordinates are not rounded.
  const double places = farthest > 0.0 ? std::ldexp(1.0, std::ilogb(farthest) - 50) : 0.0;
  return places >= std::numeric_limits<double>::min() ? places : 0.0;
}

// How far points are off the sides of triangles that they cut, at most.
double widestGap(
  ConstPointSpan<3> points, const std::int64_t* triangles, const std::vector<TJunction>& junctions)
{
  double widest = 0.0;
  for (const TJunction& junction : junctions)
  {
    const double* a = points[triangles[junction.Side]];
    const double* b = points[triangles[nextSide(junction.Side)]];
    const double* x = points[junction.Point];
    const auto off = [&](std::size_t axis) {
      return x[axis] - a[axis] - junction.Place * (b[axis] - a[axis]);
    };
    widest = std::max(widest, std::hypot(off(0), off(1), off(2)));
  }
  return widest;
}

} // namespace

// Distances grow with the bounds: what rounding leaves is relative to coordinates. Four units of
// the last place of float cover a few operations on float coordinates.
ClosingDistances::ClosingDistances(const std::array<double, 6>& bounds, bool areFloats)
{
  constexpr double units = 4.0;
  const double longest =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  const double near = ClosedMesh::NearDistance * longest;
  this->Near = { std::isfinite(near) ? near : 0.0,
    areFloats ? units * farthestIn(bounds) * std::numeric_limits<float>::epsilon() : 0.0 };
  // Each is ten times the one before: the first that closes the surface bends it least. A gap that
  // is wider than the last one counts as a hole.
  this->Gaps = { 1e-5 * longest, 1e-4 * longest, 1e-3 * longest, 1e-2 * longest };
}

// Firsts has for each point the first one with equal coordinates.
ClosedMesh::ClosedMesh(LargeBuffer<double> coordinates, const Context& context)
  : Coordinates(std::move(coordinates))
{
  const ConstPointSpan<3> points = this->Points();
  this->Firsts = LargeBuffer<std::int64_t>(points.size());
  mergePoints<3>(points, this->Firsts.data(), context);
}

// Tries, from the least change to the largest: faces as they are; points within rounding of double
// merged, or T-junctions within it cut; the same for float; then T-junctions that gape by 1e-5 to
// 1e-2 of the longest side. The text is about the mesh before distances of float, which the user
// knows.
std::string ClosedMesh::Close(
  const AddFaces& add, const ClosingDistances& distances, const Context& context)
{
  Progress progress(context);
  Stages stages(
    progress, { { "faces", 60 }, { "rounding", 20 }, { "float rounding", 8 }, { "gaps", 12 } });
  std::string problem = this->Fill(add, stages["faces"]);
  // Without triangles, corners that differ by rounding may be the reason.
  if (problem.empty() || this->CloseNear(add, distances.Near[0], stages["rounding"]))
  {
    return {};
  }
  problem = this->NumberOpen + this->NumberNonManifold > 0 ? this->Openness() : problem;
  if (this->CloseNear(add, distances.Near[1], stages["float rounding"]))
  {
    return {};
  }
  Parts gaps(stages["gaps"], static_cast<std::int64_t>(distances.Gaps.size()));
  for (std::size_t i = 0; i < distances.Gaps.size() && !this->ClosedGaps; ++i)
  {
    // A try that fails leaves the mesh unchanged, so that the next one begins from the same
    // triangles.
    this->ClosedGaps = this->CloseWithin(distances.Gaps[i], gaps[static_cast<std::int64_t>(i)]);
  }
  return this->ClosedGaps ? std::string() : problem;
}

std::string ClosedMesh::Close(
  const TriangleSurface& surface, const ClosingDistances& distances, const Context& context)
{
  return this->Close(facesOf(surface), distances, context);
}

// Adds the faces and counts edges. Returns what is wrong, as the predicate of a sentence; empty if
// nothing is.
std::string ClosedMesh::Fill(const AddFaces& add, Progress& progress)
{
  Stages stages(progress, { { "triangles", 1 }, { "edges", 1 } });
  add(*this, stages["triangles"]);
  // This is read before edges are counted, because pairs of opposite triangles may cancel all.
  const bool hasTriangles = this->NumberOfTriangles > 0;
  this->CountEdges(stages["edges"]);
  if (!hasTriangles)
  {
    return "has " + std::to_string(this->Points().size()) +
      " points and no polygon of three different ones; a solid needs a closed surface";
  }
  if (this->NumberOfTriangles == 0)
  {
    return "has each polygon twice, in opposite directions, so that nothing is inside; keep one of "
           "each";
  }
  return this->Closed ? std::string() : this->Openness();
}

// Merges points nearer than a distance, and cuts triangles at T-junctions within it; returns
// whether that closes the surface.
bool ClosedMesh::CloseNear(const AddFaces& add, double distance, Progress& progress)
{
  Stages stages(progress, { { "points", 3 }, { "faces", 4 }, { "T-junctions", 3 } });
  if (distance > 0.0 && this->MergeNear(distance, stages["points"]))
  {
    this->Fill(add, stages["faces"]);
    if (this->NumberOfTriangles == 0 || this->Closed)
    {
      return this->NumberOfTriangles > 0;
    }
  }
  return this->CloseWithin(distance, stages["T-junctions"]);
}

// Without triangles nothing closes the surface. Bounds near the largest double may have an infinite
// side, and then no distance.
bool ClosedMesh::CloseWithin(double distance, Progress& progress)
{
  return this->NumberOfTriangles > 0 && distance > 0.0 && std::isfinite(distance) &&
    this->CloseTJunctions(distance, progress);
}

// Tells users how many edges are wrong, and which filters close a surface.
std::string ClosedMesh::Openness() const
{
  const std::int64_t open = this->NumberOpen;
  const std::int64_t nonManifold = this->NumberNonManifold;
  std::ostringstream message;
  message << "is not closed: it has " << open << (open == 1 ? " open edge" : " open edges")
          << " and " << nonManifold
          << (nonManifold == 1 ? " non-manifold edge" : " non-manifold edges")
          << "; every edge must be one of two triangles, or of another even number";
  if (open > 0)
  {
    message
      << ". To close it: Clip Closed Surface in place of Clip, or with a plane that cuts off "
         "the rim of the hole; Capping of sources and extrusions; Clean with a Tolerance where "
         "seams gape, after Subdivide if one of their sides has fewer points; vtkFillHolesFilter "
         "in a Programmable Filter; or Delaunay 3D and Extract Surface for the convex hull";
  }
  return message.str();
}

// x' = (x - origin) / spacing along each axis; cells are cubes, so that one spacing serves all.
void ClosedMesh::MoveToCells(
  const ImageGrid& grid, const std::array<double, 6>& bounds, const Context& context)
{
  Progress progress(context);
  double* points = this->Coordinates.data();
  const double spacing = grid.Spacing()[0];
  const Eigen::Vector3d corner = grid.Origin();
  const double rounding = lastPlacesIn(bounds);
  progress.For(this->Points().size(), grain, [=](std::int64_t first, std::int64_t last) {
    // i runs over coordinates: axis i % 3 of point i / 3.
    for (std::int64_t i = 3 * first; i < 3 * last; ++i)
    {
      const double x = points[i];
      const double rounded = rounding > 0.0 ? std::nearbyint(x / rounding) * rounding : x;
      points[i] = (rounded - corner[static_cast<Eigen::Index>(i % 3)]) / spacing;
    }
  });
}

// The triangles are forgotten, because they have points that may be merged further; the caller adds
// them again.
bool ClosedMesh::MergeNear(double distance, const Context& context)
{
  const ConstPointSpan<3> points = this->Points();
  LargeBuffer<std::int64_t> firsts(points.size());
  if (!mergeNearPoints(points, distance, firsts.data(), context))
  {
    return false;
  }
  this->Firsts = std::move(firsts);
  this->NumberOfTriangles = 0;
  this->NumberOfTJunctions = 0;
  this->Edges.reset();
  this->Closed = false;
  return true;
}

// Allocates three points a triangle; Add() does not check that there is room.
void ClosedMesh::Reserve(std::int64_t triangles)
{
  this->Triangles = LargeBuffer<std::int64_t>(3 * triangles);
}

// Merged corners make a triangle an edge or a point, which encloses nothing.
void ClosedMesh::Add(const std::array<std::int64_t, 3>& corners)
{
  const std::int64_t a = this->FirstOf(corners[0]);
  const std::int64_t b = this->FirstOf(corners[1]);
  const std::int64_t c = this->FirstOf(corners[2]);
  if (a != b && b != c && c != a)
  {
    std::int64_t* triangle = this->Triangles.data() + 3 * this->NumberOfTriangles++;
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
  }
}

// Repeated triangles are looked for only if edges have more than two triangles, as theirs do.
void ClosedMesh::CountEdges(const Context& context)
{
  this->Firsts = {}; // its memory is needed now
  Progress progress(context);
  Stages stages(progress, { { "edges", 1 }, { "repeated triangles", 1 } });
  this->CountEdgesAlone(stages["edges"]);
  if (this->Edges->NonManifold() > 0)
  {
    this->DropRepeated(stages["repeated triangles"]);
  }
  this->Closed = this->NumberOpen == 0 && this->NumberNonManifold == 0;
}

// An edge of four or another even number of triangles is closed, as where two cubes touch.
void ClosedMesh::CountEdgesAlone(const Context& context)
{
  this->Edges.reset(); // frees its memory first
  this->Edges = std::make_unique<SurfaceEdges>(this->Surface(), context);
  this->NumberOpen = this->Edges->Open();
  this->NumberNonManifold = this->Edges->Odd();
}

// Drops repeated triangles in the first of the three ways that leaves no edge open, and in the
// first of all if none does.
void ClosedMesh::DropRepeated(const Context& context)
{
  const std::array<std::vector<std::int64_t>, 3> ways = findDropped(this->Surface(), *this->Edges);
  // The third way drops all but one of each group; if it drops none, nothing is repeated.
  if (ways.back().empty())
  {
    return;
  }
  Progress progress(context);
  Parts tries(progress, static_cast<std::int64_t>(ways.size()) + 1);
  std::int64_t next = 0;
  const std::int64_t number = this->NumberOfTriangles;
  // Each way begins from a copy of all triangles, as dropTriangles overwrites the mesh's.
  LargeBuffer<std::int64_t> all(3 * number);
  std::copy_n(this->Triangles.data(), 3 * number, all.data());
  const auto drop = [&](const std::vector<std::int64_t>& dropped) {
    this->NumberOfTriangles = dropTriangles(
      { this->Surface().Points, all.data(), number }, dropped, this->Triangles.data());
    this->CountEdgesAlone(tries[next++]);
    return this->NumberOpen + this->NumberNonManifold == 0;
  };
  for (const std::vector<std::int64_t>& way : ways)
  {
    if (drop(way))
    {
      return;
    }
  }
  drop(ways.front());
}

// Splits triangles at T-junctions, counts edges again, and takes the split back if edges are still
// open.
bool ClosedMesh::CloseTJunctions(double distance, const Context& context)
{
  Progress progress(context);
  Stages stages(progress,
    { { "open sides", 30 }, { "search", 20 }, { "split", 10 }, { "edges", 20 }, { "undo", 20 } });
  std::vector<TJunction> junctions;
  if (this->NumberOpen > 0)
  {
    const TriangleSurface surface = this->Surface();
    const std::vector<OpenSide> open = openSidesOf(surface, {}, stages["open sides"]);
    junctions = findTJunctions(surface.Points, open, distance, stages["search"]);
  }
  if (junctions.empty())
  {
    progress.EndSlice(1);
    return this->Closed;
  }
  const SplitSurface split(this->Surface(), junctions, stages["split"]);
  LargeBuffer<std::int64_t> before = std::move(this->Triangles);
  const std::int64_t numberBefore = this->NumberOfTriangles;
  this->Reserve(split.NumberOfTriangles());
  this->NumberOfTriangles = split.NumberOfTriangles();
  std::copy_n(split.Triangles(), 3 * this->NumberOfTriangles, this->Triangles.data());
  this->CountEdges(stages["edges"]);
  if (this->Closed)
  {
    this->NumberOfTJunctions = split.NumberOfTJunctions();
    this->Gap = widestGap(this->Points(), before.data(), junctions);
    progress.EndSlice(1);
    return true;
  }
  // Undo: the mesh is as it was.
  this->Triangles = std::move(before);
  this->NumberOfTriangles = numberBefore;
  this->CountEdges(stages["undo"]);
  return false;
}

// Turns the triangles in place, after which the edges are not theirs any more. Later calls return
// the first answer.
bool ClosedMesh::Orient(const Context& context)
{
  if (this->Closed && this->Edges)
  {
    OrientedBodies found =
      orientBodies(this->Surface(), *this->Edges, this->Triangles.data(), context);
    this->Oriented = found.IsOrientable;
    this->Bodies = std::move(found.Bodies);
    this->Edges.reset(); // no longer of these triangles
  }
  return this->Oriented;
}

void ClosedMesh::OrientOpen(const Context& context)
{
  if (!this->Edges)
  {
    return;
  }
  std::int64_t* triangles = this->Triangles.data();
  orientSurface(this->Surface(), *this->Edges, triangles, context);
  this->Edges.reset(); // no longer of these triangles
  const TriangleSurface surface = this->Surface();
  PointBounds bounds;
  for (std::int64_t i = 0; i < 3 * this->NumberOfTriangles; ++i)
  {
    bounds.Add(surface.Points[triangles[i]]);
  }
  const Point<3> middle = 0.5 * (bounds.Low + bounds.High);
  double volume = 0.0;
  for (std::int64_t i = 0; i < this->NumberOfTriangles; ++i)
  {
    const auto corner = [&](std::int64_t k) {
      return pointAt(surface.Points, triangles[3 * i + k]) - middle;
    };
    volume += dot(corner(0), cross(corner(1), corner(2)));
  }
  for (std::int64_t i = 0; volume < 0.0 && i < this->NumberOfTriangles; ++i)
  {
    std::swap(triangles[3 * i + 1], triangles[3 * i + 2]);
  }
}

SolidSurface ClosedMesh::Solid() const
{
  return { this->Surface(), this->Bodies.data() };
}

TriangleSurface ClosedMesh::Surface() const
{
  return { { this->Coordinates.data(), this->Coordinates.size() / 3 }, this->Triangles.data(),
    this->NumberOfTriangles };
}

} // namespace RectifiedTransport

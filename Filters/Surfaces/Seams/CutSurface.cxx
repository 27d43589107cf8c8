// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/CutSurface.h"

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Vectors.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Mesh/Repair/SurfaceRepair.h"
#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"
#include "Surfaces/Mesh/TriangleShape.h"
#include "Surfaces/Seams/CutOpenComponent.h"
#include "Surfaces/Seams/HoleFans.h"
#include "Surfaces/Seams/SeamMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// The components of a surface, parted where they touch. Triangles part at edges of more than two
// triangles, and where they share only a point. Then all edges have at most two triangles, and
// those about a point form one fan.
class SurfaceParts
{
public:
  // The corners of a triangle are three different points. Memory: 24 bytes a triangle, and
  // temporarily 90 a triangle. On one thread. Throws std::bad_alloc and Cancelled.
  explicit SurfaceParts(const TriangleSurface& surface, const Context& context = Context())
    : Points(3 * surface.NumberOfTriangles)
  {
    const std::int64_t sides = this->Points.size();
    Progress progress(context);
    Stages stages(
      progress, { { "edges", 3 }, { "points", 2 }, { "edges of parts", 3 }, { "components", 2 } });
    {
      const SurfaceEdges edges(surface, stages["edges"]);
      this->Parted = edges.NonManifold();
      LargeBuffer<std::int64_t> trees(sides);
      std::iota(trees.data(), trees.data() + sides, std::int64_t{ 0 });
      // Corners are joined across edges of two triangles only (Other() is -1 at others). The
      // corners of a tree are one fan, which becomes a point: the surface parts where fans meet.
      Progress& points = stages["points"].Expect(2 * sides);
      for (std::int64_t side = 0; side < sides; ++side)
      {
        if (edges.Other(side) > side)
        {
          joinCorners(surface.Triangles, side, edges.Other(side),
            [&](std::int64_t a, std::int64_t b) { uniteSets(trees.data(), a, b); });
        }
        points.Add(1);
      }
      for (std::int64_t side = 0; side < sides; ++side)
      {
        const std::int64_t root = rootOf(trees.data(), side); // the lowest corner
        this->Points.data()[side] = root == side ? this->Count++ : this->Points.data()[root];
        points.Add(1);
      }
    }
    // The points of parts are other ones than before, so that some triangles at an edge that was
    // parted may still share both of its points. Pairs of these are found by the edges of the
    // parted surface.
    LargeBuffer<double> places(3 * this->Count);
    progress.Check();
    for (std::int64_t side = 0; side < sides; ++side)
    {
      std::copy_n(
        surface.Points[surface.Triangles[side]], 3, places.data() + 3 * this->Points.data()[side]);
    }
    progress.Check();
    const TriangleSurface parted{ { places.data(), this->Count }, this->Points.data(),
      surface.NumberOfTriangles };
    const SurfaceEdges edges(parted, stages["edges of parts"]);
    LargeBuffer<signed char> signs(surface.NumberOfTriangles);
    Progress& components = stages["components"].Expect(surface.NumberOfTriangles);
    visitPatches(parted, edges, signs.data(), components, [this](const SurfacePatch& patch) {
      this->Triangles.emplace_back(patch.Triangles, patch.Triangles + patch.Count);
      std::sort(this->Triangles.back().begin(), this->Triangles.back().end());
    });
  }

  // The points of the parts that the corners of the triangles have, three a triangle; the numbers
  // ascend with their first corners.
  const std::int64_t* Corners() const { return this->Points.data(); }
  std::int64_t NumberOfPoints() const { return this->Count; }
  // The triangles of each component, ascending, in the order of their first triangles.
  const std::vector<std::vector<std::int64_t>>& Components() const { return this->Triangles; }
  std::int64_t NonManifoldEdges() const { return this->Parted; }

private:
  LargeBuffer<std::int64_t> Points; // three a triangle
  std::int64_t Count = 0;           // number of points
  std::int64_t Parted = 0;          // number of non-manifold edges
  std::vector<std::vector<std::int64_t>> Triangles;
};

constexpr std::int64_t trianglesPolled = std::int64_t{ 1 } << 14; // triangles between two polls

// All defects that no repair can mend, as NotADisk or std::invalid_argument.
void requireTriangles(const TriangleSurface& surface)
{
  const double* const begin = surface.Points.data();
  const double* const end = begin + 3 * surface.Points.size();
  // A point's number is a third of its first coordinate's.
  const double* wrong = std::find_if(begin, end, [](double x) { return !std::isfinite(x); });
  if (wrong < end)
  {
    throw NotADisk(DiskDefect::PointsNotFinite, 1, (wrong - begin) / 3);
  }
  if (surface.NumberOfTriangles == 0)
  {
    throw NotADisk(DiskDefect::NoTriangles, 0);
  }
  for (std::int64_t corner = 0; corner < 3 * surface.NumberOfTriangles; ++corner)
  {
    cornerPoint(surface, corner);
  }
}

// Merges with the smallest rounding that leaves no more edges open than a larger one.
RepairedSurface repaired(const TriangleSurface& surface, double rounding, Progress& progress)
{
  // Open edges measure how well a rounding merges: a crack has some on both sides.
  const auto openEdges = [](const RepairedSurface& made, Progress& stage) {
    return SurfaceEdges(made.Surface(), stage).Open();
  };
  const double least = roundingOfDoubles(surface.Points);
  // Shares of the progress that the second attempt takes.
  const double larger = rounding > least ? 1.0 : 0.0;
  Stages stages(progress,
    { { "least rounding", 50 }, { "its edges", 15.0 * larger }, { "rounding", 18.0 * larger },
      { "edges", 5.0 * larger } });
  RepairedSurface made = repairSurface(surface, { least, true }, stages["least rounding"]);
  if (rounding > least)
  {
    const std::int64_t open = openEdges(made, stages["its edges"]);
    if (open > 0)
    {
      RepairedSurface other = repairSurface(surface, { rounding, true }, stages["rounding"]);
      if (openEdges(other, stages["edges"]) < open)
      {
        return other;
      }
    }
  }
  return made;
}

} // namespace

// The steps: repair (merge points, drop repeated and flat triangles), part at non-manifold edges,
// then for each component choose seams, cut, and number the points of the disk after those of the
// disks before.
class SurfaceCutting
{
public:
  SurfaceCutting(const TriangleSurface& surface, CutSurface& made)
    : Surface(surface)
    , Made(made)
  {
  }

  // The result is written in the numbers of the given triangles and points, through the repair's
  // and the parts' numbers.
  void Run(const SeamOptions& options, const Context& context)
  {
    requireTriangles(this->Surface);
    Progress progress(context);
    Stages stages(progress, { { "repair", 30 }, { "parts", 5 }, { "cuts", 65 } });
    const RepairedSurface repair = repaired(this->Surface, options.Rounding, stages["repair"]);
    this->KeepTriangles(repair, stages["repair"]);
    const TriangleSurface kept{ repair.Surface().Points, this->Triangles.data(),
      static_cast<std::int64_t>(this->Repaired.size()) };
    if (kept.NumberOfTriangles == 0)
    {
      throw NotADisk(DiskDefect::TrianglesWithoutArea, this->Surface.NumberOfTriangles, 0);
    }
    const SurfaceParts parts(kept, stages["parts"]);
    SurfaceCuts& counts = this->Made.Counts;
    counts.UnusedPoints = repair.Repairs().UnusedPoints;
    counts.MergedPoints = repair.Repairs().MergedPoints;
    counts.Repeated = repair.Repairs().Repeated;
    counts.NonManifoldEdges = parts.NonManifoldEdges();

    this->Prepare(repair);
    // A component's share of the progress is its number of triangles.
    std::vector<double> sizes;
    for (const std::vector<std::int64_t>& component : parts.Components())
    {
      sizes.push_back(static_cast<double>(component.size()));
    }
    Parts cuts(stages["cuts"], sizes);
    std::int64_t number = 0;
    for (const std::vector<std::int64_t>& component : parts.Components())
    {
      this->CutOpen({ kept, parts, component, repair }, options, cuts[number++]);
    }
    progress.EndSlice(1);
    // This comes after all components, because the triangle that a repeated one lies on may be in
    // any.
    this->PlaceRepeated(repair);
    for (std::int64_t point = 0; point < this->Surface.Points.size(); ++point)
    {
      const std::int64_t place = repair.NewPoint(point);
      this->Made.PointsOf.data()[point] = place < 0 ? -1 : this->FirstCopies.data()[place];
    }
    // What is in no disk then has no area: removed by the repair or not kept after it.
    counts.FlatTriangles = std::count(
      this->Made.DisksOf.data(), this->Made.DisksOf.data() + this->Made.DisksOf.size(), -1);
  }

private:
  // Keeps the triangles with an area. Coordinates are divided by the largest one, so that heights
  // near the ends of the range of double neither overflow nor vanish.
  void KeepTriangles(const RepairedSurface& repair, Progress& progress)
  {
    const TriangleSurface surface = repair.Surface();
    this->Unit = largestCoordinate(surface.Points);
    for (std::int64_t triangle = 0; triangle < surface.NumberOfTriangles; ++triangle)
    {
      progress.CheckEvery(trianglesPolled, triangle);
      const std::int64_t* ids = surface.Triangles + 3 * triangle;
      const auto at = [&](int i) { return pointAt(surface.Points, ids[i]) / this->Unit; };
      // The repair leaves some triangles without area, where removing them would join edges.
      if (TriangleShape(at(0), at(1), at(2)).Height > 0.0)
      {
        this->Repaired.push_back(triangle);
        this->Triangles.insert(this->Triangles.end(), ids, ids + 3);
      }
    }
  }

  // -1 marks triangles, corners and points that no disk has.
  void Prepare(const RepairedSurface& repair)
  {
    const std::int64_t triangles = this->Surface.NumberOfTriangles;
    // The result is by given triangles, their corners and given points; FirstCopies is by points of
    // the repaired surface.
    this->Made.DisksOf = { triangles, -1 };
    this->Made.Corners = { 3 * triangles, -1 };
    this->Made.PointsOf = LargeBuffer<std::int64_t>(this->Surface.Points.size());
    this->Made.Turned = { triangles, 0 };
    this->FirstCopies = { repair.Surface().Points.size(), -1 };
  }

  // What CutOpen needs of a component.
  struct Component
  {
    const TriangleSurface& Kept;
    const SurfaceParts& Parts;
    const std::vector<std::int64_t>& Triangles; // numbers of those kept
    const RepairedSurface& Repair;
  };

  // Opens a component, and writes where its triangles' corners are in the cut surface.
  void CutOpen(const Component& component, const SeamOptions& options, Progress& progress)
  {
    Stages stages(progress, { { "mesh", 1 }, { "seams", 9 } });
    SeamMesh mesh = this->MeshOf(component, stages["mesh"]);
    CutOpenDisk opened = cutComponent(mesh, static_cast<std::int64_t>(component.Triangles.size()),
      options.MaximumRounds, stages["seams"]);
    CutDisk& disk = opened.Disk;
    // Points of disks are numbered one disk after the other.
    disk.FirstPoint = this->NumberOfPoints;
    const auto number = static_cast<std::int64_t>(this->Made.AllDisks.size());
    for (std::size_t t = 0; t < component.Triangles.size(); ++t)
    {
      const std::int64_t kept = component.Triangles[t];
      progress.CheckEvery(trianglesPolled, static_cast<std::int64_t>(t));
      const std::int64_t repaired = this->Repaired[static_cast<std::size_t>(kept)];
      const std::int64_t given = component.Repair.GivenTriangle(repaired);
      this->Made.DisksOf.data()[given] = number;
      this->Made.Turned.data()[given] = this->IsTurned(given, component.Kept.Points, opened,
        static_cast<std::int64_t>(t), component.Kept.Triangles + 3 * kept);
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto corner = static_cast<std::int64_t>(i);
        const std::int64_t point = disk.FirstPoint + opened.Cut.Triangles[3 * t + i];
        // The first copy of a point of the repaired surface stands for it in PointOf().
        std::int64_t& first = this->FirstCopies.data()[component.Kept.Triangles[3 * kept + corner]];
        first = first < 0 ? point : first;
        // A given triangle may have been split, and a corner may be a merged point: the repair
        // tells which given point each corner is, and the corner with that point gets its place.
        const std::int64_t label = component.Repair.Corners(repaired)[corner];
        for (std::int64_t j = 3 * given; j < 3 * given + 3; ++j)
        {
          if (this->Surface.Triangles[j] == label)
          {
            this->Made.Corners.data()[j] = point;
          }
        }
      }
    }
    this->NumberOfPoints += disk.NumberOfPoints;
    this->Made.AllDisks.push_back(std::move(disk));
  }

  // Repeated triangles get the places of the triangles before that have the same points.
  void PlaceRepeated(const RepairedSurface& repair)
  {
    this->Made.AllRepeated = repair.Repeated();
    for (const auto& [triangle, first] : repair.Repeated())
    {
      this->Made.DisksOf.data()[triangle] = this->Made.DisksOf.data()[first];
      for (std::int64_t own = 3 * triangle; own < 3 * triangle + 3; ++own)
      {
        for (std::int64_t other = 3 * first; other < 3 * first + 3; ++other)
        {
          if (repair.NewPoint(this->Surface.Triangles[own]) ==
            repair.NewPoint(this->Surface.Triangles[other]))
          {
            this->Made.Corners.data()[own] = this->Made.Corners.data()[other];
          }
        }
      }
    }
  }

  // Whether the normals of a given triangle and of the disk's triangle that is part of it disagree.
  unsigned char IsTurned(std::int64_t given, ConstPointSpan<3> points, const CutOpenDisk& opened,
    std::int64_t triangle, const std::int64_t* kept) const
  {
    // Normals get the length 1, so that products of tiny or large sides neither vanish nor
    // overflow.
    const auto normalOf = [](ConstPointSpan<3> places, std::array<std::int64_t, 3> ids) {
      const auto at = [&](std::size_t i) {
        return Eigen::Map<const Eigen::Vector3d>(places[ids[i]]);
      };
      return Eigen::Vector3d((at(1) - at(0)).cross(at(2) - at(0)).stableNormalized());
    };
    std::array<std::int64_t, 3> part{ kept[0], kept[1], kept[2] };
    // In the mesh the corners are those of the cut, in their order or the opposite one.
    if (opened.Disk.Mesh)
    {
      const std::int64_t* ids = opened.Disk.Mesh->Triangle(triangle);
      const std::int64_t* corners = opened.Cut.Triangles.data() + 3 * triangle;
      // The disk's mesh has turned the triangle.
      if (ids[1] != corners[1])
      {
        std::swap(part[1], part[2]);
      }
    }
    const std::int64_t* ids = this->Surface.Triangles + 3 * given;
    const double product =
      normalOf(points, part).dot(normalOf(this->Surface.Points, { ids[0], ids[1], ids[2] }));
    return static_cast<unsigned char>(product < 0.0 ? 1 : 0);
  }

  // The component with its points numbered from 0 in the order of the triangles. `Locals` needs no
  // clearing between components: they share no points of the parts.
  SeamMesh MeshOf(const Component& component, Progress& progress)
  {
    if (this->Locals.size() == 0)
    {
      this->Locals = { component.Parts.NumberOfPoints(), -1 };
    }
    std::vector<Point<3>> points;
    std::vector<std::int64_t> triangles;
    std::vector<std::int64_t> origins;
    triangles.reserve(3 * component.Triangles.size());
    origins.reserve(component.Triangles.size());
    for (const std::int64_t triangle : component.Triangles)
    {
      progress.CheckEvery(trianglesPolled, triangle);
      for (std::int64_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
      {
        // The first corner at a point numbers it.
        std::int64_t& local = this->Locals.data()[component.Parts.Corners()[corner]];
        if (local < 0)
        {
          local = static_cast<std::int64_t>(points.size());
          const std::int64_t point = component.Kept.Triangles[corner];
          points.push_back(pointAt(component.Kept.Points, point) / this->Unit);
        }
        triangles.push_back(local);
      }
      origins.push_back(
        component.Repair.GivenTriangle(this->Repaired[static_cast<std::size_t>(triangle)]));
    }
    // Triangles that close holes come after the component's own; their origins are below 0.
    SeamMesh mesh(std::move(points), std::move(triangles), std::move(origins), progress);
    const HoleFans fans = closeManyHoles(mesh, progress);
    return fans.Points.empty() ? std::move(mesh)
                               : mesh.With(fans.Points, fans.Triangles, fans.Origins, progress);
  }

  const TriangleSurface Surface;
  CutSurface& Made;
  double Unit = 0.0;                     // the largest coordinate, so that areas do not overflow
  std::vector<std::int64_t> Repaired;    // the triangles that are kept
  std::vector<std::int64_t> Triangles;   // their points
  LargeBuffer<std::int64_t> FirstCopies; // by points of the repaired surface
  LargeBuffer<std::int64_t> Locals;      // by points of the parts: numbers in their component
  std::int64_t NumberOfPoints = 0;
};

CutSurface::CutSurface(
  const TriangleSurface& surface, const SeamOptions& options, const Context& context)
{
  SurfaceCutting(surface, *this).Run(options, context);
}

std::int64_t CutSurface::NumberOfPoints() const
{
  return this->AllDisks.empty()
    ? 0
    : this->AllDisks.back().FirstPoint + this->AllDisks.back().NumberOfPoints;
}

} // namespace RectifiedTransport

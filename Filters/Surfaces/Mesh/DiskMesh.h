// SPDX-License-Identifier: BSD-3-Clause
// Triangle surfaces that are disks: whether a mesh is one, its boundary, and a consistent
// orientation.
//
//   DiskMesh disk(surface); // throws NotADisk
//   std::vector<std::int64_t> boundary = disk.Boundary();
#ifndef RectifiedTransport_DiskMesh_h
#define RectifiedTransport_DiskMesh_h

#include "../../Core/Parallel/Context.h"
#include "../../Core/Parallel/LargeBuffer.h"
#include "SurfaceEdges.h"
#include "TriangleSurface.h"

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// Why a surface is no disk, in the order of the checks.
enum class DiskDefect
{
  PointsNotFinite,
  NoTriangles,
  TrianglesWithoutArea, // or with a point twice
  UnusedPoints,
  NonManifoldEdges, // edges of more than two triangles
  Components,
  NotOrientable,
  NonManifoldPoints, // where triangles meet that share no edge
  Closed,
  BoundaryLoops,
  Handles,
  FewBoundaryPoints // less than 4
};

class NotADisk : public std::runtime_error
{
public:
  NotADisk(DiskDefect defect, std::int64_t count, std::int64_t first = -1);

  DiskDefect Defect() const { return this->Kind; }
  // How many points, triangles, edges, components ... have the defect.
  std::int64_t Count() const { return this->Number; }
  // The first such point or triangle; -1 if it has no number.
  std::int64_t First() const { return this->FirstId; }

private:
  DiskDefect Kind;
  std::int64_t Number;
  std::int64_t FirstId;
};

// A surface that is homeomorphic to a disk: one component, every edge in one or two triangles, one
// boundary loop, no handles. Points with equal coordinates stay separate, as along a cut.
class DiskMesh
{
public:
  // Copies a surface and checks it, in O(triangles log triangles) for any number of triangles about
  // a point. Memory: 32 bytes a point, 56 a triangle, and temporarily 24 a triangle and 8 a point.
  // Throws NotADisk, std::invalid_argument for triangles with points that do not exist,
  // std::bad_alloc and Cancelled.
  explicit DiskMesh(const TriangleSurface& surface, const Context& context = Context());

  // The triangles in their order, all with the orientation that most of the area has. The points
  // are in units of Unit(), from the centre of their bounds.
  TriangleSurface Surface() const;
  std::int64_t NumberOfPoints() const { return this->Coordinates.size() / 3; }
  std::int64_t NumberOfTriangles() const { return this->Triangles.size() / 3; }
  // Three points of a triangle.
  const std::int64_t* Triangle(std::int64_t triangle) const
  {
    return this->Triangles.data() + 3 * triangle;
  }
  const SurfaceEdges& Edges() const { return *this->Sides; }
  // The longest side of the bounds, in the units of the given surface.
  double Unit() const { return this->Length; }

  // Gives the triangles from one on a share of the area together, whatever area they have.
  void SetShareFrom(std::int64_t first, double share);

  // The area of a triangle as a share of the surface's, > 0; the shares sum to 1.
  double AreaShare(std::int64_t triangle) const { return this->Shares.data()[triangle]; }
  const double* AreaShares() const { return this->Shares.data(); }
  // The surface's area in units of Unit()^2.
  double Area() const { return this->TotalArea; }

  // The points of the boundary in order, with the surface on the left if its triangles turn left.
  const std::vector<std::int64_t>& Boundary() const { return this->Loop; }

private:
  void CopyPoints(ConstPointSpan<3> points, Progress& progress);
  void CopyTriangles(const TriangleSurface& surface, Progress& progress);
  void FindAreas(Progress& progress);
  void RequireUsedPoints(Progress& progress) const;
  void Orient(const Context& context);
  void FindBoundary(Progress& progress);

  LargeBuffer<double> Coordinates;     // three a point, in units of Unit()
  LargeBuffer<std::int64_t> Triangles; // three points each
  LargeBuffer<double> Shares;          // parts of the area, by triangles
  std::unique_ptr<SurfaceEdges> Sides;
  std::vector<std::int64_t> Loop;
  double Length = 1.0;
  double TotalArea = 0.0;
};

} // namespace RectifiedTransport

#endif

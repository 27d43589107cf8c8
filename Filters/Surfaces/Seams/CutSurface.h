// SPDX-License-Identifier: BSD-3-Clause
// Cuts a surface of any topology along short seams into disks.
//
//   const CutSurface cut(surface);
//   for (const CutDisk& disk : cut.Disks())
//   {
//     mapAreaPreserving(*disk.Mesh, disk.Conformal->Square);
//   }
#ifndef RectifiedTransport_CutSurface_h
#define RectifiedTransport_CutSurface_h

#include "../../Core/Parallel/Context.h"
#include "../../Core/Parallel/LargeBuffer.h"
#include "../Mesh/DiskMesh.h"
#include "../Mesh/TriangleSurface.h"
#include "../Parameterization/ConformalMap.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

struct SeamOptions
{
  // By how much coincident coordinates may differ because of rounding; at least that of double.
  double Rounding = 0.0;
  // How often the seams of a component grow to where its conformal map squeezes areas most.
  int MaximumRounds = 8;
};

// A component that was cut open, or was a disk.
struct CutDisk
{
  // None if it is a triangle alone: its three points are no four corners of a square.
  std::optional<DiskMesh> Mesh;
  std::optional<ConformalMap> Conformal; // map of the mesh, with corners that were chosen
  // Its points in the cut surface: from this one on, in their order in the mesh.
  std::int64_t FirstPoint;
  std::int64_t NumberOfPoints;
  double Area; // to be compared with that of other disks
  bool HasSeams = false;
  // Where holes were closed: the last triangles of the mesh, and their share of its area.
  std::int64_t TrianglesOfHoles = 0;
  double AreaShareOfHoles = 0.0;
};

// What was changed besides the seams.
struct SurfaceCuts : SurfaceRepairs
{
  std::int64_t NonManifoldEdges = 0; // edges of more than two triangles, which were parted
};

// "Given" are the points and triangles of the surface. Points at one place are merged, triangles
// with the points of one before lie on it, and triangles without area are left out (see
// SurfaceRepair.h). Triangles that share an edge with more
// than one other part there; triangles that share only a point part, too. What is then joined is a
// component. A component that is a disk has no seams. Others, also those with one side only, are
// cut open along the seams of openToDisk; then seams grow to where the conformal map of the disk
// squeezes areas, as the tips of limbs, until it does so no more. More than 8 holes of a component
// that are small beside it are closed instead of cut open: seams between so many leave corridors.
class CutSurface
{
public:
  // Near-linear, besides a conformal map for each round of each component. Memory: 250 bytes a
  // given triangle, and that of mapConformally. The result does not depend on threads. Throws
  // NotADisk if points are not finite or no triangle has an area, std::invalid_argument for
  // triangles with points that do not exist and as mapConformally does, std::bad_alloc and
  // Cancelled.
  explicit CutSurface(const TriangleSurface& surface, const SeamOptions& options = {},
    const Context& context = Context());

  const std::vector<CutDisk>& Disks() const { return this->AllDisks; }
  const SurfaceCuts& Cuts() const { return this->Counts; }
  // The number of points of all disks.
  std::int64_t NumberOfPoints() const;

  // The disk of a given triangle; -1 if the triangle has no area.
  std::int64_t DiskOf(std::int64_t triangle) const { return this->DisksOf.data()[triangle]; }
  // Its three points in the cut surface; -1 if it has no area.
  const std::int64_t* CornersOf(std::int64_t triangle) const
  {
    return this->Corners.data() + 3 * triangle;
  }
  // Whether the disk has the triangle's corners in the opposite order.
  bool IsTurned(std::int64_t triangle) const { return this->Turned.data()[triangle] != 0; }
  // Given triangles that lie on one before.
  const std::vector<RepeatedTriangle>& Repeated() const { return this->AllRepeated; }
  // A point of the cut surface for a given one; -1 if no triangle with area is there.
  std::int64_t PointOf(std::int64_t given) const { return this->PointsOf.data()[given]; }

private:
  friend class SurfaceCutting;

  std::vector<CutDisk> AllDisks;
  std::vector<RepeatedTriangle> AllRepeated;
  SurfaceCuts Counts;
  LargeBuffer<std::int64_t> DisksOf;  // by given triangles; -1 without area
  LargeBuffer<std::int64_t> Corners;  // three a given triangle
  LargeBuffer<std::int64_t> PointsOf; // by given points; -1 in no disk
  LargeBuffer<unsigned char> Turned;  // by given triangles
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// A disk from a surface that may have unused points and triangles without area.
#ifndef RectifiedTransport_RepairedDisk_h
#define RectifiedTransport_RepairedDisk_h

#include "Core/Parallel/Context.h"
#include "Surfaces/Mesh/DiskMesh.h"
#include "Surfaces/Mesh/Repair/SurfaceRepair.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

// The surface as it is, if it is a disk. Otherwise it is repaired as little as possible: first
// without merging coincident points that no edge joins, then with. A triangle that it has twice
// counts once. If triangles without area were
// removed and merging gives a disk, too, the merged one is used: removed triangles may leave
// cracks. "Given" are the points and triangles of the surface.
class RepairedDisk
{
public:
  // `rounding` is the tolerance of coincident coordinates (see SurfaceRepairOptions). NotADisk
  // names given points and triangles. Cost and memory: those of DiskMesh and repairSurface. Throws
  // NotADisk, std::invalid_argument, std::bad_alloc and Cancelled.
  RepairedDisk(const TriangleSurface& surface, double rounding, const Context& context = Context());

  const DiskMesh& Mesh() const { return *this->Disk; }
  SurfaceRepairs Repairs() const
  {
    return this->Repaired ? this->Repaired->Repairs() : SurfaceRepairs();
  }

  // The disk's point for a given point; -1 if no triangle with area uses it.
  std::int64_t PointOf(std::int64_t given) const
  {
    return this->Repaired ? this->Repaired->NewPoint(given) : given;
  }
  std::int64_t NumberOfGivenPoints() const { return this->NumberOfPoints; }
  // The given points at the corners of a triangle of the disk.
  std::array<std::int64_t, 3> GivenCorners(std::int64_t triangle) const;
  // Given triangles that were left out as repeated.
  std::vector<RepeatedTriangle> Repeated() const
  {
    return this->Repaired ? this->Repaired->Repeated() : std::vector<RepeatedTriangle>();
  }
  // The given triangle that a triangle of the disk is part of.
  std::int64_t GivenTriangle(std::int64_t triangle) const
  {
    return this->Repaired ? this->Repaired->GivenTriangle(triangle) : triangle;
  }

private:
  bool Try(
    const TriangleSurface& surface, const SurfaceRepairOptions& options, const Context& context);
  bool TryAs(const TriangleSurface& surface, std::optional<RepairedSurface> repaired,
    const Context& context);

  std::int64_t NumberOfPoints;
  std::optional<RepairedSurface> Repaired;
  std::optional<DiskMesh> Disk;
  std::optional<NotADisk> Defect; // what was wrong in the last attempt
};

// The given triangles that have area, oriented as in the disk.
class GivenTriangles
{
public:
  // `given` are the triangles that the disk was made from. Throws std::bad_alloc.
  GivenTriangles(const RepairedDisk& disk, const std::int64_t* given);

  // Their points are the disk's.
  TriangleSurface Surface() const;
  std::int64_t Given(std::int64_t triangle) const
  {
    return this->Numbers[static_cast<std::size_t>(triangle)];
  }
  // Shares of the disk's area.
  const double* AreaShares() const { return this->Shares.data(); }

private:
  ConstPointSpan<3> Points;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int64_t> Numbers;
  std::vector<double> Shares;
};

} // namespace RectifiedTransport

#endif

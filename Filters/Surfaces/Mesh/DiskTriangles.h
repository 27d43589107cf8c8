// SPDX-License-Identifier: BSD-3-Clause
// Triangles as a disk, repaired and cut at T-junctions as far as that takes.
#ifndef RectifiedTransport_DiskTriangles_h
#define RectifiedTransport_DiskTriangles_h

#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/Repair/RepairedDisk.h"
#include "Surfaces/Mesh/SurfaceTriangles.h"
#include "Surfaces/Mesh/TriangleDomain.h"

#include <array>
#include <cstdint>
#include <optional>

namespace RectifiedTransport
{

// "Given" are the triangles before they are cut.
class DiskTriangles final : public TriangleDomain
{
public:
  // They are no disk.
  class NoDisk : public NotADisk
  {
  public:
    NoDisk(const NotADisk& defect, std::int64_t given)
      : NotADisk(defect)
      , GivenTriangle(given)
    {
    }

    std::int64_t GivenTriangle; // the first one without area; -1 for other defects
  };

  // Checks that triangles are a disk. If they are no disk, unused points and triangles without area
  // are left out, and points at the same position are merged (see RepairedDisk); if that does not
  // help, triangles are cut at T-junctions. The triangles must outlive this object; their points
  // may be freed. Throws NoDisk if they are no disk, std::bad_alloc and Cancelled.
  DiskTriangles(SurfaceTriangles& triangles, Progress& progress);

  const RepairedDisk& Repaired() const { return *this->Mesh; }
  const DiskMesh& Disk() const { return this->Mesh->Mesh(); }
  // Whether its triangles are not the given ones, or these cut.
  bool IsRepaired() const { return this->Mesh->Repairs().Any(); }
  // The disk's point for a given point; -1 if no triangle with area uses it.
  std::int64_t PointOf(std::int64_t point) const { return this->Mesh->PointOf(point); }

  std::int64_t NumberOfTriangles() const override { return this->Disk().NumberOfTriangles(); }
  std::int64_t GivenTriangle(std::int64_t triangle) const override
  {
    return this->Cut->GivenTriangle(this->Mesh->GivenTriangle(triangle));
  }
  std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const override
  {
    return this->Mesh->GivenCorners(triangle);
  }
  bool IsPart(std::int64_t triangle) const override;
  PointWeights InGiven(const PlaceOnTriangle& place) const override;
  TriangleSurface Surface() const override { return this->Disk().Surface(); }
  SurfaceAreas Areas() const override
  {
    return { this->Disk().AreaShares(), this->Disk().Area(), this->Disk().Unit() };
  }

private:
  void Make(Progress& progress);

  SurfaceTriangles* Cut;
  std::optional<RepairedDisk> Mesh;
};

} // namespace RectifiedTransport

#endif

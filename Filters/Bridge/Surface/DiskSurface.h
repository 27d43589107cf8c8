// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a disk of triangles.
#ifndef RectifiedTransport_DiskSurface_h
#define RectifiedTransport_DiskSurface_h

#include "Bridge/Run/Failure.h"
#include "Bridge/Surface/PlacedTriangles.h"
#include "Bridge/Surface/SurfaceTriangles.h"
#include "Core/Mesh/RepairedDisk.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parameterization/ConformalMap.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace RectifiedTransport::Bridge
{

// The input surface is no disk.
class NoDiskSurface : public Failure
{
public:
  NoDiskSurface(const std::string& message, DiskDefect defect)
    : Failure(message)
    , HasNoArea(defect == DiskDefect::TrianglesWithoutArea)
  {
  }

  bool HasNoArea; // triangles of it
};

class DiskSurface final : public PlacedTriangles
{
public:
  // Checks that triangles are a disk, and takes them. If they are no disk, unused points and
  // triangles without area are left out, and points at the same position are merged (see
  // RepairedDisk); if that does not help, triangles are cut at T-junctions. Throws NoDiskSurface if
  // they are no disk, after which `input` can still be used, Failure and Cancelled.
  DiskSurface(SurfaceTriangles& input, Progress& progress);
  // The same for the triangles of a surface that has points (see SurfaceTriangles).
  DiskSurface(vtkPolyData* input, Progress& progress);

  const DiskMesh& Disk() const { return this->Mesh->Mesh(); }

  vtkPolyData* Triangulated() const override { return this->Cells().Get(); }
  std::int64_t NumberOfTriangles() const override { return this->Disk().NumberOfTriangles(); }
  std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const override
  {
    return this->Mesh->GivenCorners(triangle);
  }
  vtkIdType CellOf(std::int64_t triangle) const override
  {
    return this->Cells().CellOf(this->Mesh->GivenTriangle(triangle));
  }
  vtkIdType InputCellOf(std::int64_t triangle) const override
  {
    return this->Cells().InputCellOf(this->Mesh->GivenTriangle(triangle));
  }
  bool IsPart(std::int64_t triangle) const override;
  PointWeights InCell(const PlaceOnTriangle& place) const override;
  TriangleSurface Surface() const override { return this->Disk().Surface(); }
  SurfaceAreas Areas() const override
  {
    return { this->Disk().AreaShares(), this->Disk().Area(), this->Disk().Unit() };
  }

  // The disk's point for a point of the input; -1 if no triangle with area uses it.
  std::int64_t PointOf(std::int64_t point) const { return this->Mesh->PointOf(point); }
  // The number of the first polygon.
  vtkIdType FirstCell() const { return this->Cells().FirstCell(); }

  const RepairedDisk& Repaired() const { return *this->Mesh; }
  // Whether its triangles are not those of Triangulated().
  bool IsRepaired() const { return this->Mesh->Repairs().Any(); }
  // The polygons of Triangulated() that have area, by their numbers from 0. Throws Cancelled.
  GivenTriangles GivenWithArea(Progress& progress) const;
  // A warning that counts what was left out, merged and closed; empty if nothing was.
  std::string RepairWarning() const;

private:
  void Make(SurfaceTriangles& input, Progress& progress);
  void MakeDisk(const SurfaceTriangles& input, Progress& progress);
  const TriangulatedSurface& Cells() const { return this->Input->Cells(); }

  std::optional<SurfaceTriangles> Input;
  std::optional<RepairedDisk> Mesh;
};

// The conformal map of a disk, with the errors of a run. Throws Failure and Cancelled.
ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress);

// A warning about triangles that have no area in the map; Corners help if the surface is not cut.
std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles, bool isCut = false);

} // namespace RectifiedTransport::Bridge

#endif

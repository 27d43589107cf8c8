// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a disk of triangles.
#ifndef RectifiedTransport_DiskSurface_h
#define RectifiedTransport_DiskSurface_h

#include "Bridge/Run/Failure.h"
#include "Bridge/Surface/PlacedTriangles.h"
#include "Bridge/Surface/TriangulatedSurface.h"
#include "Core/Mesh/RepairedDisk.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parameterization/ConformalMap.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace RectifiedTransport
{

// The input surface is no disk.
class NoDiskSurface : public Failure
{
public:
  using Failure::Failure;
};

class DiskSurface final : public PlacedTriangles
{
public:
  // `input` has points. Cuts polygons and strips into triangles and checks that they are a disk;
  // progress then reaches `end`. If they are no disk, unused points and triangles without area are
  // left out, and points at the same position are merged (see RepairedDisk). Throws NoDiskSurface
  // if the input is no disk, Failure if it has no polygons, coordinates that are not finite or
  // polygons that cannot be cut, and Cancelled.
  DiskSurface(vtkPolyData* input, Progress& progress, double end);

  const DiskMesh& Disk() const { return this->Mesh->Mesh(); }

  vtkPolyData* Triangulated() const override { return this->Cells->Get(); }
  std::int64_t NumberOfTriangles() const override { return this->Disk().NumberOfTriangles(); }
  std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const override
  {
    return this->Mesh->GivenCorners(triangle);
  }
  vtkIdType CellOf(std::int64_t triangle) const override
  {
    return this->Cells->CellOf(this->Mesh->GivenTriangle(triangle));
  }
  vtkIdType InputCellOf(std::int64_t triangle) const override
  {
    return this->Cells->InputCellOf(this->Mesh->GivenTriangle(triangle));
  }
  TriangleSurface Surface() const override { return this->Disk().Surface(); }
  SurfaceAreas Areas() const override
  {
    return { this->Disk().AreaShares(), this->Disk().Area(), this->Disk().Unit() };
  }

  // The disk's point for a point of the input; -1 if no triangle with area uses it.
  std::int64_t PointOf(std::int64_t point) const { return this->Mesh->PointOf(point); }
  // The number of the first polygon.
  vtkIdType FirstCell() const { return this->Cells->FirstCell(); }

  const RepairedDisk& Repaired() const { return *this->Mesh; }
  bool IsRepaired() const { return this->Mesh->Repairs().Any(); }
  // The polygons of Triangulated() that have area, by their numbers from 0. Throws Cancelled.
  GivenTriangles GivenWithArea(Progress& progress) const;
  // A warning that counts what was left out and merged.
  std::string RepairWarning() const;

private:
  void MakeDisk(const LargeBuffer<double>& coordinates, const SurfaceStages& stages);

  std::optional<TriangulatedSurface> Cells;
  std::optional<RepairedDisk> Mesh;
};

// The conformal map of a disk, with the errors of a run. Runs as the current stage. Throws Failure
// and Cancelled.
ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress);

// "2 points in no polygon left out, ...": the text of what was repaired; empty if nothing was.
std::string repairText(const SurfaceRepairs& repairs);

// A warning about triangles that have no area in the map; Corners help if the surface is not cut.
std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles, bool isCut = false);

} // namespace RectifiedTransport

#endif

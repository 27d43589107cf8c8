// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData as a disk of triangles.
#ifndef RectifiedTransport_DiskSurface_h
#define RectifiedTransport_DiskSurface_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Mesh/RepairedDisk.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parameterization/ConformalMap.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkCellArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class DiskSurface
{
public:
  // `input` has points. Cuts polygons and strips into triangles and checks that they are a disk;
  // progress then reaches `end`. If they are no disk, unused points and triangles without area are
  // left out, and points at the same position are merged (see RepairedDisk). Throws Failure if the
  // input has no polygons, coordinates that are not finite or polygons that cannot be cut, or is no
  // disk, and Cancelled.
  DiskSurface(vtkPolyData* input, Progress& progress, double end);

  const DiskMesh& Disk() const { return this->Mesh->Mesh(); }

  // The input itself if all polygons are triangles and there are no strips. Else its points,
  // vertices, lines and triangles, with all point and field data, and the cell data of the cells
  // that they come from, except global ids, which would no longer be unique.
  vtkPolyData* Triangulated() const { return this->Surface; }

  // The disk's point for a point of the input; -1 if no triangle with area uses it.
  std::int64_t PointOf(std::int64_t point) const { return this->Mesh->PointOf(point); }
  // The points of the input at the corners of a triangle of the disk.
  std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const
  {
    return this->Mesh->GivenCorners(triangle);
  }
  // The cell of Triangulated() that a triangle of the disk is, or is part of. vtkPolyData numbers
  // vertices, lines, polygons, strips.
  vtkIdType CellOf(std::int64_t triangle) const
  {
    return this->FirstPolygon + static_cast<vtkIdType>(this->Mesh->GivenTriangle(triangle));
  }
  // The number of the first polygon.
  vtkIdType FirstCell() const { return this->FirstPolygon; }
  // The cell of the input that a triangle was cut from.
  vtkIdType InputCellOf(std::int64_t triangle) const
  {
    return this->InputCell(this->Mesh->GivenTriangle(triangle));
  }

  const RepairedDisk& Repaired() const { return *this->Mesh; }
  bool IsRepaired() const { return this->Mesh->Repairs().Any(); }
  // The polygons of Triangulated() that have area, by their numbers from 0. Throws Cancelled.
  GivenTriangles GivenWithArea(Progress& progress) const;
  // A warning that counts what was left out and merged.
  std::string RepairWarning() const;

private:
  // Fractions of the stages from `begin` to `end` of the run.
  struct Stages
  {
    Progress& Run;
    double Begin;
    double End;

    void Next(double part) const
    {
      this->Run.BeginStage(this->Begin + part * (this->End - this->Begin));
    }
  };

  void Triangulate(vtkPolyData* input, const Stages& stages);
  void FindInputCells(vtkPolyData* input, Progress& progress);
  void CopyCellData(vtkPolyData* input, Progress& progress);
  void MakeDisk(const LargeBuffer<double>& coordinates, const Stages& stages);
  vtkIdType InputCell(std::int64_t polygon) const
  {
    return this->InputCells.size() > 0 ? this->InputCells.data()[polygon]
                                       : this->FirstPolygon + static_cast<vtkIdType>(polygon);
  }

  vtkSmartPointer<vtkPolyData> Surface;
  vtkIdType FirstPolygon;
  LargeBuffer<vtkIdType> InputCells; // of triangles; empty if they are the input's
  std::optional<RepairedDisk> Mesh;
};

// The conformal map of a disk, with the errors of a run. Runs as the current stage. Throws Failure
// and Cancelled.
ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress);

// A warning about triangles that have no area in the map.
std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles);

} // namespace RectifiedTransport

#endif

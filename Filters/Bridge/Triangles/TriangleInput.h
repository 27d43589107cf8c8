// SPDX-License-Identifier: BSD-3-Clause
// The polygons and strips of a vtkPolyData as triangles, for what takes a disk, a surface that is
// cut along seams into disks, or the whole of any surface; solids: see ClosedSurface.h.
#ifndef RectifiedTransport_TriangleInput_h
#define RectifiedTransport_TriangleInput_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/AllTriangles.h"
#include "Surfaces/Mesh/DiskTriangles.h"
#include "Surfaces/Mesh/Repair/RepairText.h"
#include "Surfaces/Mesh/SurfaceTriangles.h"
#include "Surfaces/Parameterization/ConformalMap.h"
#include "Surfaces/Seams/CutOpenSurface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <string>

namespace RectifiedTransport::Bridge
{

// The input surface is no disk.
class NoDiskSurface : public Failure
{
public:
  using Failure::Failure;
};

class TriangleInput
{
public:
  // `input` has points, and must outlive this object. Reads them and cuts polygons and strips into
  // triangles, one for each corner beyond the second: coincident or collinear corners give
  // triangles without area. `need` is that of readSurfacePoints. Throws Failure if the input has no
  // polygons, coordinates that are not finite or polygons that cannot be cut, and Cancelled.
  TriangleInput(vtkPolyData* input, const std::string& need, Progress& progress);
  TriangleInput(const TriangleInput&) = delete;
  TriangleInput& operator=(const TriangleInput&) = delete;

  vtkPolyData* Input() const { return this->Surface; }
  // The number of the first polygon: vtkPolyData numbers vertices, lines, polygons, strips.
  vtkIdType FirstCell() const { return this->FirstPolygon; }
  // The cell of the input that a given triangle was cut from.
  vtkIdType CellOf(std::int64_t given) const
  {
    return this->FirstPolygon +
      static_cast<vtkIdType>(this->Polygons.size() > 0 ? this->Polygons.data()[given] : given);
  }

  // One of the following, or Disk() and, after NoDiskSurface, Opened(). They are valid as long as
  // this object. Each throws Failure and Cancelled.

  // See DiskTriangles. Throws NoDiskSurface if the triangles are no disk.
  DiskTriangles Disk(Progress& progress);
  // Closes T-junctions and cuts the surface into disks.
  CutOpenSurface Opened(Progress& progress);
  // Ghost cells (duplicate, blanked or refined) are left out, and triangles with the places of one
  // before.
  AllTriangles Whole(Progress& progress);

  // The input itself if all polygons are triangles, and none was cut. Else its points, vertices,
  // lines and triangles, with all point and field data, and the cell data of the cells that they
  // come from, except global ids, which would no longer be unique. Not after Whole().
  vtkSmartPointer<vtkPolyData> Triangulated(Progress& progress) const;
  // Three points a triangle of Triangulated().
  LargeBuffer<std::int64_t> Corners(Progress& progress) const;
  // Makes the output the triangles of an opened surface, without the ids of points, which would no
  // longer be unique.
  void CopyOpened(const CutOpenSurface& opened, Progress& progress, vtkPolyData* output) const;

  // A warning that counts what was changed in a disk or an opened surface, and T-junctions; empty
  // if nothing was.
  std::string RepairWarning(const SurfaceRepairs& repairs, std::int64_t partedEdges = 0) const;

private:
  LargeBuffer<std::int64_t> ReadCorners(ConstPointSpan<3> points, double rounding, Progress& work);
  bool IsInput() const { return this->Polygons.size() == 0 && !this->Triangles.Parts(); }

  vtkPolyData* const Surface;
  const vtkIdType FirstPolygon;
  LargeBuffer<std::int64_t> Polygons; // by given triangles; empty if these are the input's polygons
  SurfaceTriangles Triangles;
};

// The conformal map of a disk to a square, with the errors of a run. Throws Failure and Cancelled.
ConformalMap mapDisk(const DiskMesh& disk, const SquareCorners& corners, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif

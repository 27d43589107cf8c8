// SPDX-License-Identifier: BSD-3-Clause
// The polygons of a vtkPolyData, cut along seams into disks.
#ifndef RectifiedTransport_OpenedSurface_h
#define RectifiedTransport_OpenedSurface_h

#include "Bridge/Surface/SurfaceTriangles.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Core/Seams/CutSurface.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

// The points of the output are those of the input in their order, and then the copies of those on
// seams.
class OpenedSurface
{
public:
  // Takes triangles and cuts them at T-junctions, and then into disks. Throws Failure if they have
  // no area or no conformal map, and Cancelled.
  OpenedSurface(SurfaceTriangles& input, Progress& progress);

  const CutSurface& Cut() const { return *this->Disks; }
  vtkPolyData* Triangulated() const { return this->Input.Cells().Get(); }
  // The triangles of Triangulated(), from the cell FirstCell() on.
  TriangleSurface Given() const { return this->Input.Surface(); }
  vtkIdType FirstCell() const { return this->Input.Cells().FirstCell(); }

  // The point of the input that a point of the output is.
  std::int64_t OriginOf(std::int64_t point) const
  {
    return this->Origins[static_cast<std::size_t>(point)];
  }
  std::int64_t NumberOfPoints() const { return static_cast<std::int64_t>(this->Origins.size()); }
  // The point of the cut surface for a point of the output; -1 if no triangle with area has it.
  std::int64_t PointOf(std::int64_t point) const
  {
    return this->CutPoints[static_cast<std::size_t>(point)];
  }
  // Which copies the cells without area have: those that are nearest to each other in a map of the
  // cut surface, so that they do not lie across it.
  void PlaceFlatCells(ConstPointSpan<2> positions);
  // Makes the output the triangles with the points and data of the input, without the ids of
  // points, which would no longer be unique. Throws Failure and Cancelled.
  void CopyTo(vtkPolyData* output, Progress& progress) const;
  // A warning that counts what was left out, merged, closed and parted; empty if nothing was.
  std::string RepairWarning() const;

private:
  void NumberPoints(Progress& progress);
  std::int64_t CopyAt(std::int64_t given, std::int64_t cutPoint);
  std::vector<std::int64_t> PlacesOf(std::int64_t corner) const;

  SurfaceTriangles Input;
  std::optional<CutSurface> Disks;
  LargeBuffer<std::int64_t> OutputCorners;
  std::vector<std::int64_t> Origins;   // by points of the output
  std::vector<std::int64_t> CutPoints; // by points of the output
  std::vector<std::int64_t> NextCopy;  // by points of the output; -1 for the last one
};

} // namespace RectifiedTransport::Bridge

#endif

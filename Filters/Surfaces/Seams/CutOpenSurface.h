// SPDX-License-Identifier: BSD-3-Clause
// A surface that was cut along seams into disks, on its own points and copies of those on seams.
#ifndef RectifiedTransport_CutOpenSurface_h
#define RectifiedTransport_CutOpenSurface_h

#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/TriangleSurface.h"
#include "Surfaces/Seams/CutSurface.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace RectifiedTransport
{

// "Given" are the points and triangles that are cut. The points of the opened surface are the given
// ones in their order, and then the copies.
class CutOpenSurface
{
public:
  // `given` must outlive this object. Cost and memory: those of CutSurface, and 32 bytes a point
  // and 24 a triangle. Throws as CutSurface.
  CutOpenSurface(const TriangleSurface& given, const SeamOptions& options, Progress& progress);

  const CutSurface& Cut() const { return *this->Disks; }
  const TriangleSurface& Given() const { return this->GivenTriangles; }

  std::int64_t NumberOfPoints() const { return static_cast<std::int64_t>(this->Origins.size()); }
  // The given point that a point is.
  std::int64_t OriginOf(std::int64_t point) const
  {
    return this->Origins[static_cast<std::size_t>(point)];
  }
  // The point of the cut surface for a point; -1 if no triangle with area has it.
  std::int64_t PointOf(std::int64_t point) const
  {
    return this->CutPoints[static_cast<std::size_t>(point)];
  }
  // The points of all given triangles, three each.
  const std::int64_t* Triangles() const { return this->Corners.data(); }

  // Which copies the triangles without area have: those that are nearest to each other in a map of
  // the cut surface, so that they do not lie across it.
  void PlaceDegenerate(ConstPointSpan<2> positions);

private:
  void NumberPoints(Progress& progress);
  std::int64_t CopyAt(std::int64_t given, std::int64_t cutPoint);
  std::vector<std::int64_t> PlacesOf(std::int64_t corner) const;

  const TriangleSurface GivenTriangles;
  std::optional<CutSurface> Disks;
  LargeBuffer<std::int64_t> Corners;   // three points a given triangle
  std::vector<std::int64_t> Origins;   // by points
  std::vector<std::int64_t> CutPoints; // by points
  std::vector<std::int64_t> NextCopy;  // by points; -1 for the last one
};

} // namespace RectifiedTransport

#endif

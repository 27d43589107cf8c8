// SPDX-License-Identifier: BSD-3-Clause
// Repairs surfaces as files and filters leave them: removes points that no triangle uses,
// coincident points, triangles that are there before, and triangles that are lines.
//
//   const RepairedSurface repaired = repairSurface(surface, { rounding, false });
//   DiskMesh disk(repaired.Surface());
#ifndef RectifiedTransport_SurfaceRepair_h
#define RectifiedTransport_SurfaceRepair_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct SurfaceRepairOptions
{
  // By how much coincident coordinates may differ along each axis because of rounding. Also the
  // height of triangles without area.
  double Rounding = 0.0;
  // Whether points with equal coordinates become one even if no edge joins them.
  bool MergesEqualPoints = false;
};

// "Given" are the points and triangles that a surface was repaired from. Each triangle is part of a
// given one.
class RepairedSurface
{
public:
  TriangleSurface Surface() const;
  const SurfaceRepairs& Repairs() const { return this->Counts; }

  // The new point for a given point; -1 if no triangle with area uses it.
  std::int64_t NewPoint(std::int64_t given) const { return this->NewPoints.data()[given]; }
  std::int64_t NumberOfGivenPoints() const { return this->NewPoints.size(); }
  // The first given point that became this one.
  std::int64_t FirstGivenPoint(std::int64_t point) const { return this->FirstGiven.data()[point]; }
  // The three given points at the corners of a triangle.
  const std::int64_t* Corners(std::int64_t triangle) const
  {
    return this->GivenCorners.data() + 3 * triangle;
  }
  // The given triangle that a triangle is part of.
  std::int64_t GivenTriangle(std::int64_t triangle) const { return this->Origins.data()[triangle]; }
  // Given triangles that were left out as repeated.
  const std::vector<RepeatedTriangle>& Repeated() const { return this->AllRepeated; }

private:
  friend class SurfaceRepairRun;

  LargeBuffer<double> Positions;
  LargeBuffer<std::int64_t> Triangles;
  LargeBuffer<std::int64_t> GivenCorners;
  LargeBuffer<std::int64_t> Origins;
  LargeBuffer<std::int64_t> NewPoints;
  LargeBuffer<std::int64_t> FirstGiven;
  std::vector<RepeatedTriangle> AllRepeated;
  SurfaceRepairs Counts;
};

// How much coordinates at one place may differ by rounding in double.
double roundingOfDoubles(ConstPointSpan<3> points);

// Whether a surface has points that no triangle uses, edges of no length or triangles without area,
// up to `rounding`. O(triangles). Throws std::bad_alloc and Cancelled.
bool needsRepair(
  const TriangleSurface& surface, double rounding, const Context& context = Context());

// Merges the ends of edges of no length, and leaves out points that no triangle uses, triangles
// with the points of one before, and triangles without area. Coincident points that no edge joins
// stay separate, as along a cut, unless the options merge them. All coordinates must be finite.
// O(triangles log triangles). Memory: 70 bytes a point and 180 a triangle. On one thread. Throws
// std::bad_alloc and Cancelled.
RepairedSurface repairSurface(const TriangleSurface& surface, const SurfaceRepairOptions& options,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif

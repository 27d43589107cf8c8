// SPDX-License-Identifier: BSD-3-Clause
// All triangles of a surface of any shape, with their areas.
#ifndef RectifiedTransport_AllTriangles_h
#define RectifiedTransport_AllTriangles_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Mesh/TriangleDomain.h"

#include <array>
#include <cstdint>
#include <functional>

namespace RectifiedTransport
{

class AllTriangles final : public TriangleDomain
{
public:
  using IsLeftOut = std::function<bool(std::int64_t)>; // called with given triangles

  // The coordinates are finite. Leaves out triangles, and those with the places of one before.
  // Throws std::invalid_argument if the others have no area, std::bad_alloc and Cancelled.
  AllTriangles(LargeBuffer<double> coordinates, LargeBuffer<std::int64_t> corners,
    const IsLeftOut& isLeftOut, Progress& progress);

  std::int64_t NumberOfTriangles() const override { return this->Count; }
  std::int64_t GivenTriangle(std::int64_t triangle) const override
  {
    return this->GivenIds.size() > 0 ? this->GivenIds.data()[triangle] : triangle;
  }
  std::array<std::int64_t, 3> CornersOf(std::int64_t triangle) const override
  {
    const std::int64_t* corners = this->Corners.data() + 3 * triangle;
    return { corners[0], corners[1], corners[2] };
  }
  TriangleSurface Surface() const override
  {
    return { { this->Coordinates.data(), this->Coordinates.size() / 3 }, this->Corners.data(),
      this->Count };
  }
  SurfaceAreas Areas() const override { return { this->Shares.data(), this->Area, this->Unit }; }
  // By how much the coordinates of Surface() may be off (see roundingOfCorners).
  double Rounding() const { return this->RoundingOfPoints; }
  // The number of triangles that were left out as repeated.
  std::int64_t Repeated() const { return this->NumberOfRepeated; }

private:
  void ScalePoints(Progress& progress);
  void LeaveOut(const IsLeftOut& isLeftOut, Progress& progress);
  void LeaveOutRepeated(Progress& progress);
  void FindAreas(Progress& progress);

  LargeBuffer<double> Coordinates;    // three a point, in units of Unit from the centre
  LargeBuffer<std::int64_t> Corners;  // three points each
  std::int64_t Count;                 // number of triangles that are left
  LargeBuffer<std::int64_t> GivenIds; // given triangles; empty if these are all
  LargeBuffer<double> Shares;         // parts of the area, by triangles
  std::int64_t NumberOfRepeated = 0;
  double RoundingOfPoints = 0.0;
  double Area = 0.0; // in units of Unit^2
  double Unit = 1.0;
};

} // namespace RectifiedTransport

#endif

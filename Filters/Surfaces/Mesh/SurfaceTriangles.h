// SPDX-License-Identifier: BSD-3-Clause
// The points and triangles of a surface, which may be cut at its T-junctions.
#ifndef RectifiedTransport_SurfaceTriangles_h
#define RectifiedTransport_SurfaceTriangles_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/Repair/SplitSurface.h"
#include "Surfaces/Mesh/Repair/TJunctionRepair.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace RectifiedTransport
{

// "Given" are the triangles before they are cut.
class SurfaceTriangles
{
public:
  SurfaceTriangles() = default; // without any
  // Coordinates at one place differ by at most `rounding` along each axis.
  SurfaceTriangles(
    LargeBuffer<double> coordinates, LargeBuffer<std::int64_t> corners, double rounding);

  // A view of the triangles, cut if they were; not to be used after FreePoints().
  TriangleSurface Surface() const
  {
    return { { this->Coordinates.data(), this->Coordinates.size() / 3 }, this->Corners.data(),
      this->Corners.size() / 3 };
  }
  double Rounding() const { return this->RoundingOfPoints; }

  // Cuts triangles at T-junctions (see repairTJunctions), unless that was tried before. Returns
  // whether any was cut. Throws std::bad_alloc and Cancelled.
  bool CloseTJunctions(TJunctionScope scope, const Context& context = Context());
  std::int64_t TJunctions() const { return this->NumberOfTJunctions; }
  // The number of triangles without area that were left out.
  std::int64_t FlatTriangles() const { return this->NumberOfFlat; }
  // The parts of triangles, if some were cut.
  const std::optional<SplitSurface>& Parts() const { return this->Split; }
  // The given triangle that a triangle is, or is part of.
  std::int64_t GivenTriangle(std::int64_t triangle) const
  {
    return this->Split ? this->Split->GivenTriangle(triangle) : triangle;
  }

  // Free or take the memory of points and corners.
  void FreePoints() { this->Coordinates = {}; }
  void FreeCorners() { this->Corners = {}; }
  LargeBuffer<double> TakePoints() { return std::move(this->Coordinates); }
  LargeBuffer<std::int64_t> TakeCorners() { return std::move(this->Corners); }

private:
  LargeBuffer<double> Coordinates;   // three a point
  LargeBuffer<std::int64_t> Corners; // three points a triangle
  double RoundingOfPoints = 0.0;
  bool IsSearched = false;
  std::int64_t NumberOfTJunctions = 0;
  std::int64_t NumberOfFlat = 0;
  std::optional<SplitSurface> Split;
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The points and triangles of an input surface, and its T-junctions.
#ifndef RectifiedTransport_SurfaceTriangles_h
#define RectifiedTransport_SurfaceTriangles_h

#include "Bridge/Surface/TriangulatedSurface.h"
#include "Core/Mesh/SplitSurface.h"
#include "Core/Mesh/TJunctionRepair.h"
#include "Core/Mesh/TriangleSurface.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>
#include <optional>
#include <string>

namespace RectifiedTransport::Bridge
{

class SurfaceTriangles
{
public:
  // `input` has points. Reads them and cuts polygons and strips into triangles. `need` is that of
  // readSurfacePoints. Throws Failure if the input has no polygons, coordinates that are not finite
  // or polygons that cannot be cut, and Cancelled.
  SurfaceTriangles(vtkPolyData* input, const std::string& need, Progress& progress);

  const TriangulatedSurface& Cells() const { return *this->Triangulated; }
  // See roundingOf.
  double Rounding() const { return this->RoundingOfPoints; }
  // The triangles of Cells(); not after Free().
  TriangleSurface Surface() const
  {
    return { { this->Coordinates.data(), this->Coordinates.size() / 3 }, this->Corners.data(),
      this->Corners.size() / 3 };
  }

  // Cuts triangles at T-junctions (see repairTJunctions), unless that was done before. Cells() then
  // has their parts, each with the data of the cell that it is part of. Returns whether there are
  // any. Throws Failure and Cancelled.
  bool CloseTJunctions(TJunctionScope scope, Progress& progress);
  std::int64_t TJunctions() const { return this->NumberOfTJunctions; }
  // Left out.
  std::int64_t FlatTriangles() const { return this->NumberOfFlat; }
  // If triangles were cut.
  const std::optional<SplitSurface>& Parts() const { return this->Split; }

  // Frees the memory of Surface().
  void Free();

private:
  void Cut(TJunctionScope scope, Progress& progress);

  std::optional<TriangulatedSurface> Triangulated;
  double RoundingOfPoints;
  LargeBuffer<double> Coordinates;
  LargeBuffer<std::int64_t> Corners;
  bool IsSearched = false;
  std::int64_t NumberOfTJunctions = 0;
  std::int64_t NumberOfFlat = 0;
  std::optional<SplitSurface> Split;
};

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Triangles as a ClosedMesh, closed within rounding alone.
#ifndef ClosedMeshes_h
#define ClosedMeshes_h

#include "Core/Geometry/PointBounds.h"
#include "Core/Parallel/Stages.h"
#include "Surfaces/Solid/ClosedMesh.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport
{

inline ClosedMesh closedMesh(const TriangleSurface& surface, const Context& context = Context())
{
  Progress progress(context);
  Stages stages(progress, { { "points", 1 }, { "edges", 2 } });
  Bounds<3> bounds; // points of no triangle do not count
  for (std::int64_t corner = 0; corner < 3 * surface.NumberOfTriangles; ++corner)
  {
    bounds.Add(surface.Points[cornerPoint(surface, corner)]);
  }
  LargeBuffer<double> coordinates(3 * surface.Points.size());
  std::copy_n(surface.Points.data(), coordinates.size(), coordinates.data());
  ClosedMesh mesh(std::move(coordinates), stages["points"]);
  ClosingDistances distances(
    { bounds.Low[0], bounds.High[0], bounds.Low[1], bounds.High[1], bounds.Low[2], bounds.High[2] },
    false);
  distances.Gaps = {};
  mesh.Close(surface, distances, stages["edges"]);
  progress.EndSlice(1);
  return mesh;
}

} // namespace RectifiedTransport

#endif

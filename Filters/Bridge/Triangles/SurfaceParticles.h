// SPDX-License-Identifier: BSD-3-Clause
// The output of a sampled surface.
#ifndef RectifiedTransport_SurfaceParticles_h
#define RectifiedTransport_SurfaceParticles_h

#include "Bridge/Triangles/SurfaceInput.h"
#include "Bridge/Triangles/TriangleInput.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Places on the triangles of an input.
struct SurfacePlaces
{
  vtkIdType CellOf(const PlaceOnTriangle& place) const
  {
    return this->Triangles.CellOf(this->Surface.GivenTriangle(place.Triangle));
  }

  const SurfaceInput& Input;
  const TriangleInput& Triangles; // made from the input's surface
  const TriangleDomain& Surface;
  const LargeBuffer<PlaceOnTriangle>& Places;
};

// Bytes of a particle of the output, without the surface's arrays.
constexpr double BytesOfSurfaceParticle = 9 * sizeof(double) + 4 * sizeof(vtkIdType);

// Writes a vertex for each place, with SeedId, Mass (equal shares), CellId, Normal, and the
// surface's arrays there; field data TotalMass. Throws Failure and Cancelled.
void writeSurfaceParticles(
  const SurfacePlaces& places, double totalMass, Progress& progress, vtkPolyData* output);
// An estimate of its time in nanoseconds.
double costOfSurfaceParticles(double particles, vtkPolyData* surface);

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The arrays of a surface at points on its triangles.
#ifndef RectifiedTransport_SampledArrays_h
#define RectifiedTransport_SampledArrays_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/SurfaceSampling/FlatLocator.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class DiskSurface;
class Progress;

// Adds the surface's point arrays, interpolated linearly, and the values of its cell arrays to the
// data of points at the given places, but for names that there are already and ghost arrays; active
// attributes of the points stay active, where there are no others. As stages up to the progress
// `end`. Throws Failure and Cancelled.
void sampleArrays(const DiskSurface& surface, const LargeBuffer<PlaceOnTriangle>& places,
  Progress& progress, double end, vtkPointData* output);

} // namespace RectifiedTransport

#endif

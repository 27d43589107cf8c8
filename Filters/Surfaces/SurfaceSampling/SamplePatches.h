// SPDX-License-Identifier: BSD-3-Clause
// Whether the numbers of samples of a surface match the shares of the mass everywhere.
#ifndef RectifiedTransport_SamplePatches_h
#define RectifiedTransport_SamplePatches_h

#include "Core/Parallel/Context.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Surfaces/Mesh/DiskMesh.h"
#include "Surfaces/SurfaceSampling/FlatLocator.h"

namespace RectifiedTransport
{

// The relative L2 error of the numbers of samples in patches of triangles. A patch has the mass of
// at most 64 samples unless it is one triangle. Patches are the leaves of a k-d tree of the
// triangles' centres in space. O(triangles log triangles). Throws std::bad_alloc and Cancelled.
double patchError(const DiskMesh& disk, const double* masses,
  const LargeBuffer<PlaceOnTriangle>& places, const Context& context = Context());

} // namespace RectifiedTransport

#endif

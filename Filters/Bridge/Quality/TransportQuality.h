// SPDX-License-Identifier: BSD-3-Clause
// How well the particles of a point set follow a density: the work of vtkTransportQuality.
#ifndef RectifiedTransport_TransportQuality_h
#define RectifiedTransport_TransportQuality_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"
#include "Core/Quality/ParticleQuality.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class CountedPoints;
class DensityImage;
class FlowCache;

// As the properties of that class.
struct TransportQuality
{
  int BlockSize;

  // Compares the particles that count, of which there must be some, with a density; the cache keeps
  // its tables. Throws Failure, std::overflow_error and Cancelled.
  ParticleQuality Run(vtkPointSet* particles, const CountedPoints& counted, DensityImage& density,
    FlowCache& cache, Progress& progress) const;
};

} // namespace RectifiedTransport

#endif

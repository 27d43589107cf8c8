// SPDX-License-Identifier: BSD-3-Clause
// Compares particles with a density: the worker of vtkTransportQuality.
#ifndef RectifiedTransport_TransportQuality_h
#define RectifiedTransport_TransportQuality_h

#include "Bridge/Settings/TableSettings.h"
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

// The members are the properties of that class.
struct TransportQuality
{
  int BlockSize;
  TableSetting Tables;

  // Compares the particles that are no ghosts, at least one, with a density, whose tables are kept
  // in the cache. Those of all ranks of the progress together, in the order of a key for each, or
  // without keys (nullptr) of the ranks. Throws Failure, std::overflow_error and Cancelled.
  ParticleQuality Run(vtkPointSet* particles, const CountedPoints& counted,
    const std::int64_t* order, DensityImage& density, FlowCache& cache, Progress& progress) const;
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// How well particles follow a density: what vtkTransportQuality reports.
#ifndef RectifiedTransport_ParticleQuality_h
#define RectifiedTransport_ParticleQuality_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class CountedPoints;
class DensityImage;
class FlowCache;
class Progress;

struct ParticleQuality
{
  std::int64_t Particles = 0;
  double TotalMass = 0.0;
  std::int64_t InEmptyCells = 0;
  std::int64_t Outside = 0;
  double DensityError = 0.0;
  double TransportCost = 0.0;
  double SmallestSpacing = 0.0;
  double MeanSpacing = 0.0;
};

// Compares the particles that count, of which there must be some, with a density; the density's
// tables are those of the cache, which is brought up to date. Throws Failure and Cancelled.
ParticleQuality measureQuality(vtkPointSet* particles, const CountedPoints& counted,
  DensityImage& density, int blockSize, FlowCache& cache, Progress& progress);

} // namespace RectifiedTransport

#endif

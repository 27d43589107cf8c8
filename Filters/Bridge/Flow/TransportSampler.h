// SPDX-License-Identifier: BSD-3-Clause
// Samples a density with particles: the worker of vtkTransportSampler.
#ifndef RectifiedTransport_TransportSampler_h
#define RectifiedTransport_TransportSampler_h

#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Core/Seeds/Seeds.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The members are the properties of that class.
struct TransportSampler : TransportSettings
{
  SeedPattern Pattern = SeedPattern::BlueNoise;
  std::int64_t NumberOfParticles = 0;
  int RandomSeed = 0;
  int SamplesPerCell = 0;
  double FlowTime = 1.0;
  bool OutputPaths = false;
  bool SampleArrays = false;

  // Numbers for warnings, of all ranks.
  struct Report
  {
    std::int64_t Particles = 0;
    FlowReport Flow; // the flow of this rank
    TransportReport Transport;
    std::int64_t SeedsMoved = 0;     // to the domain's border
    std::int64_t ParticlesMoved = 0; // from empty cells of the density to the nearest mass
  };

  // Whether the seeds are a grid in every cell of the density.
  bool UsesGrid() const
  {
    return this->SamplesPerCell > 0 &&
      (this->Pattern == SeedPattern::Lattice || this->Pattern == SeedPattern::Jittered);
  }

  // Writes particles or their paths from the given seeds; if `seeds` is nullptr, from those of the
  // pattern. Collective. Throws Failure and Cancelled.
  Report Run(InputDensity& density, vtkPointSet* seeds, FlowCache& cache, Progress& progress,
    vtkPolyData* output) const;
};

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Samples a surface with particles: the worker of vtkSurfaceSampler.
#ifndef RectifiedTransport_SurfaceSampler_h
#define RectifiedTransport_SurfaceSampler_h

#include "Bridge/Settings/CornerSettings.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Seeds/Seeds.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;
class SurfaceDensity;

// The members are the properties of that class.
struct SurfaceSampler
{
  FlowOptions Flow;
  const CornerSettings& Corners;
  std::int64_t NumberOfParticles;
  int Resolution;
  SeedPattern Pattern;
  int RandomSeed;

  // Throws Failure for values that are out of range whatever the surface.
  void Check() const;

  // Writes particles. Returns how many ended in empty cells of the grid and were moved to the
  // nearest mass. Throws Failure and Cancelled.
  std::int64_t Run(vtkPolyData* surface, const SurfaceDensity& density, Progress& progress,
    vtkPolyData* output) const;
};

} // namespace RectifiedTransport

#endif

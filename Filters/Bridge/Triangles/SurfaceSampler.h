// SPDX-License-Identifier: BSD-3-Clause
// Samples a surface with particles: the worker of vtkSurfaceSampler.
#ifndef RectifiedTransport_SurfaceSampler_h
#define RectifiedTransport_SurfaceSampler_h

#include "Bridge/VTKCompatibility.h"
#include "Surfaces/Parameterization/CornerSettings.h"
#include "Surfaces/SurfaceSampling/SurfaceSamples.h"
#include "Surfaces/SurfaceSampling/SurfaceSamplingReport.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class SurfaceDensityArray;
class SurfaceInput;

// Indexed by vtkSurfaceSampler::MethodType.
constexpr const char* SurfaceMethodTexts[] = { "Relaxation", "Flow" };
enum class SurfaceMethod
{
  Relaxation, // for any surface
  Flow        // for a disk, by its map
};

// The members are the properties of that class.
struct SurfaceSampler
{
  static constexpr int MostIterations = 1000;

  SurfaceMethod Method;
  int RelaxationIterations;
  CornerSettings Corners;         // the corners of the disk, for Flow
  SurfaceSamplingOptions Options; // the number of samples and the seed also of the relaxation

  // Throws Failure for values that are out of range for any surface.
  void Check() const;

  // Writes particles. Throws Failure and Cancelled.
  SurfaceSamplingReport Run(const SurfaceInput& surface, const SurfaceDensityArray& density,
    Progress& progress, vtkPolyData* output) const;

private:
  SurfaceSamplingReport Relax(const SurfaceInput& surface, const SurfaceDensityArray& density,
    Progress& progress, vtkPolyData* output) const;
  SurfaceSamplingReport Transport(const SurfaceInput& surface, const SurfaceDensityArray& density,
    Progress& progress, vtkPolyData* output) const;
};

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Points moved so that a density becomes uniform: the work of vtkDensityEqualizingWarp.
#ifndef RectifiedTransport_DensityEqualizingWarp_h
#define RectifiedTransport_DensityEqualizingWarp_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class DensityImage;
class FlowCache;
class Progress;

// As the properties of that class.
struct DensityEqualizingWarp
{
  FlowOptions Flow;
  double Blend;

  // Gives an output, which has all else of the input, its points and `Displacement`. Returns how
  // many points are outside of the domain. Throws Failure and Cancelled.
  std::int64_t Run(DensityImage& density, vtkPointSet* input, FlowCache& cache, Progress& progress,
    vtkPointSet* output) const;
};

} // namespace RectifiedTransport

#endif

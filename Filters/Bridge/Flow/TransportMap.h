// SPDX-License-Identifier: BSD-3-Clause
// The map between the uniform measure and a density: the worker of vtkTransportMap.
#ifndef RectifiedTransport_TransportMap_h
#define RectifiedTransport_TransportMap_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class DensityImage;
class FlowCache;
class ImageGrid;
class Progress;

// The members are the properties of that class.
struct TransportMap
{
  FlowOptions Flow;
  bool Backward;

  struct Report
  {
    std::int64_t Samples;
    std::int64_t MovedToMass; // from empty cells of the density
  };

  // Writes the map's fields, sampled on a grid on the density's domain, into an image, which gets
  // this grid. Throws Failure and Cancelled.
  Report Run(DensityImage& density, const ImageGrid& samples, FlowCache& cache, Progress& progress,
    vtkImageData* output) const;
};

} // namespace RectifiedTransport

#endif

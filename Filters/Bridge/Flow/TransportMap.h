// SPDX-License-Identifier: BSD-3-Clause
// The map between the uniform measure and a density: the worker of vtkTransportMap.
#ifndef RectifiedTransport_TransportMap_h
#define RectifiedTransport_TransportMap_h

#include "Bridge/Density/DensityTransport.h"
#include "Bridge/Settings/OptimalSettings.h"
#include "Bridge/Settings/TableSettings.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Geometry/ImageGrid.h"

#include <array>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;
class FlowCache;

// The members are the properties of that class.
struct TransportMap
{
  FlowOptions Flow;
  TableSetting Tables;
  OptimalSetting Optimal;
  bool Backward;
  bool EqualizeAreas;                  // of Backward
  std::array<int, 3> SampleDimensions; // 0 keeps the number of the density's values

  struct Report
  {
    ImageGrid Grid; // of all samples
    double Samples;
    FlowReport Flow;
    TransportReport Transport;
    std::int64_t MovedToMass; // from empty cells of the density
    std::int64_t Folded;
    bool ShowsFolds;     // enough for a warning
    bool IsUncorrected;  // EqualizeAreas has changed nothing
    FlowReport ToTarget; // the second flow, of a map to a target
  };

  // The grid of the samples on the density's domain. Throws Failure.
  ImageGrid SampleGrid(const InputDensity& density) const;

  // Writes the map's fields, sampled on a grid on the density's domain, into an image, which gets
  // this grid. If it is the density's grid, the image also gets the arrays of the input. Each rank
  // gets the part of the grid in the extent that it wants. Collective. Throws Failure and
  // Cancelled.
  Report Run(InputDensity& density, const std::array<int, 6>& wanted, FlowCache& cache,
    Progress& progress, vtkImageData* output) const;
};

// Gives the part of an image the arrays of the density's input, if the samples are on its grid.
// Collective.
void passArrays(const InputDensity& density, const ImageGrid& samples,
  const std::array<int, 6>& part, vtkImageData* output);

} // namespace RectifiedTransport::Bridge

#endif

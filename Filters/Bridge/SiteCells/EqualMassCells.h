// SPDX-License-Identifier: BSD-3-Clause
// Divides a domain among sites into cells of equal mass: the worker of vtkEqualMassCells.
#ifndef RectifiedTransport_EqualMassCells_h
#define RectifiedTransport_EqualMassCells_h

#include "Bridge/SiteCells/SiteLabels.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/SiteCells/SiteCellStatistics.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkPointSet;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class ImageGrid;
class Progress;

// The members are the properties of that class.
struct EqualMassCells
{
  FlowOptions Flow;
  CostNorm Norm;
  int Resolution;
  bool IsPower = false; // Shape

  struct Outputs
  {
    vtkImageData* Labels;
    vtkPointSet* Sites;
    vtkPolyData* Outlines;
  };

  // The pixels in the box of a domain, which is that of a density, and in the bounds of sites, 10 %
  // longer along each axis. Throw Failure.
  ImageGrid GridOn(vtkImageData* domain) const;
  ImageGrid GridAround(vtkPointSet* sites) const;

  // Assigns the pixels in a domain, or where it is nullptr around the sites, to at least one site;
  // reuses the labels that are kept where they are valid. Returns how many sites are outside of the
  // domain. Throws Failure, std::invalid_argument, std::runtime_error, std::bad_alloc and
  // Cancelled.
  std::int64_t Run(vtkPointSet* sites, vtkImageData* domain, SiteLabels& kept, Progress& progress,
    const Outputs& outputs) const;
};

} // namespace RectifiedTransport

#endif

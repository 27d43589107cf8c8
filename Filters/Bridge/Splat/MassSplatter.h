// SPDX-License-Identifier: BSD-3-Clause
// The mass of points as a density: the work of vtkMassSplatter.
#ifndef RectifiedTransport_MassSplatter_h
#define RectifiedTransport_MassSplatter_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Splat/Splat.h"

#include <array>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkImageData;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

// As the properties of that class.
struct MassSplatter
{
  std::array<int, 3> Dimensions; // without a reference
  bool OnPoints;
  bool DivideByVolume;
  SplatOptions Splat;

  // The image around points, without a reference. Throws Failure.
  ImageGrid GridAround(vtkPointSet* points) const;

  // Spreads masses, 1 each where there are none, over the grid of a reference or else around the
  // points. Returns how many of them are outside of it. Throws Failure and Cancelled.
  std::int64_t Run(vtkPointSet* points, vtkDataArray* masses, vtkImageData* reference,
    Progress& progress, vtkImageData* output) const;

private:
  ImageGrid CellsAround(vtkPointSet* points) const;
};

} // namespace RectifiedTransport

#endif

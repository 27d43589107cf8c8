// SPDX-License-Identifier: BSD-3-Clause
// Splats the mass of points: the worker of vtkMassSplatter.
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

// The members are the properties of that class.
struct MassSplatter
{
  std::array<int, 3> Dimensions; // without a reference
  bool OnPoints;
  bool DivideByVolume;
  SplatOptions Splat;

  // The grid of the output on the points' bounds, without a reference. Throws Failure.
  ImageGrid GridAround(vtkPointSet* points) const;

  // Splats masses, 1 each where `masses` is nullptr, onto the grid of a reference, or of the
  // points' bounds. Returns how many points are outside of it. Throws Failure and Cancelled.
  std::int64_t Run(vtkPointSet* points, vtkDataArray* masses, vtkImageData* reference,
    Progress& progress, vtkImageData* output) const;

private:
  ImageGrid CellsAround(vtkPointSet* points) const;
};

} // namespace RectifiedTransport

#endif

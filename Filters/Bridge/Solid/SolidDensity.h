// SPDX-License-Identifier: BSD-3-Clause
// The density of a solid: the worker of vtkSolidDensity.
#ifndef RectifiedTransport_SolidDensity_h
#define RectifiedTransport_SolidDensity_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

// The members are the properties of that class.
struct SolidDensity
{
  int Resolution;
  int Supersampling;
  double Padding;
  bool OnPoints;

  // The image around a surface. Throws Failure.
  ImageGrid GridAround(vtkPolyData* surface) const;

  // Writes the fraction of each image cell that a closed surface encloses. Throws Failure and
  // Cancelled.
  void Run(vtkPolyData* surface, Progress& progress, vtkImageData* output) const;
};

} // namespace RectifiedTransport

#endif

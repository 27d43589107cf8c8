// SPDX-License-Identifier: BSD-3-Clause
// A solid as a density: the work of vtkSolidDensity.
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

// As the properties of that class.
struct SolidDensity
{
  int Resolution;
  int Supersampling;
  double Padding;
  bool OnPoints;

  // The image around a surface. Throws Failure.
  ImageGrid GridAround(vtkPolyData* surface) const;

  // Writes how much of each cell a closed surface encloses. Throws Failure and Cancelled.
  void Run(vtkPolyData* surface, Progress& progress, vtkImageData* output) const;
};

} // namespace RectifiedTransport

#endif

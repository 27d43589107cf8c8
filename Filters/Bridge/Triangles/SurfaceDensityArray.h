// SPDX-License-Identifier: BSD-3-Clause
// A density per area of the points or cells of a surface.
#ifndef RectifiedTransport_SurfaceDensityArray_h
#define RectifiedTransport_SurfaceDensityArray_h

#include "Bridge/VTKCompatibility.h"
#include "Surfaces/SurfaceRelaxation/SurfaceMasses.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class TriangleInput;

class SurfaceDensityArray
{
public:
  SurfaceDensityArray() = default; // 1 everywhere
  // Text that holds numbers alone becomes numbers. Throws Failure for an array that is missing
  // (`found` is nullptr), not numeric, of several components or of another length; `name` is the
  // requested name.
  SurfaceDensityArray(
    vtkPolyData* surface, vtkAbstractArray* found, bool onPoints, const std::string& name);

  // The masses of triangles that were made of an input's. Throws Failure and Cancelled, as
  // Core's SurfaceMasses does.
  SurfaceMasses MassesOf(
    const TriangleInput& input, const TriangleDomain& surface, Progress& progress) const;

private:
  vtkSmartPointer<vtkDataArray> Values; // nullptr for 1
  bool OnPoints = true;
};

} // namespace RectifiedTransport::Bridge

#endif

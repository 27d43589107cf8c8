// SPDX-License-Identifier: BSD-3-Clause
// The map of a surface to the unit square: the worker of vtkAreaPreservingParameterization.
#ifndef RectifiedTransport_AreaPreservingParameterization_h
#define RectifiedTransport_AreaPreservingParameterization_h

#include "Bridge/VTKCompatibility.h"
#include "Surfaces/Parameterization/CornerSettings.h"
#include "Surfaces/Parameterization/ParameterizationReport.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class DiskTriangles;
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class TriangleInput;

// The texts of Seams, in the order of its values.
constexpr const char* SeamsTexts[] = { "Auto", "None" };

// The members are the properties of that class.
struct AreaPreservingParameterization
{
  CornerSettings Corners;
  int Resolution;
  bool Polish;
  int Seams = 0;

  // Throws Failure for values that are out of range for any surface.
  void Check() const;

  // Makes the output the surface's triangles with the map's arrays. Throws Failure and Cancelled.
  ParameterizationReport Run(vtkPolyData* surface, Progress& progress, vtkPolyData* output) const;

private:
  ParameterizationReport MapDisk(const TriangleInput& triangles, const DiskTriangles& surface,
    Progress& progress, vtkPolyData* output) const;
  ParameterizationReport MapOpened(
    TriangleInput& triangles, Progress& progress, vtkPolyData* output) const;
};

// Makes a surface that Run has made lie in the unit square. It shares all arrays but the points.
void layFlat(vtkPolyData* surface, vtkPolyData* flat);

} // namespace RectifiedTransport::Bridge

#endif

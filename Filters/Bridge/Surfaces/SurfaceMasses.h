// SPDX-License-Identifier: BSD-3-Clause
// The masses of the triangles of a surface: area, times a density.
#ifndef RectifiedTransport_SurfaceMasses_h
#define RectifiedTransport_SurfaceMasses_h

#include "Bridge/VTKCompatibility.h"
#include "Core/SurfaceRelaxation/TriangleMasses.h"

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

// A density per area of the points or cells of a surface.
class SurfaceDensityArray
{
public:
  SurfaceDensityArray() = default; // 1 everywhere
  // Text that holds numbers alone becomes numbers. Throws Failure for an array that is missing
  // (`found` is nullptr), not numeric, of several components or of another length; `name` is the
  // requested name.
  SurfaceDensityArray(
    vtkPolyData* surface, vtkAbstractArray* found, bool onPoints, const std::string& name);

  // nullptr for 1.
  vtkDataArray* Array() const { return this->Values; }
  bool IsOnPoints() const { return this->OnPoints; }

private:
  vtkSmartPointer<vtkDataArray> Values;
  bool OnPoints = true;
};

class SurfaceMasses
{
public:
  // The mass of a triangle is its area times the mean of the density at its points, exact for
  // linear interpolation, or times the density of its cell. Ghost cells have no mass. Throws
  // Failure for densities that are negative or not finite and for a total mass that is zero or not
  // finite, and Cancelled.
  SurfaceMasses(const TriangleInput& input, const PlacedTriangles& surface,
    const SurfaceDensityArray& density, Progress& progress);

  // The masses of the triangles, up to a factor.
  const double* Values() const { return this->Masses.Masses.data(); }
  // The total mass, in units of the density and of the input.
  double Total() const { return this->Sum; }
  // The density relative to its largest value, so that no mass is past the largest double.
  SurfaceDensityValues Density() const;

private:
  void ReadLargest(const TriangleInput& triangles, const double* values,
    const unsigned char* ghosts, vtkDataArray* array, Progress& progress);

  bool OnPoints;
  LargeBuffer<double> Relative; // by points or triangles; empty for 1 everywhere
  double Largest = 1.0;         // also if all values are 0
  TriangleMasses Masses;
  double Sum = 0.0;
};

} // namespace RectifiedTransport::Bridge

#endif

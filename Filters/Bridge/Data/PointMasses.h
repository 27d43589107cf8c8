// SPDX-License-Identifier: BSD-3-Clause
// The masses of the points of an input, checked and in double precision.
#ifndef RectifiedTransport_PointMasses_h
#define RectifiedTransport_PointMasses_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// The point array of masses of that name; nullptr for an empty name, and for "None" if there is no
// such array. Text that holds numbers alone becomes numbers. Throws Failure if it is missing, not
// numeric or has several components.
vtkSmartPointer<vtkDataArray> findMasses(vtkPointSet* points, const std::string& name);

// The active attribute of the points, of vtkDataSetAttributes::AttributeTypes.
vtkSmartPointer<vtkDataArray> findMasses(vtkPointSet* points, int attribute);

class PointMasses
{
public:
  // The total is the sum of the sums of this number of consecutive masses.
  static constexpr std::int64_t Chunk = std::int64_t{ 1 } << 13;

  PointMasses() = default;
  // Reads an array of the points, nullptr for the mass 1 each. Ghosts have no mass. Throws Failure
  // for values that are not finite and for ghost arrays of another length, and Cancelled.
  PointMasses(vtkPointSet* points, vtkDataArray* array, Progress& progress);

  // One mass a point; nullptr if each is 1.
  vtkDoubleArray* Array() const { return this->Masses; }
  const double* Values() const { return this->Masses ? this->Masses->GetPointer(0) : nullptr; }
  double Total() const { return this->Sum; }
  // The sum of the absolute values.
  double TotalSize() const { return this->Sizes; }

private:
  vtkSmartPointer<vtkDoubleArray> Masses;
  double Sum = 0.0;
  double Sizes = 0.0;
};

} // namespace RectifiedTransport::Bridge

#endif

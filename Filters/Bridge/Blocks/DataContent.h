// SPDX-License-Identifier: BSD-3-Clause
// What a result was computed from, to decide whether it must be computed again.
#ifndef RectifiedTransport_DataContent_h
#define RectifiedTransport_DataContent_h

#include "Bridge/VTKCompatibility.h"

#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataArray;
class vtkObject;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Numbers, arrays, and the modification times of their owners. Equal times mean equal content. If
// times differ, a hash of the values decides: programs make new data sets around the same arrays,
// and write into arrays without marking them as modified.
class DataContent
{
public:
  void AddNumber(std::uint64_t number);
  void AddNumbers(const double* numbers, int count);
  void AddTime(std::uint64_t time);
  // For an object that is no array, such as a vtkCellArray; nullptr is allowed.
  void AddTimeOf(vtkObject* object);
  // Its name, type, sizes and values; nullptr is allowed. Call IsSameAs or Keep before the array is
  // gone.
  void AddArray(vtkAbstractArray* array);

  // Whether this is the content `before`; if so, `before` gets the times of this one. Runs as the
  // current stage. Throws Cancelled.
  bool IsSameAs(DataContent& before, Progress& progress);
  // Prepares for later comparisons. Runs as the current stage. Throws Cancelled.
  void Keep(Progress& progress);

private:
  std::uint64_t HashOf(Progress& progress);

  std::vector<std::uint64_t> Numbers;
  std::vector<std::uint64_t> Times;  // and the addresses of what has them
  std::vector<vtkDataArray*> Arrays; // until the hash is there
  std::uint64_t Hash = 0;            // of the arrays' values; 0 if they are not contiguous
  bool IsHashed = false;
};

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The tuples of an array, contiguous and in double precision.
#ifndef RectifiedTransport_DoubleTuples_h
#define RectifiedTransport_DoubleTuples_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

class NonGhostPoints;

class DoubleTuples
{
public:
  // All tuples. A vtkDoubleArray is referenced and must outlive this object; others are copied.
  // Throws Failure if memory is short, and Cancelled.
  DoubleTuples(vtkDataArray* array, Progress& progress);
  // The tuples of the points that are not ghosts, of an array with a tuple for every point.
  DoubleTuples(vtkDataArray* array, const NonGhostPoints& counted, Progress& progress);

  const double* data() const { return this->Values; }

private:
  // Copies the tuples tupleAt(i), 0 <= i < count.
  template <class TupleAt>
  void Copy(vtkDataArray* array, std::int64_t count, Progress& progress, const TupleAt& tupleAt);

  LargeBuffer<double> Copies;
  const double* Values;
};

} // namespace RectifiedTransport::Bridge

#endif

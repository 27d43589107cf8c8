// SPDX-License-Identifier: BSD-3-Clause
// The tuples of an array in double precision, one after the other.
#ifndef RectifiedTransport_DoubleTuples_h
#define RectifiedTransport_DoubleTuples_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class CountedPoints;

class DoubleTuples
{
public:
  // All tuples. Where they are in memory so already, that is the array's, which has to stay; else
  // the work of the current stage is to copy them. Throws Failure for memory that is not there, and
  // Cancelled.
  DoubleTuples(vtkDataArray* array, Progress& progress);
  // Of an array with a tuple for every point, those of the points that count.
  DoubleTuples(vtkDataArray* array, const CountedPoints& counted, Progress& progress);

  const double* data() const { return this->Values; }

private:
  // Tuple tupleAt(i) for each i from 0 to `count`.
  template <class TupleAt>
  void Copy(vtkDataArray* array, std::int64_t count, Progress& progress, const TupleAt& tupleAt);

  LargeBuffer<double> Copies;
  const double* Values;
};

} // namespace RectifiedTransport

#endif

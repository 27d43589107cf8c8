// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/DoubleTuples.h"

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Run/Memory.h"

#include "vtkDoubleArray.h"

#include <string>

namespace RectifiedTransport::Bridge
{

DoubleTuples::DoubleTuples(vtkDataArray* array, Progress& progress)
{
  this->Copy(array, array->GetNumberOfTuples(), progress, [](std::int64_t i) { return i; });
}

DoubleTuples::DoubleTuples(vtkDataArray* array, const NonGhostPoints& counted, Progress& progress)
{
  this->Copy(
    array, counted.Count(), progress, [&counted](std::int64_t i) { return counted.Point(i); });
}

template <class TupleAt>
void DoubleTuples::Copy(
  vtkDataArray* array, std::int64_t count, Progress& progress, const TupleAt& tupleAt)
{
  auto* doubles = vtkDoubleArray::SafeDownCast(array);
  if (doubles && count == array->GetNumberOfTuples())
  {
    this->Values = doubles->GetPointer(0);
    return;
  }
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  const int components = array->GetNumberOfComponents();
  const std::int64_t values = count * components;
  withMemory({ "a copy of " + std::to_string(count) + " tuples in double precision",
               static_cast<double>(values) * sizeof(double) },
    [&]() { this->Copies = LargeBuffer<double>(values); });
  double* copies = this->Copies.data();
  progress.ForEach(count, grain, [&](std::int64_t i) {
    array->GetTuple(static_cast<vtkIdType>(tupleAt(i)), copies + i * components);
  });
  this->Values = copies;
}

} // namespace RectifiedTransport::Bridge

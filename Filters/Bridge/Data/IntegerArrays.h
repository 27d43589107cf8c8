// SPDX-License-Identifier: BSD-3-Clause
// The arrays of a vtkCellArray.
#ifndef RectifiedTransport_IntegerArrays_h
#define RectifiedTransport_IntegerArrays_h

#include "Bridge/VTKCompatibility.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"

namespace RectifiedTransport::Bridge
{

// Calls visit(values) with an array of integers in its value type.
template <class Visit>
void visitIntegers(vtkDataArray* array, const Visit& visit)
{
  using Integers = vtkTypeList::Create<int, long, long long>; // that cell arrays store
  using Dispatch = vtkArrayDispatch::DispatchByValueType<Integers>;
  const auto call = [&visit](auto* typed) { visit(vtk::DataArrayValueRange<1>(typed)); };
  if (!Dispatch::Execute(array, call))
  {
    call(array);
  }
}

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Checked allocation: every allocation that grows with the input or a property is checked, and a
// failed one becomes a Failure that names the requested size.
#ifndef RectifiedTransport_Memory_h
#define RectifiedTransport_Memory_h

#include "Core/Flow/NoMemoryForFlowMap.h"
#include "Core/Messages/Failure.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/MemoryPlan.h"

#include "vtkAbstractArray.h"
#include "vtkSmartPointer.h"

#include <limits>
#include <new>
#include <string>

namespace RectifiedTransport::Bridge
{

[[noreturn]] inline void failOutOfMemory(const MemoryPlan& plan)
{
  throw Failure(plan.DescribeLack());
}
// The same for the exception that a handler has caught, unless it names its purpose itself: then it
// is thrown again.
[[noreturn]] inline void failOutOfMemory(const std::bad_alloc& caught, const MemoryPlan& plan)
{
  if (dynamic_cast<const NoMemoryForFlowMap*>(&caught))
  {
    throw; // what the handler has caught
  }
  failOutOfMemory(plan);
}

// Throws Failure if a single block of this size cannot be allocated.
inline void requireMemory(const MemoryPlan& plan)
{
  if (!plan.Fits())
  {
    failOutOfMemory(plan);
  }
}

// Calls a function; its std::bad_alloc becomes a Failure, unless the exception itself names its
// purpose. Workers build tables and advect in a try block instead: many
// calls lead from there to the kernels, and a lambda would be one more.
template <class Function>
auto withMemory(const MemoryPlan& plan, Function&& function)
{
  try
  {
    return function();
  }
  catch (const std::bad_alloc& caught)
  {
    failOutOfMemory(caught, plan);
  }
}

// The same, if the memory is there before.
template <class Function>
auto withRequiredMemory(const MemoryPlan& plan, Function&& function)
{
  requireMemory(plan);
  return withMemory(plan, function);
}

// A VTK array whose values are not initialised. (A failed allocation by VTK itself prints an error
// and throws.)
template <class ArrayT>
vtkSmartPointer<ArrayT> newArray(const std::string& name, int components, vtkIdType tuples)
{
  using Value = typename ArrayT::ValueType;
  const double bytes = static_cast<double>(tuples) * components * sizeof(Value);
  void* memory = nullptr;
  if (bytes < static_cast<double>(std::numeric_limits<std::size_t>::max()))
  {
    memory = allocateLarge(static_cast<std::size_t>(tuples) * components * sizeof(Value) + 1);
  }
  if (!memory)
  {
    failOutOfMemory({ "the array " + name, bytes });
  }
  auto array = vtkSmartPointer<ArrayT>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetArray(static_cast<Value*>(memory), tuples * components, 0,
    vtkAbstractArray::VTK_DATA_ARRAY_ALIGNED_FREE); // as freeLarge
  return array;
}

// A VTK array of values that are there, which it takes.
template <class ArrayT>
vtkSmartPointer<ArrayT> arrayOf(
  const std::string& name, int components, LargeBuffer<typename ArrayT::ValueType>& values)
{
  auto array = vtkSmartPointer<ArrayT>::New();
  const std::int64_t count = values.size();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetArray(values.release(), count, 0, vtkAbstractArray::VTK_DATA_ARRAY_ALIGNED_FREE);
  return array;
}

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Memory that may not be there: every demand that grows with the input or a property is checked,
// and a refusal becomes a Failure that says how much was asked for.
#ifndef RectifiedTransport_Memory_h
#define RectifiedTransport_Memory_h

#include "Core/Parallel/LargeBuffer.h"

#include "vtkAbstractArray.h"
#include "vtkSmartPointer.h"

#include <limits>
#include <new>
#include <string>

namespace RectifiedTransport
{

[[noreturn]] void failOutOfMemory(const std::string& purpose, double bytes);

// Throws Failure if the system refuses a block of this size. Systems that promise memory before
// they have it refuse single blocks, not sums of blocks, beyond what the machine holds.
void requireMemory(const std::string& purpose, double bytes);

// Runs a function that may run out of memory.
template <class Function>
auto withMemory(const std::string& purpose, double bytes, Function&& function)
{
  try
  {
    return function();
  }
  catch (const std::bad_alloc&)
  {
    failOutOfMemory(purpose, bytes);
  }
}

// A VTK array whose values are not initialised. (VTK's own allocation prints and throws on its own
// account.)
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
    failOutOfMemory("the array " + name, bytes);
  }
  auto array = vtkSmartPointer<ArrayT>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetArray(static_cast<Value*>(memory), tuples * components, 0,
    vtkAbstractArray::VTK_DATA_ARRAY_ALIGNED_FREE); // as freeLarge
  return array;
}

} // namespace RectifiedTransport

#endif

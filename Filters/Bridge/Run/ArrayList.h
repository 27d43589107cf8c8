// SPDX-License-Identifier: BSD-3-Clause
// The arrays of an input: their names for messages, and what is asked of them.
#ifndef RectifiedTransport_ArrayList_h
#define RectifiedTransport_ArrayList_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataSetAttributes;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// "a, b (point)", or "no point arrays": the numeric arrays. `owner` is "point" or "cell".
std::string listArrays(vtkDataSetAttributes* attributes, const std::string& owner);

// Throws Failure unless an array has one component and a value for each of `count` points or cells,
// which `owners` names. `title` begins the message.
void requireScalars(
  vtkAbstractArray* array, const std::string& title, vtkIdType count, const std::string& owners);

} // namespace RectifiedTransport::Bridge

#endif

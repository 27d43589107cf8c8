// SPDX-License-Identifier: BSD-3-Clause
// An input array of a filter that may be left out.
#ifndef RectifiedTransport_OptionalArray_h
#define RectifiedTransport_OptionalArray_h

#include "Bridge/VTKCompatibility.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataSet;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Whether an array that is chosen may have this field association: points, cells, or points, then
// cells. Throws Failure if it may not; `title` names the array.
bool isArrayAssociation(int association);
void requireArrayAssociation(int association, const std::string& title);

struct OptionalArray
{
  vtkAbstractArray* Array = nullptr; // nullptr also if the data lack an array that is chosen
  bool OnPoints = true;
  bool IsChosen = false; // whether the data must have it; not with "None", which may be its name
  std::string Name;
};

// `choice`: GetInputArrayInformation of the filter. Throws Failure as above.
OptionalArray findOptionalArray(vtkInformation* choice, vtkDataSet* data, const char* title);

} // namespace RectifiedTransport::Bridge

#endif

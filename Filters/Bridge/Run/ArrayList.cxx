// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/ArrayList.h"

#include "Core/Messages/Failure.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"

namespace RectifiedTransport::Bridge
{

std::string listArrays(vtkDataSetAttributes* attributes, const std::string& owner)
{
  std::string list;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = attributes->GetArray(i))
    {
      const char* name = array->GetName();
      list += (list.empty() ? "" : ", ") + std::string(name ? name : "(no name)");
    }
  }
  const char* none = attributes->GetNumberOfArrays() > 0 ? "no numeric " : "no ";
  return list.empty() ? none + owner + " arrays" : list + " (" + owner + ")";
}

void requireScalars(
  vtkAbstractArray* array, const std::string& title, vtkIdType count, const std::string& owners)
{
  const int components = array->GetNumberOfComponents();
  if (components != 1)
  {
    throw Failure(title + " has " + std::to_string(components) + " components; it must have 1");
  }
  if (array->GetNumberOfTuples() != count)
  {
    throw Failure(title + " has " + std::to_string(array->GetNumberOfTuples()) +
      " values, but there are " + std::to_string(count) + " " + owners +
      "; there must be one for each");
  }
}

} // namespace RectifiedTransport::Bridge

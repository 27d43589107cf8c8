// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/ArrayList.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"

namespace RectifiedTransport
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
  return list.empty() ? "no " + owner + " arrays" : list + " (" + owner + ")";
}

} // namespace RectifiedTransport

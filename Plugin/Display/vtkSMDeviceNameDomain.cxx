// SPDX-License-Identifier: BSD-3-Clause
#include "Display/vtkSMDeviceNameDomain.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkSMDeviceNameDomain);

void vtkSMDeviceNameDomain::SetStrings(const std::vector<std::string>& strings)
{
  std::vector<std::string> all = strings;
  if (vtkSMProperty* property = this->GetProperty())
  {
    const std::string name = vtkSMPropertyHelper(property, true).GetAsString();
    if (std::find(all.begin(), all.end(), name) == all.end())
    {
      all.push_back(name);
    }
  }
  this->Superclass::SetStrings(all);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/GhostArrayType.h"

#include "Bridge/Run/Inputs/InputExtents.h"
#include "Core/Messages/MessageText.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformationVector.h"
#include "vtkUnsignedCharArray.h"

#include <string>

namespace RectifiedTransport::Bridge
{

namespace
{

std::string describe(vtkDataObject* data, const std::string& name)
{
  for (const int owner : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* attributes = data ? data->GetAttributes(owner) : nullptr;
    vtkAbstractArray* array =
      attributes ? attributes->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()) : nullptr;
    if (array && !vtkUnsignedCharArray::SafeDownCast(array))
    {
      const char* const owners = owner == vtkDataObject::POINT ? "points" : "cells";
      return std::string("The array '") + array->GetName() + "' of the " + owners + " of " + name +
        " is of type " + array->GetDataTypeAsString() + " and hides no " + owners +
        "; ghost flags must be of type unsigned char (numpy's uint8)";
    }
  }
  return {};
}

} // namespace

void warnOfGhostArrayType(vtkAlgorithm* filter, vtkInformationVector** inputVector)
{
  std::string warning;
  visitLeaves(filter, inputVector, [&warning](vtkDataObject* leaf, const std::string& name) {
    warning = warning.empty() ? describe(leaf, name) : warning;
  });
  if (!warning.empty())
  {
    vtkWarningWithObjectMacro(filter, << messageText(warning));
  }
}

} // namespace RectifiedTransport::Bridge

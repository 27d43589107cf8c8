// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/GhostFlags.h"

#include "Bridge/Run/Inputs/InputExtents.h"
#include "Bridge/Run/Memory.h"
#include "Core/Messages/MessageText.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
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

const unsigned char* ghostFlags(vtkDataSet* data, int owner, const char* what)
{
  auto* array = vtkUnsignedCharArray::SafeDownCast(
    data->GetAttributes(owner)->GetArray(vtkDataSetAttributes::GhostArrayName()));
  if (!array)
  {
    return nullptr;
  }
  const vtkIdType expected = data->GetNumberOfElements(owner);
  if (array->GetNumberOfValues() != expected)
  {
    const std::string owners = owner == vtkDataObject::POINT ? "points" : "cells";
    throw Failure("The ghost array '" + std::string(array->GetName()) + "' of the " + owners +
      " of the " + what + " has " + std::to_string(array->GetNumberOfValues()) +
      " values, but there are " + std::to_string(expected) + " " + owners +
      "; there must be one for each");
  }
  return array->GetPointer(0);
}

NonGhostPoints::NonGhostPoints(vtkDataSet* points, const char* what, unsigned char ghosts)
  : NonGhostPoints(
      points->GetNumberOfPoints(), ghostFlags(points, vtkDataObject::POINT, what), ghosts)
{
}

NonGhostPoints::NonGhostPoints(std::int64_t all, const unsigned char* flags, unsigned char ghosts)
  : Number(all)
{
  const auto isGhost = [ghosts](unsigned char flag) { return (flag & ghosts) != 0; };
  if (!flags || std::none_of(flags, flags + all, isGhost))
  {
    return;
  }
  this->Number -= std::count_if(flags, flags + all, isGhost);
  withMemory({ "the numbers of the points that are no ghosts",
               sizeof(std::int64_t) * static_cast<double>(this->Number) },
    [&]() { this->Indices = LargeBuffer<std::int64_t>(this->Number); });
  std::int64_t number = 0;
  for (std::int64_t point = 0; point < all; ++point)
  {
    if (!isGhost(flags[point]))
    {
      this->Indices.data()[number++] = point;
    }
  }
}

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

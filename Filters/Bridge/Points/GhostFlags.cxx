// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/GhostFlags.h"

#include "Bridge/Run/Memory.h"
#include "Core/Messages/Failure.h"

#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <string>

namespace RectifiedTransport::Bridge
{

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

void blankCellsOfHiddenPoints(const std::array<int, 3>& dimensions, const unsigned char* points,
  const unsigned char* cells, std::int64_t firstRow, std::int64_t lastRow, unsigned char* flags)
{
  const std::int64_t columns = std::max(1, dimensions[0] - 1);
  const std::int64_t rows = std::max(1, dimensions[1] - 1);
  const std::int64_t rowStep = dimensions[0];
  const std::int64_t planeStep = rowStep * dimensions[1];
  // From the first point of a cell to each of its points.
  std::array<std::int64_t, 8> corners{};
  std::size_t count = 1;
  const std::array<std::int64_t, 3> steps = { 1, rowStep, planeStep };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = 0; dimensions[axis] > 1 && i < count; ++i)
    {
      corners[count + i] = corners[i] + steps[axis];
    }
    count *= dimensions[axis] > 1 ? 2 : 1;
  }
  for (std::int64_t row = firstRow; row < lastRow; ++row)
  {
    const unsigned char* first = points + row % rows * rowStep + row / rows * planeStep;
    for (std::int64_t i = 0; i < columns; ++i)
    {
      unsigned char any = 0;
      for (std::size_t corner = 0; corner < count; ++corner)
      {
        any |= first[i + corners[corner]];
      }
      const std::int64_t cell = row * columns + i;
      const unsigned char own = cells ? cells[cell] : 0;
      flags[cell] = (any & vtkDataSetAttributes::HIDDENPOINT) ? ghostCell : own;
    }
  }
}

CountedPoints::CountedPoints(vtkDataSet* points, const char* what, unsigned char ghosts)
  : CountedPoints(
      points->GetNumberOfPoints(), ghostFlags(points, vtkDataObject::POINT, what), ghosts)
{
}

CountedPoints::CountedPoints(std::int64_t all, const unsigned char* flags, unsigned char ghosts)
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

} // namespace RectifiedTransport::Bridge

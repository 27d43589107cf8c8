// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/ShapeColours.h"

#include "vtkAbstractArray.h"
#include "vtkNew.h"
#include "vtkScalarsToColors.h"

#include <array>
#include <cstddef>

namespace RectifiedTransport::Bridge
{

bool areColours(vtkAbstractArray* array)
{
  const int components = array->GetNumberOfComponents();
  return vtkUnsignedCharArray::SafeDownCast(array) && (components == 3 || components == 4);
}

ShapeColours::ShapeColours(vtkAbstractArray* array, bool onPoints, vtkScalarsToColors* table)
  : OnPoints(onPoints)
{
  if (areColours(array))
  {
    this->Bytes = vtkUnsignedCharArray::SafeDownCast(array);
    return;
  }
  vtkNew<vtkUnsignedCharArray> numbers; // VTK leaves the colours of vectors of bits unset
  const bool areBits = array->GetDataType() == VTK_BIT;
  if (areBits)
  {
    numbers->DeepCopy(array);
  }
  // Component -1: that of the table, or the magnitude.
  constexpr int component = -1;
  this->Bytes.TakeReference(
    table->MapScalars(areBits ? numbers.Get() : array, VTK_COLOR_MODE_MAP_SCALARS, component));
}

Colour ShapeColours::Of(const Shape& shape) const
{
  if (!this->Bytes || (!this->OnPoints && shape.Cell < 0))
  {
    return {};
  }
  const vtkIdType* tuples = this->OnPoints ? shape.Points : &shape.Cell;
  const vtkIdType count = this->OnPoints ? shape.Count : 1;
  const int components = this->Bytes->GetNumberOfComponents();
  std::array<vtkIdType, 4> sums{};
  for (vtkIdType i = 0; i < count; ++i)
  {
    const unsigned char* bytes = this->Bytes->GetPointer(tuples[i] * components);
    for (int c = 0; c < 4; ++c)
    {
      sums[static_cast<std::size_t>(c)] += c < components ? bytes[c] : 255;
    }
  }
  const auto mean = [&](std::size_t component) {
    return static_cast<std::uint8_t>((sums[component] + count / 2) / count);
  };
  return { mean(0), mean(1), mean(2), mean(3) };
}

} // namespace RectifiedTransport::Bridge

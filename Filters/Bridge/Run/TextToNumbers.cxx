// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/TextToNumbers.h"

#include "Bridge/Run/Memory.h"
#include "Core/Messages/NumberText.h"

#include "vtkAbstractArray.h"
#include "vtkDoubleArray.h"
#include "vtkStringArray.h"
#include "vtkVariant.h"

#include <cstdint>
#include <limits>
#include <sstream>

namespace RectifiedTransport::Bridge
{

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

// A value of an array that is not numeric: a text, or a variant, which may hold a number.
struct Text
{
  std::string Letters;
  std::optional<double> Number;
};

Text textAt(vtkAbstractArray* array, vtkIdType value)
{
  if (auto* texts = vtkStringArray::SafeDownCast(array))
  {
    return { texts->GetValue(value), std::nullopt };
  }
  const vtkVariant variant = array->GetVariantValue(value);
  return { variant.ToString(),
    variant.IsNumeric() ? std::optional<double>(variant.ToDouble()) : std::nullopt };
}

} // namespace

TextToNumbers parseNumbers(vtkAbstractArray* array, bool emptyIsNaN,
  const std::function<std::string(vtkIdType tuple)>& placeOf)
{
  TextToNumbers found;
  found.Array = vtkDataArray::SafeDownCast(array);
  if (found.Array || !array)
  {
    return found;
  }
  const int components = array->GetNumberOfComponents();
  const vtkIdType count = array->GetNumberOfValues();
  const auto made = newArray<vtkDoubleArray>(
    array->GetName() ? array->GetName() : "", components, array->GetNumberOfTuples());
  made->SetName(array->GetName());
  std::int64_t wrong = 0;
  std::string first;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Text text = textAt(array, i);
    const bool isMissing = emptyIsNaN && isBlank(text.Letters);
    const std::optional<double> number = text.Number ? text.Number
      : isMissing                                    ? std::optional<double>(notANumber)
                                                     : parseNumber(text.Letters);
    made->SetValue(i, number.value_or(notANumber));
    if (!number && wrong++ == 0)
    {
      const vtkIdType tuple = i / components;
      first = "'" + shortened(text.Letters) + "' " +
        (placeOf ? placeOf(tuple) : "at index " + std::to_string(tuple));
    }
  }
  if (wrong > 0)
  {
    std::ostringstream text;
    text << wrong << " of " << count
         << (wrong == 1 ? " texts is no number: " : " texts are no numbers, the first ") << first;
    found.Wrong = text.str();
    return found;
  }
  found.Array = made;
  return found;
}

} // namespace RectifiedTransport::Bridge

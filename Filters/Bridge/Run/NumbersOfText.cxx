// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/NumbersOfText.h"

#include "Bridge/Run/Memory.h"

#include "vtkAbstractArray.h"
#include "vtkDoubleArray.h"
#include "vtkStringArray.h"
#include "vtkVariant.h"

#include <charconv>
#include <cstdint>
#include <limits>
#include <sstream>
#include <system_error>

namespace RectifiedTransport::Bridge
{

namespace
{

const char* const blanks = " \t\r\n\f\v";

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

std::string shortened(const std::string& text)
{
  constexpr std::size_t most = 40;
  return text.size() > most ? text.substr(0, most) + "..." : text;
}

} // namespace

std::optional<double> numberOfText(const std::string& text)
{
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos)
  {
    return std::nullopt;
  }
  const char* first = text.data() + begin;
  const char* last = text.data() + text.find_last_not_of(blanks) + 1;
  // from_chars takes a minus alone.
  if (*first == '+' && last - first > 1 && first[1] != '-')
  {
    ++first;
  }
  double number = 0.0;
  std::from_chars_result read = std::from_chars(first, last, number);
  if (read.ec == std::errc::result_out_of_range)
  {
    // Infinite past the largest double, 0 below the least one, as literals are.
    long double wide = 0.0L;
    read = std::from_chars(first, last, wide);
    number = static_cast<double>(wide);
  }
  return read.ec == std::errc() && read.ptr == last ? std::optional<double>(number) : std::nullopt;
}

NumbersOfText numbersOf(vtkAbstractArray* array, bool emptyIsNaN,
  const std::function<std::string(vtkIdType tuple)>& placeOf)
{
  NumbersOfText found;
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
    const bool isMissing =
      emptyIsNaN && text.Letters.find_first_not_of(blanks) == std::string::npos;
    const std::optional<double> number = text.Number ? text.Number
      : isMissing                                    ? std::optional<double>(notANumber)
                                                     : numberOfText(text.Letters);
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

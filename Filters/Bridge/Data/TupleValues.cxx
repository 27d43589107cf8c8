// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/TupleValues.h"

#include "Core/Messages/PropertyCheck.h"

#include "vtkAbstractArray.h"
#include "vtkBitArray.h"
#include "vtkVariant.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace RectifiedTransport::Bridge
{

namespace
{

template <class T>
void appendBytes(std::string& key, T value)
{
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  key.append(bytes, sizeof(T));
}

bool isReal(const vtkVariant& value)
{
  return value.IsDouble() || value.IsFloat();
}

// visit(value) of the components. VTK has no variants of bits.
template <class Visit>
void forComponents(vtkAbstractArray* array, vtkIdType tuple, const Visit& visit)
{
  const int components = array->GetNumberOfComponents();
  auto* const bits = vtkBitArray::SafeDownCast(array);
  for (int c = 0; c < components; ++c)
  {
    const vtkIdType value = tuple * components + c;
    visit(bits ? vtkVariant(bits->GetValue(value)) : array->GetVariantValue(value));
  }
}

// vtkVariant gives numbers of one byte as letters, and real numbers with six digits.
std::string textOfValue(const vtkVariant& value)
{
  if (value.IsFloat())
  {
    return textOf(value.ToFloat());
  }
  if (value.IsDouble())
  {
    return textOf(value.ToDouble());
  }
  const bool isByte = value.IsChar() || value.IsSignedChar() || value.IsUnsignedChar();
  return isByte ? std::to_string(value.ToInt()) : static_cast<std::string>(value.ToString());
}

} // namespace

void appendTupleKey(vtkAbstractArray* array, vtkIdType tuple, std::string& key)
{
  forComponents(array, tuple, [&key](const vtkVariant& value) {
    appendBytes(key, static_cast<unsigned char>(value.GetType())); // an array may have several
    if (isReal(value))
    {
      const double number = value.ToDouble() + 0.0; // -0 becomes 0
      appendBytes(key, std::isnan(number) ? std::numeric_limits<double>::quiet_NaN() : number);
    }
    else if (value.IsNumeric())
    {
      appendBytes(key, static_cast<std::int64_t>(value.ToTypeInt64())); // wraps, one to one
    }
    else
    {
      const std::string text = value.ToString();
      appendBytes(key, text.size());
      key += text;
    }
  });
}

std::string tupleText(vtkAbstractArray* array, vtkIdType tuple)
{
  std::string text;
  const char* separator = "";
  forComponents(array, tuple, [&](const vtkVariant& value) {
    text += separator;
    text += textOfValue(value);
    separator = ", ";
  });
  return text;
}

} // namespace RectifiedTransport::Bridge

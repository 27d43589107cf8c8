// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/TupleValues.h"

#include "Bridge/Run/PropertyCheck.h"

#include "vtkAbstractArray.h"
#include "vtkVariant.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace RectifiedTransport
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

// visit(value) of the components.
template <class Visit>
void forComponents(vtkAbstractArray* array, vtkIdType tuple, const Visit& visit)
{
  const int components = array->GetNumberOfComponents();
  for (int c = 0; c < components; ++c)
  {
    visit(array->GetVariantValue(tuple * components + c));
  }
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
    text += value.IsFloat() ? textOf(value.ToFloat())
      : value.IsDouble()    ? textOf(value.ToDouble())
                            : static_cast<std::string>(value.ToString());
    separator = ", ";
  });
  return text;
}

} // namespace RectifiedTransport

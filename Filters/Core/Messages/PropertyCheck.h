// SPDX-License-Identifier: BSD-3-Clause
// Checks of values of properties; the message of the Failure is one sentence that names the
// property, its value and the valid range.
#ifndef RectifiedTransport_PropertyCheck_h
#define RectifiedTransport_PropertyCheck_h

#include "Core/Messages/Failure.h"

#include <cstddef>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>

namespace RectifiedTransport
{

// All digits of a number if 6 digits round it to another one, possibly one in range.
template <class T>
std::string textOf(T value)
{
  std::ostringstream text;
  text << value;
  if constexpr (std::is_floating_point_v<T>)
  {
    if (static_cast<T>(std::strtod(text.str().c_str(), nullptr)) != value && value == value)
    {
      text.str("");
      text << std::setprecision(std::numeric_limits<T>::max_digits10) << value;
    }
  }
  return text.str();
}

// `rule` completes "it must be ...".
template <class T>
void requireThat(bool holds, const char* property, T value, const char* rule)
{
  if (holds)
  {
    return;
  }
  throw Failure(property + (" is " + textOf(value)) + "; it must be " + rule);
}

// Returns the text of a value of an enumeration, for example for PrintSelf.
template <std::size_t Count>
const char* choiceText(const char* const (&texts)[Count], int value)
{
  return value >= 0 && static_cast<std::size_t>(value) < Count ? texts[value] : "Unknown";
}

// Throws a Failure that lists all valid values with their texts.
template <std::size_t Count>
void requireChoice(const char* property, int value, const char* const (&texts)[Count])
{
  if (value >= 0 && static_cast<std::size_t>(value) < Count)
  {
    return;
  }
  std::ostringstream message;
  message << property << " is " << value << "; it must be ";
  for (std::size_t i = 0; i < Count; ++i)
  {
    message << (i == 0 ? "" : i + 1 < Count ? ", " : " or ") << i << " (" << texts[i] << ")";
  }
  throw Failure(message.str());
}

} // namespace RectifiedTransport

#endif

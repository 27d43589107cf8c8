// SPDX-License-Identifier: BSD-3-Clause
// Checks of values of properties; the message of the Failure is one sentence that names the
// property, its value and the valid range.
#ifndef RectifiedTransport_PropertyCheck_h
#define RectifiedTransport_PropertyCheck_h

#include "Core/Parallel/Errors/Failure.h"

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

} // namespace RectifiedTransport

#endif

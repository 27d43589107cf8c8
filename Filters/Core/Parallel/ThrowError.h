// SPDX-License-Identifier: BSD-3-Clause
// Errors whose message is made of texts and numbers.
#ifndef RectifiedTransport_ThrowError_h
#define RectifiedTransport_ThrowError_h

#include <sstream>
#include <stdexcept>

namespace RectifiedTransport
{

// Throws an error with these values as text, one after the other.
template <class Error = std::runtime_error, class... Values>
[[noreturn]] void throwError(const Values&... values)
{
  std::ostringstream message;
  (message << ... << values);
  throw Error(message.str());
}

} // namespace RectifiedTransport

#endif

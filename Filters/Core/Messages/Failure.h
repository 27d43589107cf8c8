// SPDX-License-Identifier: BSD-3-Clause
// The exception for errors of input data and properties.
#ifndef RectifiedTransport_Failure_h
#define RectifiedTransport_Failure_h

#include <sstream>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

// An error that the user can correct; what() is its one-line message.
class Failure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
  // For one of several inputs: its name precedes the message.
  Failure(const std::string& name, const Failure& failure)
    : std::runtime_error(name + ": " + failure.what())
  {
  }
};

// Returns what `function` returns; `name` precedes the message of a Failure that it throws.
template <class Function>
auto withName(const std::string& name, const Function& function)
{
  try
  {
    return function();
  }
  catch (const Failure& failure)
  {
    throw Failure(name, failure);
  }
}

// Throws a Failure with these values as text, one after the other.
template <class... Values>
[[noreturn]] void fail(const Values&... values)
{
  std::ostringstream message;
  (message << ... << values);
  throw Failure(message.str());
}

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The exception for errors of input data and properties.
#ifndef RectifiedTransport_Failure_h
#define RectifiedTransport_Failure_h

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

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// How a run ends early.
#ifndef RectifiedTransport_Failure_h
#define RectifiedTransport_Failure_h

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

// Something that the user can put right, said as one clear line.
class Failure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
  // One that concerns one of several things.
  Failure(const std::string& name, const Failure& failure)
    : std::runtime_error(name + ": " + failure.what())
  {
  }
};

} // namespace RectifiedTransport

#endif

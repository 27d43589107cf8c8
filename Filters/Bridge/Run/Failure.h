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
};

// Runs a function whose failures concern one of several things, and say which.
template <class Function>
void nameFailures(const std::string& name, Function&& function)
{
  try
  {
    function();
  }
  catch (const Failure& failure)
  {
    throw Failure(name + ": " + failure.what());
  }
}

} // namespace RectifiedTransport

#endif

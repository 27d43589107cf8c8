// SPDX-License-Identifier: BSD-3-Clause
// What is said of arguments that are refused.
#ifndef RectifiedTransport_TestRefusal_h
#define RectifiedTransport_TestRefusal_h

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

template <class F>
std::string refusal(F&& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  ADD_FAILURE() << "the arguments were accepted";
  return "";
}

} // namespace RectifiedTransport

#endif

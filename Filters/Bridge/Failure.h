// SPDX-License-Identifier: BSD-3-Clause
// How a run ends early.
#ifndef RectifiedTransport_Failure_h
#define RectifiedTransport_Failure_h

#include <stdexcept>

namespace RectifiedTransport
{

// Something that the user can put right, said as one clear line.
class Failure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// The host asked to stop.
class Aborted
{
};

} // namespace RectifiedTransport

#endif

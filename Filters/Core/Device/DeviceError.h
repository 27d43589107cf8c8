// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_DeviceError_h
#define RectifiedTransport_DeviceError_h

#include <stdexcept>

namespace RectifiedTransport
{

// A device cannot be used, or failed. The message names it and says why; the processor can do the
// work instead.
class DeviceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// It failed while it worked, and must be opened anew.
class LostDevice : public DeviceError
{
public:
  using DeviceError::DeviceError;
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// What filters have in place of this library where it is not built.
#include "Devices/SharedDevices.h"

namespace RectifiedTransport
{

DeviceUse CachedDevice::Begin(const std::string&, int)
{
  return DeviceUse(
    std::string("This library was built without OpenCL (the header CL/cl.h was missing)"));
}

std::vector<std::string> deviceNames()
{
  return {};
}

} // namespace RectifiedTransport

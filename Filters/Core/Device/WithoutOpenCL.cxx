// SPDX-License-Identifier: BSD-3-Clause
// In place of the other sources of this folder where the headers of OpenCL are missing.
#include "Core/Device/DeviceError.h"
#include "Core/Device/DeviceList.h"
#include "Core/Device/DeviceUse.h"

namespace RectifiedTransport
{

class Device
{
};

std::vector<DeviceDescription> listDevices()
{
  return {};
}

namespace
{

constexpr const char* notBuilt =
  "This library was built without OpenCL (the header CL/cl.h was missing)";

} // namespace

std::shared_ptr<Device> openDevice(
  const std::string&, int, const std::vector<std::shared_ptr<Device>>&)
{
  throw DeviceError(notBuilt);
}

DeviceUse DeviceUse::Open(const std::string&)
{
  return DeviceUse(std::string(notBuilt));
}

bool DeviceUse::Run(const std::function<void(Device&)>&, const std::function<bool()>&)
{
  return false;
}

bool isLost(const Device&)
{
  return false;
}

} // namespace RectifiedTransport

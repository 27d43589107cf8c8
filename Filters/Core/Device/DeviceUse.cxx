// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Device/DeviceUse.h"

#include "Core/Device/Device.h"

#include <mutex>

namespace RectifiedTransport
{

DeviceUse DeviceUse::Open(const std::string& name)
{
  try
  {
    return DeviceUse(openDevice(name));
  }
  catch (const DeviceError& error)
  {
    return DeviceUse(std::string(error.what()));
  }
}

bool DeviceUse::Run(const std::function<void(Device&)>& function)
{
  if (!this->Serves())
  {
    return false;
  }
  const std::lock_guard<std::mutex> lock(this->Opened->Mutex());
  try
  {
    function(*this->Opened);
    return true;
  }
  catch (const DeviceError& error)
  {
    this->Reason = error.what();
    return false;
  }
}

} // namespace RectifiedTransport

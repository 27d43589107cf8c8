// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Device/DeviceUse.h"

#include "Core/Device/DeviceError.h"
#include "Core/Device/FlowDevice.h"

#include <chrono>
#include <mutex>

namespace RectifiedTransport
{

// Runs take turns on a device. A run that waits polls for an abort every 20 ms, below what a user
// notices.
bool DeviceUse::Run(const std::function<void()>& function, const std::function<bool()>& shouldStop)
{
  if (!this->Serves())
  {
    return false;
  }
  constexpr std::chrono::milliseconds interval(20);
  std::unique_lock<std::timed_mutex> lock(this->Opened->Mutex(), std::defer_lock);
  while (!lock.try_lock_for(interval))
  {
    if (shouldStop && shouldStop())
    {
      return false;
    }
  }
  try
  {
    if (this->Opened->IsLost())
    {
      // Another run may have lost the device while this one waited.
      throw DeviceError("The device '" + this->Opened->Name() + "' was lost");
    }
    function();
    return true;
  }
  // A lost device serves no run any more; after other errors it may serve the next one.
  catch (const LostDevice& error)
  {
    this->Opened->MarkLost();
    this->Reason = error.what();
  }
  catch (const DeviceError& error)
  {
    this->Reason = error.what();
  }
  return false;
}

} // namespace RectifiedTransport

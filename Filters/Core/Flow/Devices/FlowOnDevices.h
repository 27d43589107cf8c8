// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_FlowOnDevices_h
#define RectifiedTransport_FlowOnDevices_h

#include "Core/Device/DeviceUse.h"
#include "Core/Device/FlowDevice.h"
#include "Core/Flow/Devices/DeviceFlow.h"

#include <memory>
#include <mutex>

namespace RectifiedTransport
{

// Where a flow is on devices: on the last one that it ran on. The device owns what it keeps, so
// that a flow that nobody runs on it any more does not hold it open.
template <int Dimension>
class FlowOnDevices
{
public:
  FlowOnDevices() = default;
  ~FlowOnDevices() { this->Leave(); }
  FlowOnDevices(const FlowOnDevices&) = delete;
  FlowOnDevices& operator=(const FlowOnDevices&) = delete;

  // The flow on the device of `use`, which must outlive it; null if that is null or does not serve,
  // and in 1D.
  std::shared_ptr<DeviceFlow<Dimension>> On(const DeviceUse* use)
  {
    std::shared_ptr<DeviceFlow<Dimension>> flow;
    const std::shared_ptr<FlowDevice> device = use ? use->Device() : nullptr;
    if constexpr (Dimension > 1)
    {
      if (device)
      {
        const std::lock_guard<std::mutex> lock(this->Mutex);
        // Two devices do not keep the same flow.
        if (this->Where.lock() != device)
        {
          this->Leave();
          this->Where = device;
        }
        device->Find(this, flow);
      }
    }
    return flow;
  }

private:
  void Leave()
  {
    if (const std::shared_ptr<FlowDevice> device = this->Where.lock())
    {
      device->Forget(this);
    }
  }

  std::mutex Mutex; // guards Where: flows run on several threads
  std::weak_ptr<FlowDevice> Where;
};

} // namespace RectifiedTransport

#endif

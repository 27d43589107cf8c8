// SPDX-License-Identifier: BSD-3-Clause
// The device that a run may use, and why it did not serve.
#ifndef RectifiedTransport_DeviceUse_h
#define RectifiedTransport_DeviceUse_h

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace RectifiedTransport
{

class FlowDevice;

// The use of a device by one run, on one thread; a device may serve many runs. The processor does
// what the device does not do, with the same bits.
class DeviceUse
{
public:
  // An open device (Devices/DeviceList.h).
  explicit DeviceUse(std::shared_ptr<FlowDevice> device)
    : Opened(std::move(device))
  {
  }
  // There is none, for a reason.
  explicit DeviceUse(std::string fault)
    : Reason(std::move(fault))
  {
  }

  // Whether there is a device that has not failed in this run.
  bool Serves() const { return this->Opened && this->Reason.empty(); }
  // Why it does not serve, or not any more: names the device. Empty if nothing went wrong.
  const std::string& Fault() const { return this->Reason; }
  // The device, as long as it serves; else null.
  std::shared_ptr<FlowDevice> Device() const { return this->Serves() ? this->Opened : nullptr; }

  // function(), when no other thread uses the device, unless shouldStop(), which is polled
  // meanwhile, returns true. Returns whether it was done: a DeviceError becomes the fault. Throws
  // what else the function throws.
  bool Run(const std::function<void()>& function, const std::function<bool()>& shouldStop = {});

private:
  std::shared_ptr<FlowDevice> Opened;
  std::string Reason;
};

} // namespace RectifiedTransport

#endif

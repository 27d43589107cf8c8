// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_FlowDevice_h
#define RectifiedTransport_FlowDevice_h

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

namespace RectifiedTransport
{

template <int Dimension>
class DeviceFlow;

// An open device that computes flows, as other libraries make them. DeviceUse lets one thread at a
// time use it.
class FlowDevice
{
public:
  FlowDevice() = default;
  virtual ~FlowDevice() = default;
  FlowDevice(const FlowDevice&) = delete;
  FlowDevice& operator=(const FlowDevice&) = delete;

  virtual const std::string& Name() const = 0;
  // Whether it failed while it worked: it is of no use any more.
  virtual bool IsLost() const { return this->HasFailed; }
  void MarkLost() { this->HasFailed = true; }
  // To be locked by whoever uses it. What it keeps may be looked for and go without it.
  std::timed_mutex& Mutex() { return this->InUse; }

  // The flow that it keeps for an owner, which its address identifies: a new one at first. Owners
  // call Forget in their destructors. Flows must not outlive the device.
  virtual void Find(const void* owner, std::shared_ptr<DeviceFlow<2>>& flow) = 0;
  virtual void Find(const void* owner, std::shared_ptr<DeviceFlow<3>>& flow) = 0;
  virtual void Forget(const void* owner) = 0;

private:
  std::timed_mutex InUse;
  std::atomic<bool> HasFailed{ false };
};

} // namespace RectifiedTransport

#endif

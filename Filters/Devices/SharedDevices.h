// SPDX-License-Identifier: BSD-3-Clause
// The OpenCL devices that are open in this process: all filters use one together.
#ifndef RectifiedTransport_SharedDevices_h
#define RectifiedTransport_SharedDevices_h

#include "Core/Device/DeviceUse.h"

#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// What a filter keeps of its device between runs: to open one takes about a second, and what the
// device keeps goes with its last owner.
class CachedDevice
{
public:
  // The device for a run, by a name and a number as those of openDevice (DeviceList.h): the one of
  // the last run, else one that another filter has open, else a new one; none of them lost. If
  // there is none, the result says why, and the next run tries again.
  DeviceUse Begin(const std::string& name, int number);
  // Lets go of it.
  void Release() { this->Opened.reset(); }

  std::shared_ptr<const FlowDevice> Get() const { return this->Opened; } // may be null

private:
  std::shared_ptr<FlowDevice> Opened;
  std::string Name;
  int Number = 0;
};

// The names of the devices of this machine that lack nothing, each once. Loads the driver.
std::vector<std::string> deviceNames();

} // namespace RectifiedTransport

#endif

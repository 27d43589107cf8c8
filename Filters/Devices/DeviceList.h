// SPDX-License-Identifier: BSD-3-Clause
// The OpenCL devices of this machine. Their driver is found when it is first asked for: programs
// are not linked to it, and it need not be there.
#ifndef RectifiedTransport_DeviceList_h
#define RectifiedTransport_DeviceList_h

#include "../Core/Device/DeviceUse.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{

struct DeviceDescription
{
  std::string Name;
  std::string Driver;       // the versions of the platform and of the driver
  std::uint64_t Memory = 0; // bytes
  std::string Lacks;        // what it cannot do that is needed; empty if nothing is known to be
};

// Lists the devices in the order of the driver; empty if there is no driver. Does not throw
// anything but std::bad_alloc.
std::vector<DeviceDescription> listDevices();

// Opens the device of number `number`, from 0 and modulo their count, among the devices whose names
// contain a text, in any case of letters, and that lack nothing. Those that are no processors are
// counted alone if there are any. If it fails the self-test of DeviceCheck.h, the next one is
// tried. A device in `open` is returned as it is. Throws DeviceError: no driver, no such device,
// one that lacks something or computes other bits than
// processors.
std::shared_ptr<FlowDevice> openDevice(const std::string& name, int number = 0,
  const std::vector<std::shared_ptr<FlowDevice>>& open = {});

// The use of the device that openDevice finds, or of none.
DeviceUse useDevice(const std::string& name);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/SharedDevices.h"

#include "Core/Device/DeviceError.h"
#include "Core/Device/FlowDevice.h"
#include "Devices/DeviceList.h"

#include <algorithm>
#include <mutex>

namespace RectifiedTransport
{

namespace
{

// The devices that are open in this process are found again.
std::shared_ptr<FlowDevice> findOrOpen(const std::string& name, int number)
{
  static std::mutex mutex;
  static std::vector<std::weak_ptr<FlowDevice>> entries;
  // Held while a device is opened: who asks for it meanwhile gets the same one.
  const std::lock_guard<std::mutex> lock(mutex);
  // Weak entries: a device closes when its last user lets it go.
  std::vector<std::shared_ptr<FlowDevice>> open;
  for (const std::weak_ptr<FlowDevice>& entry : entries)
  {
    if (std::shared_ptr<FlowDevice> device = entry.lock())
    {
      open.push_back(std::move(device));
    }
  }
  std::shared_ptr<FlowDevice> found = openDevice(name, number, open);
  if (std::find(open.begin(), open.end(), found) == open.end())
  {
    open.push_back(found);
  }
  entries.assign(open.begin(), open.end());
  return found;
}

} // namespace

DeviceUse CachedDevice::Begin(const std::string& name, int number)
{
  if (this->Opened && name == this->Name && number == this->Number && !this->Opened->IsLost())
  {
    return DeviceUse(this->Opened);
  }
  // The old device goes before the new one takes memory.
  this->Release();
  try
  {
    this->Opened = findOrOpen(name, number);
    this->Name = name;
    this->Number = number;
    return DeviceUse(this->Opened);
  }
  catch (const DeviceError& error)
  {
    return DeviceUse(std::string(error.what()));
  }
}

std::vector<std::string> deviceNames()
{
  std::vector<std::string> names;
  for (const DeviceDescription& device : listDevices())
  {
    // A name stands once, however many devices have it.
    if (device.Lacks.empty() && std::find(names.begin(), names.end(), device.Name) == names.end())
    {
      names.push_back(device.Name);
    }
  }
  return names;
}

} // namespace RectifiedTransport

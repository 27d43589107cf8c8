// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_DeviceCheck_h
#define RectifiedTransport_DeviceCheck_h

#include <string>

namespace RectifiedTransport
{

class Device;

// Whether arithmetic gives the bits that processors give: products and sums each rounded,
// divisions and roots rounded right, conversions between integers, floats and doubles, and floats
// that are smaller than the normal ones. Throws DeviceError that names the device and what it does
// otherwise. `before` is put before the program: tests make a wrong one by it.
void checkDevice(Device& device, const std::string& before = "");

} // namespace RectifiedTransport

#endif

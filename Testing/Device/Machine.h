// SPDX-License-Identifier: BSD-3-Clause
// The machine and its devices.
#ifndef RectifiedTransport_Machine_h
#define RectifiedTransport_Machine_h

#include <cstdint>

namespace RectifiedTransport
{

class Device;

void printMachine();
// All devices: what each lacks, or what its self-test says.
void printDevices();

bool isGpu(const Device& device);

} // namespace RectifiedTransport

#endif

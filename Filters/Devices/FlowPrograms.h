// SPDX-License-Identifier: BSD-3-Clause
// The programs of devices: the texts of Core/Flow/Kernels/Shared and of the kernels here, as the
// build puts them into this library.
#ifndef RectifiedTransport_FlowPrograms_h
#define RectifiedTransport_FlowPrograms_h

#include "Devices/Device.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{

// One after the other.
std::vector<std::string> flowProgramTexts();

// The program for a number of dimensions, 2 or 3, which the device keeps. It has passed a test: a
// few particles have the bits of a processor's. Throws DeviceError.
const DeviceProgram& flowProgram(Device& device, int dimension);
// The same without the test, if it is called first: to report what a device does that fails it.
const DeviceProgram& untestedFlowProgram(Device& device, int dimension);

// Compiles it, with further options. Throws DeviceError.
DeviceProgram buildFlowProgram(Device& device, int dimension, const std::string& options = "");

// That test. Throws DeviceError.
void checkFlowProgram(Device& device, const DeviceProgram& program, int dimension);

} // namespace RectifiedTransport

#endif

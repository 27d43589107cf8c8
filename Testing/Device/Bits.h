// SPDX-License-Identifier: BSD-3-Clause
// What a device computes against what the processor does, to the bit, kernel by kernel.
#ifndef RectifiedTransport_Bits_h
#define RectifiedTransport_Bits_h

#include "BitsTable.h"

#include <memory>

namespace RectifiedTransport
{

class Device;

// Small cases alone if `isQuick`, as in all of these.
void compareTables(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table);
void compareParticles(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table);
void compareNodes(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table);
void compareCompaction(const std::shared_ptr<Device>& device, bool isQuick, BitsTable& table);
// That a difference is found: prints what should differ.
void compareWrong(const std::shared_ptr<Device>& device);

} // namespace RectifiedTransport

#endif

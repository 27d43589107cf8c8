// SPDX-License-Identifier: BSD-3-Clause
// The property Corners: which points of a disk become the corners of the square.
#ifndef RectifiedTransport_CornerSettings_h
#define RectifiedTransport_CornerSettings_h

#include "Bridge/Settings/IndexedList.h"
#include "Core/Mesh/Repair/RepairedDisk.h"
#include "Core/Parameterization/SquareCorners.h"

#include <cstdint>

namespace RectifiedTransport::Bridge
{

// Without values the corners are automatic.
struct CornerSettings : IndexedList<std::int64_t>
{
  CornerSettings()
    : IndexedList("corners", "index of a corner", -1)
  {
  }

  // Throws Failure unless there are none or four.
  void Check() const;
  // The corners of a disk, from the given points of it; chosen automatically if there are none.
  // Throws Failure unless they are four different points of its boundary.
  SquareCorners Of(const RepairedDisk& disk) const;
};

} // namespace RectifiedTransport::Bridge

#endif

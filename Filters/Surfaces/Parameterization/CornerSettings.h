// SPDX-License-Identifier: BSD-3-Clause
// The points of a disk that become the corners of the square.
#ifndef RectifiedTransport_CornerSettings_h
#define RectifiedTransport_CornerSettings_h

#include "Surfaces/Mesh/Repair/RepairedDisk.h"
#include "Surfaces/Parameterization/SquareCorners.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

struct CornerSettings
{
  std::vector<std::int64_t> Points; // empty: automatic

  // Throws std::invalid_argument unless there are none or four.
  void Check() const;
  // The corners of a disk, from the given points of it; chosen automatically if there are none.
  // Throws std::invalid_argument unless they are four different points of its boundary.
  SquareCorners Of(const RepairedDisk& disk) const;
};

} // namespace RectifiedTransport

#endif

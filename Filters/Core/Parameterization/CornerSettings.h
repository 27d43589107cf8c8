// SPDX-License-Identifier: BSD-3-Clause
// The property Corners: which points of a disk become the corners of the square.
#ifndef RectifiedTransport_CornerSettings_h
#define RectifiedTransport_CornerSettings_h

#include "Core/Mesh/Repair/RepairedDisk.h"
#include "Core/Parameterization/SquareCorners.h"

#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{

struct CornerSettings
{
  // Far above 4; bounds the memory that SetCorner allocates.
  static constexpr int MaximumNumber = 1000000;

  std::vector<std::int64_t> Points; // empty: automatic

  int Number() const { return static_cast<int>(this->Points.size()); }
  // -1 if there is none.
  std::int64_t At(int index) const;
  // Return whether anything changed. Throw std::invalid_argument for arguments out of range.
  bool Resize(int count);
  bool Set(int index, std::int64_t point);

  // Throws std::invalid_argument unless there are none or four.
  void Check() const;
  // The corners of a disk, from the given points of it; chosen automatically if there are none.
  // Throws std::invalid_argument unless they are four different points of its boundary.
  SquareCorners Of(const RepairedDisk& disk) const;
  // The points for PrintSelf, each after a blank.
  std::string Text() const;
};

} // namespace RectifiedTransport

#endif

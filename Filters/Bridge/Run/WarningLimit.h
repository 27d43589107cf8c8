// SPDX-License-Identifier: BSD-3-Clause
// When a count of what was moved or left out is worth a warning.
#ifndef RectifiedTransport_WarningLimit_h
#define RectifiedTransport_WarningLimit_h

#include <cstdint>

namespace RectifiedTransport::Bridge
{

// Fewer than one in a thousand are in the field data alone: hosts show a warning in a window of
// its own.
inline bool isWorthWarning(std::int64_t count, std::int64_t all)
{
  return count > 0 && 1000 * count >= all;
}

// The same of an area.
inline bool isWorthWarning(double area, double all)
{
  return area > 0.0 && 1000.0 * area >= all;
}

} // namespace RectifiedTransport::Bridge

#endif

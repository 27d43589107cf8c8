// SPDX-License-Identifier: BSD-3-Clause
// A part of a whole as text for warnings.
#ifndef RectifiedTransport_PartText_h
#define RectifiedTransport_PartText_h

#include "Core/Parallel/PercentText.h"

#include <cstdint>
#include <sstream>
#include <string>

namespace RectifiedTransport::Bridge
{

// "12 of 8192 cells (0.146 %)".
inline std::string describePart(std::int64_t count, std::int64_t all, const char* what)
{
  std::ostringstream text;
  text.precision(3);
  text << count << " of " << all << ' ' << what << " ("
       << 100.0 * static_cast<double>(count) / static_cast<double>(all) << " %)";
  return text.str();
}

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Checks of properties that are enumerations, for RequestData.
#ifndef RectifiedTransport_BridgePropertyCheck_h
#define RectifiedTransport_BridgePropertyCheck_h

#include "Bridge/Run/Failure.h"
#include "Core/Geometry/GridSize.h"
#include "Core/Parallel/Errors/PropertyCheck.h"

#include <cstddef>
#include <sstream>

namespace RectifiedTransport::Bridge
{

using RectifiedTransport::requireThat;
using RectifiedTransport::textOf;

// The text of a value of an enumeration.
template <std::size_t Count>
const char* choiceText(const char* const (&texts)[Count], int value)
{
  return value >= 0 && static_cast<std::size_t>(value) < Count ? texts[value] : "Unknown";
}

template <std::size_t Count>
void requireChoice(const char* property, int value, const char* const (&texts)[Count])
{
  if (value >= 0 && static_cast<std::size_t>(value) < Count)
  {
    return;
  }
  std::ostringstream message;
  message << property << " is " << value << "; it must be ";
  for (std::size_t i = 0; i < Count; ++i)
  {
    message << (i == 0 ? "" : i + 1 < Count ? ", " : " or ") << i << " (" << texts[i] << ")";
  }
  throw Failure(message.str());
}

// A number of cells along an axis.
inline void requireResolution(const char* property, int resolution)
{
  const std::string rule = "from 1 to " + std::to_string(MaximumResolution);
  requireThat(
    resolution >= 1 && resolution <= MaximumResolution, property, resolution, rule.c_str());
}

} // namespace RectifiedTransport::Bridge

#endif

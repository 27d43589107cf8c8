// SPDX-License-Identifier: BSD-3-Clause
// What a warning says of the steps of a flow.
#ifndef RectifiedTransport_StepWarning_h
#define RectifiedTransport_StepWarning_h

#include "Core/Flow/FlowOptions.h"

#include <string>

namespace RectifiedTransport
{

// The text of a warning if a flow does not keep the AreaTolerance; else empty. `areParticles`: they
// show masses of larger blocks than those of 4 cells a side.
std::string stepWarning(const FlowReport& flow, const FlowOptions& options, FlowDirection direction,
  bool areParticles = false);

} // namespace RectifiedTransport

#endif

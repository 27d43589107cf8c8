// SPDX-License-Identifier: BSD-3-Clause
// How many steps a density needs (NumberOfSteps 0): enough that twice as many hardly change the
// areas, or the masses, of the images of some blocks of cells. Documentation/Flow.md has the rule.
#ifndef RectifiedTransport_AutomaticSteps_h
#define RectifiedTransport_AutomaticSteps_h

#include "Core/Flow/FlowEngine.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/Context.h"

namespace RectifiedTransport
{

// Depends on the engine's density, the direction and the integration's options alone. Collective.
// Throws Cancelled, and what the engine throws.
template <int Dimension>
StepChoice chooseSteps(FlowEngine<Dimension>& engine, const FlowOptions& options,
  FlowDirection direction, const Context& context);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_PlaceOnMachine_h
#define RectifiedTransport_PlaceOnMachine_h

#include "Core/Parallel/Ranks.h"

#include <string>

namespace RectifiedTransport::Bridge
{

// How many ranks of a group before this one run on a machine of the same name. Collective.
int placeOnMachine(const Ranks& ranks, const std::string& machine);

} // namespace RectifiedTransport::Bridge

#endif

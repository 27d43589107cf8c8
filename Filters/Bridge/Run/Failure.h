// SPDX-License-Identifier: BSD-3-Clause
// The exception for errors of input data and properties.
#ifndef RectifiedTransport_BridgeFailure_h
#define RectifiedTransport_BridgeFailure_h

#include "Core/Parallel/Errors/Failure.h"

namespace RectifiedTransport::Bridge
{

using RectifiedTransport::fail;
using RectifiedTransport::Failure;

} // namespace RectifiedTransport::Bridge

#endif

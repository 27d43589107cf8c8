// SPDX-License-Identifier: BSD-3-Clause
// The tables of a flow, with the check of their memory.
#ifndef RectifiedTransport_BridgeTableChoice_h
#define RectifiedTransport_BridgeTableChoice_h

#include "Bridge/Run/Memory.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Core/Flow/TableChoice.h"

namespace RectifiedTransport::Bridge
{

// The tables that were chosen. Throws Failure if tiles do not fit in memory.
inline FlowTables requireTables(const TableChoice& choice)
{
  if (choice.Tables == FlowTables::Tiled)
  {
    requireMemory(choice.Memory);
  }
  return choice.Tables;
}

} // namespace RectifiedTransport::Bridge

#endif

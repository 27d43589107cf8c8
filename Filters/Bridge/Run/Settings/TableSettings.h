// SPDX-License-Identifier: BSD-3-Clause
// The property Tables.
#ifndef RectifiedTransport_TableSettings_h
#define RectifiedTransport_TableSettings_h

#include "Core/Flow/TableChoice.h"
#include "Core/Messages/PropertyCheck.h"

namespace RectifiedTransport::Bridge
{

// Indexed by vtkTransportAlgorithm::TablesType.
constexpr const char* TablesTexts[] = { "Auto", "Whole", "Tiled" };

// Throws Failure for a value out of range.
inline TableSetting tableSetting(int tables)
{
  requireChoice("Tables", tables, TablesTexts);
  return static_cast<TableSetting>(tables);
}

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The property Association.
#ifndef RectifiedTransport_AssociationSettings_h
#define RectifiedTransport_AssociationSettings_h

#include "Core/Messages/PropertyCheck.h"

namespace RectifiedTransport::Bridge
{

constexpr const char* AssociationTexts[] = { "Points", "Cells" };

// Throws Failure for a value out of range.
inline bool isOnPoints(int association)
{
  requireChoice("Association", association, AssociationTexts);
  return association == 0;
}

} // namespace RectifiedTransport::Bridge

#endif

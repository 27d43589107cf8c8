// SPDX-License-Identifier: BSD-3-Clause
// The field data of the first rank, on all of them.
#ifndef RectifiedTransport_FieldBroadcast_h
#define RectifiedTransport_FieldBroadcast_h

#include "Bridge/VTKCompatibility.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkFieldData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Replaces the fields of each rank by those of the first one. Collective.
void broadcastFields(vtkFieldData* fields, const Ranks& ranks);

} // namespace RectifiedTransport::Bridge

#endif

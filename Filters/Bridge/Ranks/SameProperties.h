// SPDX-License-Identifier: BSD-3-Clause
// The properties of a filter that several ranks run together.
#ifndef RectifiedTransport_SameProperties_h
#define RectifiedTransport_SameProperties_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkObject;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Throws Failure if a property that PrintSelf prints after Threading is not the same on all ranks.
// Collective.
void requireSameProperties(vtkObject* filter, const Ranks& ranks);

} // namespace RectifiedTransport

#endif

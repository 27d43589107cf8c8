// SPDX-License-Identifier: BSD-3-Clause
// The names of the arrays of an input, for messages.
#ifndef RectifiedTransport_ArrayList_h
#define RectifiedTransport_ArrayList_h

#include "Bridge/VTKCompatibility.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSetAttributes;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// "a, b (point)", or "no point arrays": the numeric arrays. `owner` is "point" or "cell".
std::string listArrays(vtkDataSetAttributes* attributes, const std::string& owner);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Cell arrays that have several types in the blocks of a map.
#ifndef RectifiedTransport_UnifiedTypes_h
#define RectifiedTransport_UnifiedTypes_h

#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// A reader may give whole numbers for one file and real numbers or text for another. Arrays of one
// component that all parts with cells have get one type, which holds their values exactly: text
// where no type of numbers does. vtkAppendPolyData would leave them out.
void unifyTypes(const std::vector<vtkSmartPointer<vtkPolyData>>& parts);

} // namespace RectifiedTransport::Bridge

#endif

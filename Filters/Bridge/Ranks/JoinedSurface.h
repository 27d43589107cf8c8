// SPDX-License-Identifier: BSD-3-Clause
// A surface that was cut where the ranks' pieces meet.
#ifndef RectifiedTransport_JoinedSurface_h
#define RectifiedTransport_JoinedSurface_h

#include "Bridge/Ranks/GatheredParts.h"
#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Points of different parts whose coordinates differ by their rounding alone become that of the
// lowest part; those of one part stay apart. `all` has the points and cells of the parts in their
// order.
vtkSmartPointer<vtkPolyData> joinSurface(vtkPolyData* all, const std::vector<DataPart>& parts);

} // namespace RectifiedTransport

#endif

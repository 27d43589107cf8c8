// SPDX-License-Identifier: BSD-3-Clause
// Overlapping grids of adaptive mesh refinement.
#ifndef RectifiedTransport_RefinedGrids_h
#define RectifiedTransport_RefinedGrids_h

#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkOverlappingAMR;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// The grids with cells that finer ones cover marked as such: copies, which share the arrays; the
// grids themselves where some have ghost flags already, or where there is a single level. Throws
// Failure where boxes or spacings are not set, and for grids that are not as their boxes say.
vtkSmartPointer<vtkOverlappingAMR> withRefinedMarked(vtkOverlappingAMR* grids);

} // namespace RectifiedTransport

#endif

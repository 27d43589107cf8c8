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

class Ranks;

// The grids with cells that finer ones cover, on any rank, marked as such beside the flags that
// they have; they share the arrays. Throws Failure where boxes or spacings are not set, and, where
// no grid has flags, for grids that are not as their boxes say. Collective; nullptr for
// nullptr.
vtkSmartPointer<vtkOverlappingAMR> withRefinedMarked(vtkOverlappingAMR* grids, const Ranks& ranks);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Overlapping grids of adaptive mesh refinement.
#ifndef RectifiedTransport_RefinedCells_h
#define RectifiedTransport_RefinedCells_h

#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkOverlappingAMR;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// The grids, with the cells that finer grids cover on any rank marked as refined in addition to
// their flags. They share the arrays. Throws Failure if boxes or spacings are not set and, if no
// grid has flags, for grids that do not match their boxes. Collective. nullptr for nullptr.
vtkSmartPointer<vtkOverlappingAMR> markRefinedCells(vtkOverlappingAMR* grids, const Ranks& ranks);

} // namespace RectifiedTransport::Bridge

#endif

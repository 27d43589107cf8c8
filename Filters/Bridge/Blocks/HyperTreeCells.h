// SPDX-License-Identifier: BSD-3-Clause
// The leaves of hyper tree grids as cells.
#ifndef RectifiedTransport_HyperTreeCells_h
#define RectifiedTransport_HyperTreeCells_h

#include "Bridge/VTKCompatibility.h"

#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkHyperTreeGrid;
class vtkUnstructuredGrid;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// Voxels, pixels or lines, with the values of the cell arrays; leaves that the mask hides are left
// out. (vtkHyperTreeGridToUnstructuredGrid rounds coordinates to single precision.) Throws Failure
// if memory is short and, with a progress, Cancelled.
vtkSmartPointer<vtkUnstructuredGrid> cellsOfTrees(vtkHyperTreeGrid* grid, Progress* progress);

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The vtkCells that a move of the points inverts.
#ifndef RectifiedTransport_MeshInversion_h
#define RectifiedTransport_MeshInversion_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/InvertedCells.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Counts cells of as many dimensions as the grid: lines, polygons seen along the grid's normal, or
// volumes, by the simplices that VTK divides them into. Ghost cells do not count, nor cells that it
// cannot divide. `before` has the cells, `after` the moved points. Throws Failure and Cancelled.
InvertedCells countInvertedCells(
  const ImageGrid& grid, vtkPointSet* before, vtkPointSet* after, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif

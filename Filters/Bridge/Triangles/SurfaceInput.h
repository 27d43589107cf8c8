// SPDX-License-Identifier: BSD-3-Clause
// The surface of an input.
#ifndef RectifiedTransport_SurfaceInput_h
#define RectifiedTransport_SurfaceInput_h

#include "Bridge/VTKCompatibility.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class SurfaceInput
{
public:
  // A vtkPolyData is used as it is. A grid with cells of at most two dimensions, as Clip makes,
  // keeps all its points; its cells are in the order of vtkPolyData: vertices, lines, polygons,
  // strips. Other grids give their outer surface. Polls for abort. Throws Failure for a block of
  // another type and for cells with points that do not exist, and Cancelled.
  SurfaceInput(vtkDataObject* input, Progress& progress);

  // nullptr without an input or without points.
  vtkPolyData* Get() const { return this->Surface; }
  // The cell of the input for a cell of the surface.
  vtkIdType InputCellOf(vtkIdType cell) const
  {
    return this->Cells.empty() ? cell : this->Cells[static_cast<std::size_t>(cell)];
  }

private:
  vtkSmartPointer<vtkPolyData> Surface;
  std::vector<vtkIdType> Cells; // by cells of the surface; empty if these are the input's
};

} // namespace RectifiedTransport::Bridge

#endif

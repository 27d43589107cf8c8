// SPDX-License-Identifier: BSD-3-Clause
// The surface that an input is, or that a grid has.
#ifndef RectifiedTransport_SurfaceInput_h
#define RectifiedTransport_SurfaceInput_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class Progress;

class SurfaceInput
{
public:
  // A vtkPolyData as it is. A vtkUnstructuredGrid of cells of at most two dimensions, as Clip
  // makes, with all its points and its cells in the order of vtkPolyData: vertices, lines,
  // polygons, strips. Of other grids the outer surface. Polls for abort. Throws Failure for a block
  // of another type and for points that there are not, and Cancelled.
  SurfaceInput(vtkDataObject* input, Progress& progress);

  // For FillInputPortInformation: what the constructor takes.
  static void Require(vtkInformation* info);

  // nullptr where there is no input, or one without points.
  vtkPolyData* Get() const { return this->Surface; }
  // The cell of the input that a cell of the surface is.
  vtkIdType InputCellOf(vtkIdType cell) const
  {
    return this->Cells.size() > 0 ? this->Cells.data()[cell] : cell;
  }

private:
  vtkSmartPointer<vtkPolyData> Surface;
  LargeBuffer<vtkIdType> Cells; // by cells of the surface; empty where these are the input's
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Drawing/PolyDataShapes.h"

#include "Bridge/Points/CellCheck.h"

#include "vtkDataObject.h"

namespace RectifiedTransport::Bridge
{

PolyDataShapes::PolyDataShapes(vtkPolyData* data, const std::string& name)
  : Input(data)
  , HasCells(data->GetNumberOfCells() > 0)
  , GhostPoints(ghostFlags(data, vtkDataObject::POINT, name.c_str()))
  , GhostCells(ghostFlags(data, vtkDataObject::CELL, name.c_str()))
{
  requireReadableCells(data, name);
}

std::int64_t PolyDataShapes::Count() const
{
  return this->HasCells ? this->Input->GetNumberOfCells() : this->Input->GetNumberOfPoints();
}

} // namespace RectifiedTransport::Bridge

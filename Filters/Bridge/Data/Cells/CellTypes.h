// SPDX-License-Identifier: BSD-3-Clause
#ifndef RectifiedTransport_CellTypes_h
#define RectifiedTransport_CellTypes_h

#include "Bridge/VTKCompatibility.h"

#include "vtkDataArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

namespace RectifiedTransport::Bridge
{

// The array of the cells' types, whatever its length; nullptr if there is none.
inline vtkDataArray* cellTypesOf(vtkUnstructuredGrid* grid)
{
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_CELL_TYPES_OF_ANY_ARRAY
  return grid->GetCellTypes();
#else
  return grid->GetCellTypesArray();
#endif
}

} // namespace RectifiedTransport::Bridge

#endif

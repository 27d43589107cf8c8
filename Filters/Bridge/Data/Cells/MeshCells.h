// SPDX-License-Identifier: BSD-3-Clause
// The points and cells of a vtkDataSet, for the core.
#ifndef RectifiedTransport_MeshCells_h
#define RectifiedTransport_MeshCells_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Resampling/CellSet.h"

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <string>

namespace RectifiedTransport::Bridge
{

class MeshCells final : public CellSet
{
public:
  // Throws Failure for ghost arrays of a wrong length; `name` is that of the data set in messages.
  MeshCells(vtkDataSet* data, const std::string& name);

  std::unique_ptr<CellReader> Read() const override;

private:
  const vtkSmartPointer<vtkDataSet> Data;
};

// The largest dimension of the cells of a data set.
int largestCellDimension(vtkDataSet* data);

} // namespace RectifiedTransport::Bridge

#endif

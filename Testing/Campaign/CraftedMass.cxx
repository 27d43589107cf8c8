// SPDX-License-Identifier: BSD-3-Clause
// What VTK integrates, where it can: it does not look at the ids of a data set.
#include "Crafted.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIntegrateAttributes.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace Campaign
{

namespace
{

bool areFinite(vtkDataSet* data)
{
  double bounds[6];
  data->GetBounds(bounds);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double x[3];
    data->GetPoint(i, x);
    if (!(std::abs(x[0]) < 1e6 && std::abs(x[1]) < 1e6 && std::abs(x[2]) < 1e6))
    {
      return false;
    }
  }
  return true;
}

} // namespace

Mass integralOf(vtkDataObject* object)
{
  auto* data = vtkDataSet::SafeDownCast(object);
  auto* surface = vtkPolyData::SafeDownCast(object);
  if (surface && surface->GetNumberOfLines() > 0)
  {
    return {}; // of closed lines, what they are around counts
  }
  vtkDataArray* values = data ? data->GetCellData()->GetArray("v") : nullptr;
  if (!values || values->GetNumberOfComponents() != 1 || data->GetNumberOfCells() == 0 ||
    values->GetNumberOfTuples() != data->GetNumberOfCells() || !areFinite(data))
  {
    return {};
  }
  vtkNew<vtkIntegrateAttributes> integral;
  integral->SetInputData(data);
  integral->Update();
  vtkCellData* sums = vtkDataSet::SafeDownCast(integral->GetOutputDataObject(0))->GetCellData();
  vtkDataArray* sum = sums->GetArray("v");
  vtkDataArray* measure = sums->GetArray("Volume");
  measure = measure ? measure : sums->GetArray("Area");
  measure = measure ? measure : sums->GetArray("Length");
  if (!sum || sum->GetNumberOfTuples() != 1 || !measure)
  {
    return {};
  }
  return { sum->GetComponent(0, 0), true };
}

} // namespace Campaign

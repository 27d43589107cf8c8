// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/JoinedSurface.h"

#include "Bridge/Points/DoubleTuples.h"
#include "Core/Mesh/MergePoints.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <cstdint>

namespace RectifiedTransport
{

namespace
{

// Of each point the one that it becomes.
std::vector<std::int64_t> pointsToKeep(vtkPolyData* all, const std::vector<DataPart>& parts)
{
  const std::int64_t count = all->GetNumberOfPoints();
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const DoubleTuples points(all->GetPoints()->GetData(), progress);
  std::vector<std::int64_t> becomes(static_cast<std::size_t>(count));
  mergePoints({ points.data(), count }, becomes.data(), Context(serial));
  std::int64_t first = 0;
  for (const DataPart& part : parts)
  {
    const std::int64_t end = first + part.Data->GetNumberOfPoints();
    for (std::int64_t i = first; i < end; ++i)
    {
      std::int64_t& point = becomes[static_cast<std::size_t>(i)];
      point = point < first ? point : i;
    }
    first = end;
  }
  return becomes;
}

vtkSmartPointer<vtkCellArray> withPoints(
  vtkCellArray* cells, const std::vector<vtkIdType>& newPoints)
{
  auto made = vtkSmartPointer<vtkCellArray>::New();
  made->AllocateExact(cells->GetNumberOfCells(), cells->GetNumberOfConnectivityIds());
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, corners);
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
    {
      corners->SetId(i, newPoints[static_cast<std::size_t>(corners->GetId(i))]);
    }
    made->InsertNextCell(corners);
  }
  return made;
}

} // namespace

vtkSmartPointer<vtkPolyData> joinSurface(vtkPolyData* all, const std::vector<DataPart>& parts)
{
  const std::vector<std::int64_t> becomes = pointsToKeep(all, parts);
  vtkNew<vtkIdList> kept;
  vtkNew<vtkIdList> places;
  std::vector<vtkIdType> newPoints(becomes.size());
  for (std::size_t i = 0; i < becomes.size(); ++i)
  {
    const auto old = static_cast<vtkIdType>(i);
    if (becomes[i] == old)
    {
      newPoints[i] = kept->GetNumberOfIds();
      places->InsertNextId(newPoints[i]);
      kept->InsertNextId(old);
    }
    else
    {
      newPoints[i] = newPoints[static_cast<std::size_t>(becomes[i])];
    }
  }
  auto joined = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(all->GetPoints()->GetDataType());
  all->GetPoints()->GetPoints(kept, points);
  joined->SetPoints(points);
  joined->SetVerts(withPoints(all->GetVerts(), newPoints));
  joined->SetLines(withPoints(all->GetLines(), newPoints));
  joined->SetPolys(withPoints(all->GetPolys(), newPoints));
  joined->SetStrips(withPoints(all->GetStrips(), newPoints));
  joined->GetPointData()->CopyAllOn();
  joined->GetPointData()->CopyAllocate(all->GetPointData(), kept->GetNumberOfIds());
  joined->GetPointData()->CopyData(all->GetPointData(), kept, places);
  joined->GetCellData()->PassData(all->GetCellData());
  joined->GetFieldData()->ShallowCopy(all->GetFieldData());
  return joined;
}

} // namespace RectifiedTransport

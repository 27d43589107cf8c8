// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Ranks/JoinedSurface.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace RectifiedTransport
{

namespace
{

// Places that differ by less are rounded differently on ranks.
double roundingOf(vtkPolyData* all)
{
  double bounds[6];
  all->GetPoints()->GetBounds(bounds);
  double farthest = 0.0;
  for (const double bound : bounds)
  {
    farthest = std::max(farthest, std::abs(bound));
  }
  constexpr double units = 4.0;
  return units * farthest *
    (all->GetPoints()->GetDataType() == VTK_FLOAT ? std::numeric_limits<float>::epsilon()
                                                  : std::numeric_limits<double>::epsilon());
}

// Of each point the one that it becomes.
std::vector<vtkIdType> pointsToKeep(vtkPolyData* all, const std::vector<DataPart>& parts)
{
  std::vector<vtkIdType> becomes(static_cast<std::size_t>(all->GetNumberOfPoints()));
  vtkNew<vtkStaticPointLocator> places;
  places->SetDataSet(all);
  places->BuildLocator();
  const double rounding = roundingOf(all);
  vtkNew<vtkIdList> near;
  vtkIdType first = 0;
  for (const DataPart& part : parts)
  {
    const vtkIdType end = first + part.Data->GetNumberOfPoints();
    for (vtkIdType i = first; i < end; ++i)
    {
      vtkIdType point = i;
      double x[3];
      all->GetPoint(i, x);
      places->FindPointsWithinRadius(rounding, x, near);
      for (vtkIdType k = 0; k < near->GetNumberOfIds(); ++k)
      {
        const vtkIdType other = near->GetId(k);
        point = other < first ? std::min(point, other) : point;
      }
      becomes[static_cast<std::size_t>(i)] =
        point < i ? becomes[static_cast<std::size_t>(point)] : i;
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
  const std::vector<vtkIdType> becomes = pointsToKeep(all, parts);
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

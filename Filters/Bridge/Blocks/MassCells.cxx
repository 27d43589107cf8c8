// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Blocks/MassCells.h"

#include "Core/Parallel/Progress.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace RectifiedTransport::Bridge
{

namespace
{

using Eigen::Vector3d;

Vector3d pointAt(vtkDataSet* data, vtkIdType point)
{
  Vector3d x;
  data->GetPoint(point, x.data());
  return x;
}

// Finds the points of a line that ends where it begins.
bool isClosedLine(vtkDataSet* data, vtkIdType cell, vtkIdList* points)
{
  if (data->GetCellType(cell) != VTK_POLY_LINE)
  {
    return false;
  }
  data->GetCellPoints(cell, points);
  const vtkIdType count = points->GetNumberOfIds();
  return count > 2 &&
    (points->GetId(0) == points->GetId(count - 1) ||
      pointAt(data, points->GetId(0)) == pointAt(data, points->GetId(count - 1)));
}

bool isStraight(vtkDataSet* data, vtkIdList* points)
{
  constexpr double straightness = 1e-5; // of its length
  const Vector3d first = pointAt(data, points->GetId(0));
  Vector3d farthest = Vector3d::Zero();
  for (vtkIdType i = 1; i < points->GetNumberOfIds(); ++i)
  {
    const Vector3d x = pointAt(data, points->GetId(i)) - first;
    farthest = x.norm() > farthest.norm() ? x : farthest;
  }
  const double length = farthest.norm();
  double off = 0.0;
  for (vtkIdType i = 1; i < points->GetNumberOfIds() && length > 0.0; ++i)
  {
    const Vector3d x = pointAt(data, points->GetId(i)) - first;
    off = std::max(off, (x - farthest * (x.dot(farthest) / (length * length))).norm());
  }
  return !(off > straightness * length);
}

bool hasRegion(vtkDataSet* data, Progress& progress)
{
  constexpr vtkIdType cellsBetweenPolls = vtkIdType{ 1 } << 12;
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (cell % cellsBetweenPolls == 0)
    {
      progress.Check();
    }
    if (isClosedLine(data, cell, points) && !isStraight(data, points))
    {
      return true;
    }
  }
  return false;
}

} // namespace

bool MassCells::HasDimension(vtkDataSet* data, vtkIdType cell) const
{
  return dimensionOfCellType(data->GetCellType(cell)) ==
    (this->AreClosedLines ? 1 : this->Dimension);
}

bool MassCells::Find(vtkDataSet* data, vtkIdType cell, vtkIdList* points) const
{
  if (this->AreClosedLines)
  {
    return isClosedLine(data, cell, points);
  }
  if (!this->HasDimension(data, cell))
  {
    return false;
  }
  data->GetCellPoints(cell, points);
  return true;
}

MassCells massCells(const std::vector<DensityBlock>& blocks, int dimension, Progress& progress)
{
  const bool areRegions = dimension == 1 &&
    std::any_of(blocks.begin(), blocks.end(),
      [&](const DensityBlock& block) { return hasRegion(block.Data, progress); });
  return { areRegions ? 2 : dimension, areRegions };
}

} // namespace RectifiedTransport::Bridge

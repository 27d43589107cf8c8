// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/Cells/ParticleCells.h"

#include "Bridge/Run/Memory.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace RectifiedTransport::Bridge
{

vtkSmartPointer<vtkCellArray> newParticleCells(
  vtkIdType count, vtkIdType pointsEach, Progress& progress)
{
  auto offsets = newArray<vtkIdTypeArray>("Offsets", 1, count + 1);
  auto connectivity = newArray<vtkIdTypeArray>("Connectivity", 1, count * pointsEach);
  vtkIdType* offset = offsets->GetPointer(0);
  vtkIdType* id = connectivity->GetPointer(0);
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  progress.For(count, grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      offset[i] = i * pointsEach;
    }
    for (std::int64_t i = first * pointsEach; i < last * pointsEach; ++i)
    {
      id[i] = i;
    }
  });
  offset[count] = count * pointsEach;
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

void setParticles(
  vtkPolyData* output, vtkDataArray* points, vtkIdType pointsEach, Progress& progress)
{
  const auto cells =
    newParticleCells(points->GetNumberOfTuples() / pointsEach, pointsEach, progress);
  vtkNew<vtkPoints> made;
  made->SetData(points);
  output->SetPoints(made);
  if (pointsEach > 1)
  {
    output->SetLines(cells);
  }
  else
  {
    output->SetVerts(cells);
  }
}

void activateMass(vtkPolyData* particles)
{
  if (!particles->GetPointData()->GetScalars())
  {
    particles->GetPointData()->SetActiveScalars("Mass");
  }
}

} // namespace RectifiedTransport::Bridge

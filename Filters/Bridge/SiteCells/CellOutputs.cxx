// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/CellOutputs.h"

#include "Bridge/Data/TupleCopy.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// The input's points in double precision.
vtkSmartPointer<vtkPoints> doublePoints(vtkPoints* points)
{
  if (points->GetDataType() == VTK_DOUBLE)
  {
    return points;
  }
  auto copy = vtkSmartPointer<vtkPoints>::New();
  copy->SetDataTypeToDouble();
  copy->DeepCopy(points);
  return copy;
}

// The vector is empty afterwards.
template <class ArrayT>
vtkSmartPointer<ArrayT> moveToArray(const char* name, std::vector<std::int64_t>& values)
{
  using Value = typename ArrayT::ValueType;
  auto array = newArray<ArrayT>(name, 1, static_cast<vtkIdType>(values.size()));
  std::transform(values.begin(), values.end(), array->GetPointer(0),
    [](std::int64_t value) { return static_cast<Value>(value); });
  values = std::vector<std::int64_t>();
  return array;
}

// The vector is empty afterwards.
void movePoints(std::vector<Point<3>>& from, vtkPolyData* to)
{
  const auto count = static_cast<vtkIdType>(from.size());
  auto coordinates = newArray<vtkDoubleArray>("Points", 3, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::copy_n(from[static_cast<std::size_t>(i)].data(), 3, coordinates->GetPointer(3 * i));
  }
  from = std::vector<Point<3>>();
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  to->SetPoints(points);
}

} // namespace

std::array<vtkDataObject*, 4> CellOutputs::All() const
{
  return { this->Labels, this->Sites, this->Outlines, this->Polygons };
}

void writeSites(vtkPointSet* sites, vtkPointSet* output)
{
  output->CopyStructure(sites);
  output->SetPoints(doublePoints(sites->GetPoints()));
  output->GetPointData()->PassData(sites->GetPointData());
  output->GetCellData()->PassData(sites->GetCellData());
}

void addStatistics(
  const CellOutputs& outputs, const std::function<double(const SiteCellStatistics&)>& measure)
{
  const vtkIdType count = outputs.Sites->GetNumberOfPoints();
  auto masses = newArray<vtkDoubleArray>("CellMass", 1, count);
  auto centroids = newArray<vtkDoubleArray>("CellCentroid", 3, count);
  auto costs = newArray<vtkDoubleArray>("CellCost", 1, count);
  const double cost = measure(SiteCellStatistics{
    masses->GetPointer(0), { centroids->GetPointer(0), count }, costs->GetPointer(0) });
  outputs.Sites->GetPointData()->AddArray(masses);
  outputs.Sites->GetPointData()->AddArray(centroids);
  outputs.Sites->GetPointData()->AddArray(costs);
  for (vtkDataObject* output : outputs.All())
  {
    addFieldValue(output, "TransportCost", cost);
  }
}

template <int Dimension>
void writeOutlines(SiteCellOutlines<Dimension> outlines, vtkPolyData* output)
{
  movePoints(outlines.Points, output);
  const auto faces = static_cast<vtkIdType>(outlines.SiteIds.size());
  const auto offsets = newArray<vtkIdTypeArray>("Offsets", 1, faces + 1);
  for (vtkIdType i = 0; i <= faces; ++i)
  {
    offsets->SetValue(i, i * SiteCellOutlines<Dimension>::Corners);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, moveToArray<vtkIdTypeArray>("Connectivity", outlines.CornerIds));
  if constexpr (Dimension == 1)
  {
    output->SetVerts(cells);
  }
  else if constexpr (Dimension == 2)
  {
    output->SetLines(cells);
  }
  else
  {
    output->SetPolys(cells);
  }
  output->GetCellData()->SetScalars(moveToArray<SiteIdArray>("SiteId", outlines.SiteIds));
}

template void writeOutlines<1>(SiteCellOutlines<1>, vtkPolyData*);
template void writeOutlines<2>(SiteCellOutlines<2>, vtkPolyData*);
template void writeOutlines<3>(SiteCellOutlines<3>, vtkPolyData*);

void writePolygons(SiteCellPolygons polygons, const CellOutputs& outputs, Progress& progress)
{
  movePoints(polygons.Points, outputs.Polygons);
  vtkNew<vtkCellArray> cells;
  cells->SetData(moveToArray<vtkIdTypeArray>("Offsets", polygons.First),
    moveToArray<vtkIdTypeArray>("Connectivity", polygons.CornerIds));
  outputs.Polygons->SetPolys(cells);
  auto* data = outputs.Polygons->GetCellData();
  const auto ids = moveToArray<SiteIdArray>("SiteId", polygons.SiteIds);
  data->CopyGlobalIdsOff();
  data->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  copyTuples(
    { outputs.Sites->GetPointData(), outputs.Sites->GetNumberOfPoints(), "point",
      "input point set" },
    cells->GetNumberOfCells(),
    [&ids](vtkIdType polygon) { return static_cast<vtkIdType>(ids->GetValue(polygon)); }, data,
    progress);
  data->AddArray(ids);
  data->SetActiveScalars(ids->GetName()); // SetScalars would remove the sites' scalars
}

} // namespace RectifiedTransport::Bridge

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/EqualMassCells.h"

#include "Bridge/Image/DefaultArray.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/DoubleTuples.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/Memory.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/SiteCells/SiteCellOutlines.h"
#include "Core/SiteCells/SiteCells.h"

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
#include <string>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The tables of the pixels are the peak.
template <int D>
double bytesOfLabelling(const ImageGrid& grid)
{
  return RectifiedFlow<D>::MemoryFor(grid.Size<D>());
}

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

template <int D>
SiteCells<D> placeSites(vtkPointSet* sites, const ImageGrid& grid, Progress& progress)
{
  const std::int64_t count = sites->GetNumberOfPoints();
  const GridSize<D> size = grid.Size<D>();
  if (static_cast<double>(count) > numberOfCells<D>(size))
  {
    throw Failure("The input has " + std::to_string(count) + " sites for " + describeSize<D>(size) +
      " pixels; raise Resolution until there is a pixel for each");
  }
  visitPoints(sites, "input point set", progress, [](std::int64_t, const double*) {});
  const DoubleTuples points(sites->GetPoints()->GetData(), progress);
  constexpr double eachSite = (D + 3 + 4) * sizeof(double);
  return withMemory(
    "the " + std::to_string(count) + " sites", static_cast<double>(count) * eachSite, [&]() {
      return SiteCells<D>({ points.data(), count }, grid, progress.Stage());
    });
}

template <int D>
vtkSmartPointer<SiteIdArray> makeLabels(
  const SiteCells<D>& cells, const FlowOptions& options, Progress& progress)
{
  const auto pixels = cells.Grid().NumberOfCells();
  auto labels = newArray<SiteIdArray>("SiteId", 1, static_cast<vtkIdType>(pixels));
  withMemory("labels of " + describeSize<D>(cells.Pixels().Size()) + " pixels",
    bytesOfLabelling<D>(cells.Grid()),
    [&]() { cells.Label(labels->GetPointer(0), options, progress.Stage()); });
  return labels;
}

// Adds the arrays of the sites' cells to the sites' point data. Returns the cost.
template <int D>
double addStatistics(const SiteCells<D>& cells, const std::int64_t* labels, const CostNorm& norm,
  Progress& progress, vtkPointData* output)
{
  const auto count = static_cast<vtkIdType>(cells.NumberOfSites());
  auto masses = newArray<vtkDoubleArray>("CellMass", 1, count);
  auto centroids = newArray<vtkDoubleArray>("CellCentroid", 3, count);
  auto costs = newArray<vtkDoubleArray>("CellCost", 1, count);
  const SiteCellStatistics statistics{ masses->GetPointer(0),
    { centroids->GetPointer(0), cells.NumberOfSites() }, costs->GetPointer(0) };
  const double cost = withMemory("the sums of the " + std::to_string(count) + " cells",
    static_cast<double>(count) * 2.0 * (D + 2) * sizeof(double),
    [&]() { return measureSiteCells<D>(cells, labels, norm, statistics, progress.Stage()); });
  output->AddArray(masses);
  output->AddArray(centroids);
  output->AddArray(costs);
  return cost;
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

template <int D>
void writeOutlines(SiteCellOutlines<D> outlines, vtkPolyData* output)
{
  const auto count = static_cast<vtkIdType>(outlines.Points.size());
  auto coordinates = newArray<vtkDoubleArray>("Points", 3, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::copy_n(
      outlines.Points[static_cast<std::size_t>(i)].data(), 3, coordinates->GetPointer(3 * i));
  }
  outlines.Points = {};
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  output->SetPoints(points);
  const auto faces = static_cast<vtkIdType>(outlines.SiteIds.size());
  const auto offsets = newArray<vtkIdTypeArray>("Offsets", 1, faces + 1);
  for (vtkIdType i = 0; i <= faces; ++i)
  {
    offsets->SetValue(i, i * SiteCellOutlines<D>::Corners);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, moveToArray<vtkIdTypeArray>("Connectivity", outlines.CornerIds));
  if constexpr (D == 1)
  {
    output->SetVerts(cells);
  }
  else if constexpr (D == 2)
  {
    output->SetLines(cells);
  }
  else
  {
    output->SetPolys(cells);
  }
  output->GetCellData()->SetScalars(moveToArray<SiteIdArray>("SiteId", outlines.SiteIds));
}

template <int D>
std::int64_t divide(const EqualMassCells& cells, vtkPointSet* sites, const ImageGrid& grid,
  SiteLabels& kept, Progress& progress, const EqualMassCells::Outputs& outputs)
{
  progress.BeginStage(0.01);
  const SiteCells<D> placed = placeSites<D>(sites, grid, progress);
  progress.BeginStage(0.02);
  SiteIdArray* labels = kept.Update(sites, grid, cells.Flow, progress, [&]() {
    progress.BeginStage(0.95);
    return makeLabels<D>(placed, cells.Flow, progress);
  });
  outputs.Labels->GetCellData()->SetScalars(labels);
  progress.BeginStage(0.98);
  const double cost = addStatistics<D>(
    placed, labels->GetPointer(0), cells.Norm, progress, outputs.Sites->GetPointData());
  addFieldValue(outputs.Labels, "TransportCost", cost);
  addFieldValue(outputs.Sites, "TransportCost", cost);
  progress.BeginStage(1.0);
  writeOutlines<D>(
    outlineSiteCells<D>(grid, labels->GetPointer(0), progress.Stage()), outputs.Outlines);
  return placed.NumberOutside();
}

} // namespace

ImageGrid EqualMassCells::GridOn(vtkImageData* domain) const
{
  const ImageGrid grid = gridOf(domain, false);
  const ImageGrid box = hasPointValues(domain) ? grid.WithDualCells() : grid;
  if (box.Dimension() == 0)
  {
    throw Failure("The Domain has one point along every axis; it needs at least one axis of two "
                  "points or more");
  }
  return gridWithResolution(box, this->Resolution, "Resolution");
}

ImageGrid EqualMassCells::GridAround(vtkPointSet* sites) const
{
  constexpr double margin = 0.05; // on each side
  double bounds[6];
  findBounds(sites, bounds);
  for (int a = 0; a < 3; ++a)
  {
    const double length = bounds[2 * a + 1] - bounds[2 * a];
    bounds[2 * a] -= margin * length;
    bounds[2 * a + 1] += margin * length;
  }
  const ImageGrid box = gridOfBox(bounds);
  if (box.Dimension() == 0)
  {
    throw Failure("The input's sites are all at one point, about which there is no domain; connect "
                  "an image as the Domain");
  }
  return gridWithResolution(box, this->Resolution, "Resolution");
}

std::int64_t EqualMassCells::Run(vtkPointSet* sites, vtkImageData* domain, SiteLabels& kept,
  Progress& progress, const Outputs& outputs) const
{
  if (!domain)
  {
    // Coordinates that are not finite have no bounds.
    visitPoints(sites, "input point set", progress, [](std::int64_t, const double*) {});
  }
  const ImageGrid grid = domain ? this->GridOn(domain) : this->GridAround(sites);
  requireCells(grid);
  if (!kept.IsFor(sites, grid, this->Flow))
  {
    const auto bytes = dispatchDimension(
      grid.Dimension(), bytesOfLabelling<1>, bytesOfLabelling<2>, bytesOfLabelling<3>);
    requireMemory("labels of " + describeValues(grid) + " pixels (see Resolution)",
      numberOfValues(grid) * sizeof(std::int64_t) + bytes(grid));
  }
  applyGrid(grid, outputs.Labels);
  outputs.Sites->CopyStructure(sites);
  outputs.Sites->SetPoints(doublePoints(sites->GetPoints()));
  outputs.Sites->GetPointData()->PassData(sites->GetPointData());
  outputs.Sites->GetCellData()->PassData(sites->GetCellData());
  return dispatchDimension(grid.Dimension(), divide<1>, divide<2>, divide<3>)(
    *this, sites, grid, kept, progress, outputs);
}

} // namespace RectifiedTransport

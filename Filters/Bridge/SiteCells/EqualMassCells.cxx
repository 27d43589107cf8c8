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
#include "Core/SiteCells/PowerSiteCells.h"
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
#include <memory>
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

// Adds the arrays of the sites' cells to the sites' point data; measure(statistics) fills them and
// returns the cost.
template <class Measure>
void addStatistics(vtkIdType count, const Measure& measure, const EqualMassCells::Outputs& outputs)
{
  auto masses = newArray<vtkDoubleArray>("CellMass", 1, count);
  auto centroids = newArray<vtkDoubleArray>("CellCentroid", 3, count);
  auto costs = newArray<vtkDoubleArray>("CellCost", 1, count);
  const double cost = measure(SiteCellStatistics{
    masses->GetPointer(0), { centroids->GetPointer(0), count }, costs->GetPointer(0) });
  outputs.Sites->GetPointData()->AddArray(masses);
  outputs.Sites->GetPointData()->AddArray(centroids);
  outputs.Sites->GetPointData()->AddArray(costs);
  addFieldValue(outputs.Labels, "TransportCost", cost);
  addFieldValue(outputs.Sites, "TransportCost", cost);
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
  SiteIdArray* labels = kept
                          .Update(sites, { grid, false, cells.Flow }, progress,
                            [&]() -> SiteLabels::Division {
                              progress.BeginStage(0.95);
                              return { makeLabels<D>(placed, cells.Flow, progress), nullptr };
                            })
                          .Labels;
  outputs.Labels->GetCellData()->SetScalars(labels);
  progress.BeginStage(0.98);
  const auto count = static_cast<vtkIdType>(placed.NumberOfSites());
  const auto measure = [&](const SiteCellStatistics& statistics) {
    return withMemory("the sums of the " + std::to_string(count) + " cells",
      static_cast<double>(count) * 2.0 * (D + 2) * sizeof(double), [&]() {
        return measureSiteCells<D>(
          placed, labels->GetPointer(0), cells.Norm, statistics, progress.Stage());
      });
  };
  addStatistics(count, measure, outputs);
  progress.BeginStage(1.0);
  writeOutlines<D>(
    outlineSiteCells<D>(grid, labels->GetPointer(0), progress.Stage()), outputs.Outlines);
  return placed.NumberOutside();
}

SiteLabels::Division makePowerCells(vtkPointSet* sites, const ImageGrid& grid, Progress& progress)
{
  const std::int64_t count = sites->GetNumberOfPoints();
  progress.BeginStage(0.03);
  visitPoints(sites, "input point set", progress, [](std::int64_t, const double*) {});
  const DoubleTuples points(sites->GetPoints()->GetData(), progress);
  SiteLabels::Division division;
  // The factors of the linear systems are the peak.
  constexpr double eachSite = 1500.0;
  withMemory("the power cells of " + std::to_string(count) + " sites",
    static_cast<double>(count) * eachSite, [&]() {
      progress.BeginStage(0.9);
      division.Power = std::make_shared<PowerSiteCells>(
        ConstPointSpan<3>(points.data(), count), grid, progress.Stage());
    });
  division.Labels =
    newArray<SiteIdArray>("SiteId", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
  progress.BeginStage(0.95);
  withMemory("the polygons in the rows of pixels", static_cast<double>(count) * sizeof(double),
    [&]() { division.Power->Label(division.Labels->GetPointer(0), progress.Stage()); });
  return division;
}

std::int64_t divideByPower(vtkPointSet* sites, const ImageGrid& grid, SiteLabels& kept,
  Progress& progress, const EqualMassCells::Outputs& outputs)
{
  progress.BeginStage(0.02);
  const SiteLabels::Division& division = kept.Update(
    sites, { grid, true, {} }, progress, [&]() { return makePowerCells(sites, grid, progress); });
  const PowerSiteCells& power = *division.Power;
  outputs.Labels->GetCellData()->SetScalars(division.Labels);
  addStatistics(
    static_cast<vtkIdType>(power.NumberOfSites()),
    [&power](const SiteCellStatistics& statistics) { return power.Measure(statistics); }, outputs);
  progress.BeginStage(1.0);
  const double bytes = 60.0 * 6.0 * static_cast<double>(power.NumberOfSites());
  withMemory(
    "the outlines", bytes, [&]() { writeOutlines<2>(power.Outlines(), outputs.Outlines); });
  progress.EndSlice(1);
  return power.NumberOutside();
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
  if (this->IsPower && grid.Dimension() != 2)
  {
    throw Failure("Shape Power needs a domain of two dimensions; this one has " +
      std::to_string(grid.Dimension()));
  }
  if (!kept.IsFor(sites, { grid, this->IsPower, this->Flow }))
  {
    const auto bytes = dispatchDimension(
      grid.Dimension(), bytesOfLabelling<1>, bytesOfLabelling<2>, bytesOfLabelling<3>);
    requireMemory("labels of " + describeValues(grid) + " pixels (see Resolution)",
      numberOfValues(grid) * sizeof(std::int64_t) + (this->IsPower ? 0.0 : bytes(grid)));
  }
  applyGrid(grid, outputs.Labels);
  outputs.Sites->CopyStructure(sites);
  outputs.Sites->SetPoints(doublePoints(sites->GetPoints()));
  outputs.Sites->GetPointData()->PassData(sites->GetPointData());
  outputs.Sites->GetCellData()->PassData(sites->GetCellData());
  if (this->IsPower)
  {
    return divideByPower(sites, grid, kept, progress, outputs);
  }
  return dispatchDimension(grid.Dimension(), divide<1>, divide<2>, divide<3>)(
    *this, sites, grid, kept, progress, outputs);
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/SiteLabels.h"

#include "Bridge/Image/GridText.h"
#include "Bridge/Points/SeedInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/SiteCells/EqualizeSiteCells.h"
#include "Core/SiteCells/SplitSharedPixels.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

std::pair<vtkSmartPointer<vtkPoints>, vtkMTimeType> keyOf(vtkPointSet* sites)
{
  return { sites->GetPoints(), sites->GetPoints()->GetMTime() };
}

// Its own time, not that of its points.
std::uint64_t timeOf(vtkPointSet* sites)
{
  return static_cast<std::uint64_t>(sites->vtkObject::GetMTime());
}

} // namespace

bool SiteLabels::IsFor(vtkPointSet* sites, const ImageGrid& grid, const FlowOptions& options) const
{
  return this->Labels && this->Grid == grid && this->Options == options &&
    this->Stamp.IsOf(keyOf(sites), timeOf(sites));
}

bool SiteLabels::Renew(vtkPointSet* sites, Progress& progress)
{
  return this->Stamp.Renew(keyOf(sites), timeOf(sites),
    [&]() { return fingerprint({ sites->GetPoints()->GetData() }, progress); });
}

namespace
{

constexpr double recordBytes(int dimension)
{
  return (dimension == 1 ? 2.5 : 4.0) * sizeof(double);
}

} // namespace

void SiteLabels::RequireMemory(const ImageGrid& grid)
{
  const double bytes = sizeof(std::int64_t) + recordBytes(grid.Dimension());
  requireMemory(
    "labels of " + describeValues(grid) + " pixels (see Resolution)", numberOfValues(grid) * bytes);
}

template <int D>
SiteGrid<D>::SiteGrid(vtkPointSet* sites, const ImageGrid& geometry, Progress& progress)
  : Geometry(geometry)
{
  const std::int64_t count = sites->GetNumberOfPoints();
  const GridSize<D> size = geometry.Size<D>();
  if (static_cast<double>(count) > numberOfCells<D>(size))
  {
    throw Failure("The input has " + std::to_string(count) + " sites for " + describeSize<D>(size) +
      " pixels; raise Resolution until there is a pixel for each");
  }
  const std::string purpose = "the " + std::to_string(count) + " sites";
  const double bytes = static_cast<double>(count) * (D + 3 + 4) * sizeof(double);
  withMemory(purpose, bytes, [&]() {
    this->Coordinates = LargeBuffer<double>(count * D);
    LargeBuffer<double> inside(count * 3);
    this->Outside = readSeeds<D>(sites, "input point set", geometry, progress,
      PointSpan<D>(this->Coordinates.data(), count), PointSpan<3>(inside.data(), count));
    this->Grid =
      std::make_unique<SiteDensity<D>>(size, ConstPointSpan<D>(this->Coordinates.data(), count));
  });
}

template <int D>
vtkSmartPointer<SiteIdArray> SiteGrid<D>::MakeLabels(
  const FlowOptions& options, Progress& progress, double end) const
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const SiteDensity<D>& grid = *this->Grid;
  const GridSize<D> size = grid.Size();
  const double pixels = numberOfCells<D>(size);
  const std::string purpose = "labels of " + describeSize<D>(size) + " pixels";
  auto array = newArray<SiteIdArray>("SiteId", 1, static_cast<vtkIdType>(pixels));
  std::int64_t* labels = array->GetPointer(0);
  const double begin = progress.StageEnd();
  const auto beginStage = [&](double part) { progress.BeginStage(begin + part * (end - begin)); };
  if (grid.NumberOfPixels() == 1)
  {
    std::fill_n(labels, array->GetNumberOfTuples(), std::int64_t{ 0 });
  }
  else
  {
    withMemory(purpose, pixels * recordBytes(D), [&]() {
      beginStage(0.03);
      const RectifiedFlow<D> flow(grid, progress.Stage());
      beginStage(0.93);
      flow.ForwardLatticeToCells(size, labels, options, progress.Stage());
    });
    beginStage(0.95);
    progress.For(array->GetNumberOfTuples(), grain, [&](std::int64_t first, std::int64_t last) {
      std::transform(labels + first, labels + last, labels + first,
        [&grid](std::int64_t pixel) { return grid.Find(pixel); });
    });
  }
  const Point<D> lengths = this->Geometry.template Lengths<D>();
  Point<D> spacing;
  for (int a = 0; a < D; ++a)
  {
    spacing[a] = lengths[a] / static_cast<double>(size[a]);
  }
  withMemory(purpose, pixels * sizeof(std::int64_t), [&]() {
    beginStage(0.99);
    equalizeSiteCells<D>(grid, spacing, labels, progress.Stage());
    beginStage(1.0);
    splitSharedPixels<D>(
      grid, { this->Coordinates.data(), grid.NumberOfSites() }, spacing, labels, progress.Stage());
  });
  return array;
}

template class SiteGrid<1>;
template class SiteGrid<2>;
template class SiteGrid<3>;

} // namespace RectifiedTransport

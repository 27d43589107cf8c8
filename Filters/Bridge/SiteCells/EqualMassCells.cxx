// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/EqualMassCells.h"

#include "Bridge/Density/FlowCache.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PlainDensity.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Points/DoubleTuples.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/SiteCells/LabelGrid.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Boxes/SizedGrids.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/Stages.h"
#include "Core/SiteCells/DensitySiteCells.h"
#include "Core/SiteCells/PixelMasses.h"
#include "Core/SiteCells/PowerSiteCells.h"
#include "Core/SiteCells/SiteCellOutlines.h"
#include "Core/SiteCells/SiteCellPolygons.h"
#include "Core/SiteCells/SiteCells.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace RectifiedTransport::Bridge
{

namespace
{

// The tables of the pixels are the peak.
template <int D>
double bytesOfLabelling(const ImageGrid& grid)
{
  return RectifiedFlow<D>::MemoryFor(grid.Size<D>());
}

// With the places of the pixels in the uniform measure.
template <int D>
double bytesOfLabellingByMass(const ImageGrid& grid)
{
  return D == 1 ? 0.0
                : bytesOfLabelling<D>(grid) + numberOfCells<D>(grid.Size<D>()) * D * sizeof(double);
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
    { "the " + std::to_string(count) + " sites", static_cast<double>(count) * eachSite }, [&]() {
      return SiteCells<D>({ points.data(), count }, grid, progress);
    });
}

// The kept division, or the one that make() returns.
template <class Make>
std::shared_ptr<const SiteDivision> updateDivision(
  const DataIdentity& identity, StoreSlot& kept, Progress& progress, const Make& make)
{
  return kept.Get<const SiteDivision>(identity, SoloRanks::Get(), progress, Sharing::None,
    [&]() { return std::make_shared<const SiteDivision>(make()); });
}

// The kept labels, or those that label(labels, progress) writes; it returns the report of the flow.
template <int D, class Label>
SiteDivision updateLabels(const DataIdentity& identity, const ImageGrid& grid, double bytes,
  StoreSlot& kept, Progress& progress, const Label& label)
{
  Stages stages(progress, { { "comparison", 1 }, { "labels", 92 } });
  const auto make = [&]() -> SiteDivision {
    auto labels = newArray<SiteIdArray>("SiteId", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
    const FlowReport flow =
      withMemory({ "labels of " + describeSize<D>(grid.Size<D>()) + " pixels", bytes },
        [&]() { return label(labels->GetPointer(0), stages["labels"]); });
    return { labels, nullptr, flow };
  };
  return *updateDivision(identity, kept, stages["comparison"], make);
}

// Writes the labels, what measure(statistics, progress) measures of the sites' cells, and their
// outlines.
template <int D, class Measure>
void writeCells(const ImageGrid& grid, SiteIdArray* labels, vtkIdType sites, Progress& progress,
  const CellOutputs& outputs, const Measure& measure)
{
  outputs.Labels->GetCellData()->SetScalars(labels);
  Stages stages(progress,
    { { "statistics", 6 }, { "outlines", 2 }, { "polygons", 1 }, { "written polygons", 1 } });
  const double bytes = static_cast<double>(sites) * 2.0 * (D + 2) * sizeof(double);
  const auto withSums = [&](const SiteCellStatistics& statistics) {
    return withMemory({ "the sums of the " + std::to_string(sites) + " cells", bytes },
      [&]() { return measure(statistics, stages["statistics"]); });
  };
  addStatistics(outputs, withSums);
  writeOutlines<D>(
    outlineSiteCells<D>(grid, labels->GetPointer(0), stages["outlines"]), outputs.Outlines);
  if constexpr (D == 2)
  {
    SiteCellPolygons polygons =
      withMemory({ "the polygons of the cells", 9.0 * static_cast<double>(grid.NumberOfCells()) },
        [&]() { return polygonsOfSiteCells(grid, labels->GetPointer(0), stages["polygons"]); });
    writePolygons(std::move(polygons), outputs, stages["written polygons"]);
  }
}

template <int D>
EqualMassCells::Report divide(const EqualMassCells& cells, vtkPointSet* sites,
  const ImageGrid& grid, StoreSlot& kept, Progress& progress, const CellOutputs& outputs)
{
  Stages stages(progress, { { "sites", 1 }, { "labels", 94 }, { "output", 5 } });
  const SiteCells<D> placed = placeSites<D>(sites, grid, stages["sites"]);
  const SiteDivision division = updateLabels<D>(identityOfDivision(sites, grid, &cells.Flow), grid,
    bytesOfLabelling<D>(grid), kept, stages["labels"],
    [&](std::int64_t* values, Progress& work) { return placed.Label(values, cells.Flow, work); });
  SiteIdArray* labels = division.Labels;
  writeCells<D>(grid, labels, static_cast<vtkIdType>(placed.NumberOfSites()), stages["output"],
    outputs, [&](const SiteCellStatistics& statistics, Progress& work) {
      return measureSiteCells<D>(placed, labels->GetPointer(0), cells.Norm, statistics, work);
    });
  return { placed.NumberOutside(), 0, division.Flow };
}

// The sites' cells by the mass of a density.
template <int D>
EqualMassCells::Report divideMass(const EqualMassCells& cells, vtkPointSet* sites,
  const ImageGrid& grid, InputDensity& density, FlowCache& cache, StoreSlot& kept,
  Progress& progress, const CellOutputs& outputs)
{
  const auto count = static_cast<vtkIdType>(sites->GetNumberOfPoints());
  Stages stages(progress,
    { { "tables", 4 }, { "reading", 1 }, { "masses", 1 }, { "labels", 89 }, { "output", 5 } });
  const SharedFlow& flow = cache.Update(density, stages["tables"]);
  Progress& reading = stages["reading"];
  density.Prepare(FlowTables::Whole, reading);
  visitPoints(sites, "input point set", reading, [](std::int64_t, const double*) {});
  const DoubleTuples points(sites->GetPoints()->GetData(), reading);
  const double bytes = numberOfValues(grid) * sizeof(std::int64_t);
  const auto placed =
    withMemory({ "the masses of " + describeValues(grid) + " pixels", bytes }, [&]() {
      try
      {
        return DensitySiteCells<D>({ points.data(), count }, grid, density.Source<D>(),
          flow.Flow<D>().Total(), stages["masses"]);
      }
      catch (const TooFewPixels& few)
      {
        throw Failure("The input has " + std::to_string(count) + " sites, and the " +
          density.GetName() + " has mass in " + std::to_string(few.PixelsWithMass()) + " of " +
          describeSize<D>(grid.Size<D>()) +
          " pixels; raise Resolution until there is a pixel with mass for each");
      }
    });
  const SiteDivision division = updateLabels<D>(
    identityOfDivision(sites, grid, &cells.Flow, &density), grid, bytesOfLabellingByMass<D>(grid),
    kept, stages["labels"], [&](std::int64_t* values, Progress& work) {
      return placed.Label(flow.Flow<D>(), values, cells.Flow, work);
    });
  SiteIdArray* labels = division.Labels;
  EqualMassCells::Report report{ placed.NumberOutside(), 0, division.Flow };
  writeCells<D>(grid, labels, count, stages["output"], outputs,
    [&](const SiteCellStatistics& statistics, Progress& work) {
      const double cost = measureSiteCells<D>(
        placed, labels->GetPointer(0), flow.TotalMass(), cells.Norm, statistics, work);
      report.WithoutMass = std::count(statistics.Mass, statistics.Mass + count, 0.0);
      return cost;
    });
  return report;
}

// make(points, progress) returns the power cells of the sites.
template <class Make>
SiteDivision makePowerCells(
  vtkPointSet* sites, const ImageGrid& grid, double moreBytes, Progress& progress, const Make& make)
{
  const std::int64_t count = sites->GetNumberOfPoints();
  Stages stages(progress, { { "points", 1 }, { "cells", 87 }, { "labels", 5 } });
  visitPoints(sites, "input point set", stages["points"], [](std::int64_t, const double*) {});
  const DoubleTuples points(sites->GetPoints()->GetData(), stages["points"]);
  SiteDivision division;
  // The factors of the linear systems are the peak.
  constexpr double eachSite = 1500.0;
  withMemory({ "the power cells of " + std::to_string(count) + " sites",
               static_cast<double>(count) * eachSite + moreBytes },
    [&]() {
      division.Power = std::make_shared<PowerSiteCells>(
        make(ConstPointSpan<3>(points.data(), count), stages["cells"]));
    });
  division.Labels =
    newArray<SiteIdArray>("SiteId", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
  withMemory({ "the polygons in the rows of pixels", static_cast<double>(count) * sizeof(double) },
    [&]() { division.Power->Label(division.Labels->GetPointer(0), stages["labels"]); });
  return division;
}

std::int64_t writePowerCells(
  const SiteDivision& division, Progress& progress, const CellOutputs& outputs)
{
  const PowerSiteCells& power = *division.Power;
  outputs.Labels->GetCellData()->SetScalars(division.Labels);
  addStatistics(
    outputs, [&power](const SiteCellStatistics& statistics) { return power.Measure(statistics); });
  const double bytes = 60.0 * 6.0 * static_cast<double>(power.NumberOfSites());
  withMemory(
    { "the outlines", bytes }, [&]() { writeOutlines<2>(power.Outlines(), outputs.Outlines); });
  writePolygons(
    withMemory({ "the polygons of the cells", bytes }, [&]() { return power.Polygons(); }), outputs,
    progress);
  return power.NumberOutside();
}

std::int64_t divideByPower(vtkPointSet* sites, const ImageGrid& grid, StoreSlot& kept,
  Progress& progress, const CellOutputs& outputs)
{
  Stages stages(progress, { { "comparison", 2 }, { "cells", 93 }, { "output", 5 } });
  const auto make = [&](ConstPointSpan<3> points, Progress& work) {
    return PowerSiteCells(points, grid, work);
  };
  const auto division =
    updateDivision(identityOfDivision(sites, grid, nullptr), kept, stages["comparison"],
      [&]() { return makePowerCells(sites, grid, 0.0, stages["cells"], make); });
  return writePowerCells(*division, stages["output"], outputs);
}

std::int64_t divideMassByPower(vtkPointSet* sites, const ImageGrid& grid, InputDensity& density,
  StoreSlot& kept, Progress& progress, const CellOutputs& outputs)
{
  constexpr double rowMoments = 18.0; // bytes a cell of the density
  double mass = 0.0;
  Stages stages(
    progress, { { "comparison", 2 }, { "cells", 93 }, { "empty pixels", 1 }, { "output", 4 } });
  const auto make = [&](ConstPointSpan<3> points, Progress& work) {
    Stages parts(work, { { "density", 2 }, { "cells", 98 } });
    density.Prepare(FlowTables::Whole, parts["density"]);
    mass = massOf(density, parts["density"]);
    try
    {
      return PowerSiteCells(points, grid, density.Source<2>(), mass, parts["cells"]);
    }
    catch (const InvalidDensity& invalid)
    {
      density.ThrowInvalid(invalid.Summary());
    }
  };
  const double bytes = rowMoments * static_cast<double>(density.Grid().NumberOfCells());
  const auto makeWithoutEmpty = [&]() {
    SiteDivision division = makePowerCells(sites, grid, bytes, stages["cells"], make);
    withMemory({ "the masses of " + describeValues(grid) + " pixels",
                 numberOfValues(grid) * sizeof(std::int64_t) },
      [&]() {
        Progress& work = stages["empty pixels"];
        const PixelMasses<2> masses(
          density.Source<2>(), mass / density.Grid().CellMeasure(), grid.Size<2>(), work);
        masses.RemoveEmptyPixels(division.Labels->GetPointer(0), work);
      });
    return division;
  };
  const auto division = updateDivision(identityOfDivision(sites, grid, nullptr, &density), kept,
    stages["comparison"], makeWithoutEmpty);
  return writePowerCells(*division, stages["output"], outputs);
}

void requirePlane(const ImageGrid& grid)
{
  if (grid.Dimension() != 2)
  {
    throw Failure("Shape Power needs a domain of two dimensions; this one has " +
      std::to_string(grid.Dimension()));
  }
}

std::string describeLabels(const ImageGrid& grid)
{
  return "labels of " + describeValues(grid) + " pixels (see Resolution)";
}

} // namespace

EqualMassCells::Report EqualMassCells::Run(vtkPointSet* sites, vtkDataObject* domain,
  StoreSlot& kept, Progress& progress, const CellOutputs& outputs) const
{
  Stages stages(progress, { { "points", 1 }, { "cells", 99 } });
  if (!domain)
  {
    // Coordinates that are not finite have no bounds.
    visitPoints(sites, "input point set", stages["points"], [](std::int64_t, const double*) {});
  }
  const LabelGrid pixels{ this->Resolution };
  const ImageGrid grid = domain ? pixels.On(domain) : pixels.Around(sites);
  requireCells(grid);
  if (this->IsPower)
  {
    requirePlane(grid);
  }
  if (!kept.Holds(identityOfDivision(sites, grid, this->IsPower ? nullptr : &this->Flow)))
  {
    const auto bytes = dispatchDimension(
      grid.Dimension(), bytesOfLabelling<1>, bytesOfLabelling<2>, bytesOfLabelling<3>);
    requireMemory({ describeLabels(grid),
      numberOfValues(grid) * sizeof(std::int64_t) + (this->IsPower ? 0.0 : bytes(grid)) });
  }
  applyGrid(grid, outputs.Labels);
  writeSites(sites, outputs.Sites);
  if (this->IsPower)
  {
    return { divideByPower(sites, grid, kept, stages["cells"], outputs), 0, {} };
  }
  return dispatchDimension(grid.Dimension(), divide<1>, divide<2>, divide<3>)(
    *this, sites, grid, kept, stages["cells"], outputs);
}

EqualMassCells::Report EqualMassCells::Run(vtkPointSet* sites, InputDensity& density,
  FlowCache& cache, StoreSlot& kept, Progress& progress, const CellOutputs& outputs) const
{
  const ImageGrid grid = LabelGrid{ this->Resolution }.On(density.Grid());
  requireCells(grid);
  if (this->IsPower)
  {
    requirePlane(grid);
  }
  const auto bytes = dispatchDimension(grid.Dimension(), bytesOfLabellingByMass<1>,
    bytesOfLabellingByMass<2>, bytesOfLabellingByMass<3>);
  requireMemory({ describeLabels(grid),
    numberOfValues(grid) * sizeof(std::int64_t) * (this->IsPower ? 1.0 : 2.0) +
      (this->IsPower ? 0.0 : bytes(grid)) });
  applyGrid(grid, outputs.Labels);
  writeSites(sites, outputs.Sites);
  if (this->IsPower)
  {
    cache.Release();
    return { divideMassByPower(sites, grid, density, kept, progress, outputs), 0, {} };
  }
  return dispatchDimension(grid.Dimension(), divideMass<1>, divideMass<2>, divideMass<3>)(
    *this, sites, grid, density, cache, kept, progress, outputs);
}

} // namespace RectifiedTransport::Bridge

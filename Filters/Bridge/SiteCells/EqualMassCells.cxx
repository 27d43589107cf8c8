// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SiteCells/EqualMassCells.h"

#include "Bridge/Data/DoubleTuples.h"
#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Plan/DensityQueries.h"
#include "Bridge/SiteCells/LabelGrid.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Messages/Failure.h"
#include "Core/SiteCells/DensitySiteCells.h"
#include "Core/SiteCells/LabelPixels.h"
#include "Core/SiteCells/PowerSiteCells.h"
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

// The site of each pixel of a domain and, with Shape Power, the polygons of the sites' cells, kept
// between executions. The next one reuses them if only the cost's exponents change.
struct SiteDivision
{
  vtkSmartPointer<SiteIdArray> Labels;
  std::shared_ptr<const PowerSiteCells> Power; // only with Shape Power
  FlowReport Flow;                             // only with Shape Flow
};

// What a division depends on. `flow`: nullptr with Shape Power; `density`: nullptr for none.
DataIdentity identityOfDivision(vtkPointSet* sites, const ImageGrid& grid, const FlowOptions* flow,
  const InputDensity* density = nullptr)
{
  DataIdentity identity;
  // Programs that write into an array often call Modified() only on the data set, whose GetMTime()
  // includes its points.
  identity.AddTimeOf(sites->GetPoints());
  identity.AddTime(static_cast<std::uint64_t>(sites->vtkObject::GetMTime()));
  identity.AddArray(sites->GetPoints()->GetData());
  identity.AddGrid(grid);
  identity.AddNumber(flow ? 1 : 0);
  if (flow)
  {
    identity.AddOptions(*flow);
  }
  if (density)
  {
    identity.Add(density->Identity());
  }
  return identity;
}

// The sites' coordinates. Throws Failure for any that is not finite.
DoubleTuples placesOf(vtkPointSet* sites, Progress& progress)
{
  // Only checks that coordinates are finite. DoubleTuples then views arrays of doubles and copies
  // others.
  visitPoints(sites, "input point set", progress, [](std::int64_t, const double*) {});
  return { sites->GetPoints()->GetData(), progress };
}

// The tables of the pixels are the peak.
// Labels are 8 bytes a pixel, and asked for separately.
template <int D>
double bytesOfLabelling(const ImageGrid& grid)
{
  return RectifiedFlow<D>::MemoryFor(grid.Size<D>());
}

// With the places of the pixels in the uniform measure.
// In 1D, cells are intervals in the order of the sites, without a flow.
template <int D>
double bytesOfLabellingByMass(const ImageGrid& grid)
{
  return D == 1 ? 0.0
                : bytesOfLabelling<D>(grid) + numberOfCells<D>(grid.Size<D>()) * D * sizeof(double);
}

// The sites in the pixels of the grid. Each site needs a pixel at least, as masses are whole
// pixels.
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
  const DoubleTuples points = placesOf(sites, progress);
  // Index coordinates (D), physical ones (3), and the lists of pixels and of sites in them (4).
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
  // Labels are not shared with other filters: they belong to this filter's sites. Sites are whole
  // on each rank, or rank 0 runs alone, so that the slot needs no agreement among ranks.
  return kept.Get<const SiteDivision>(identity, SoloRanks::Get(), progress, Sharing::None,
    [&]() { return std::make_shared<const SiteDivision>(make()); });
}

// The kept labels, or those that label(labels, progress) writes; it returns the report of the flow.
template <int D, class Label>
SiteDivision updateLabels(const DataIdentity& identity, const ImageGrid& grid, double bytes,
  StoreSlot& kept, Progress& progress, const Label& label)
{
  Stages stages(progress, { { "comparison", 1 }, { "labels", 92 } });
  // One label a pixel, axis 0 fastest: the number of a site, or -1 for a pixel without mass.
  const auto make = [&]() -> SiteDivision {
    auto labels = newArray<SiteIdArray>("SiteId", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
    // The report is kept with the labels, as warnings have to come also where labels are reused.
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
  // The image shares the kept labels. Filters must not change their inputs, so that they stay
  // valid.
  outputs.Labels->GetCellData()->SetScalars(labels);
  Stages stages(progress,
    { { "statistics", 6 }, { "outlines", 2 }, { "polygons", 1 }, { "written polygons", 1 } });
  // Sums for each site: D moments, weight and cost, once for a chunk of pixels and once for all.
  const double bytes = static_cast<double>(sites) * 2.0 * (D + 2) * sizeof(double);
  const auto withSums = [&](const SiteCellStatistics& statistics) {
    return withMemory({ "the sums of the " + std::to_string(sites) + " cells", bytes },
      [&]() { return measure(statistics, stages["statistics"]); });
  };
  addStatistics(outputs, withSums);
  writeOutlines<D>(
    outlineSiteCells<D>(grid, labels->GetPointer(0), stages["outlines"]), outputs.Outlines);
  // The cells of pixels in a line or in space are no polygons.
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
  // The flow of all pixels takes nearly all of the time. Its tables are those of the sites as a
  // density, and are made inside Label.
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
  // Unlike above, the flow is that of the density, shared with other filters: pixels and sites go
  // backward to the uniform measure, and the division takes place there.
  const SharedFlow& flow = cache.Update(density, stages["tables"]);
  Progress& reading = stages["reading"];
  density.Prepare(FlowTables::Whole, reading);
  const DoubleTuples points = placesOf(sites, reading);
  // Masses of pixels are integers of 8 bytes, so that their sums are exact in any order.
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
      // Cells that got no pixel with mass: there are nearly as many sites as such pixels.
      report.WithoutMass = std::count(statistics.Mass, statistics.Mass + count, 0.0);
      return cost;
    });
  return report;
}

// The power cells of the sites by the mass of a density on the grid's domain, `mass` in all.
PowerSiteCells powerCells(ConstPointSpan<3> points, const ImageGrid& grid, InputDensity& density,
  double& mass, Progress& progress)
{
  // The solver takes the values of all cells, and the mass in physical units for its figures.
  Stages stages(progress, { { "density", 2 }, { "cells", 98 } });
  density.Prepare(FlowTables::Whole, stages["density"]);
  mass = massOf(density, stages["density"]);
  try
  {
    return PowerSiteCells(points, grid, density.Source<2>(), mass, stages["cells"]);
  }
  catch (const InvalidDensity& invalid)
  {
    density.ThrowInvalid(invalid.Summary());
  }
}

// `density` may be nullptr.
SiteDivision divideByPower(
  vtkPointSet* sites, const ImageGrid& grid, InputDensity* density, Progress& progress)
{
  const std::int64_t count = sites->GetNumberOfPoints();
  Stages stages(progress,
    { { "points", 1 }, { "cells", 87 }, { "labels", 5 }, { "empty pixels", density ? 1.0 : 0.0 } });
  const DoubleTuples points = placesOf(sites, stages["points"]);
  SiteDivision division;
  // The factors of the linear systems are the peak.
  // Newton's method solves sparse linear systems with one unknown a site. Moments of the density's
  // rows give its integrals over polygons.
  constexpr double eachSite = 1500.0;
  constexpr double rowMoments = 18.0; // bytes a cell of the density
  const double moments =
    density ? rowMoments * static_cast<double>(density->Grid().NumberOfCells()) : 0.0;
  double mass = 0.0;
  withMemory({ "the power cells of " + std::to_string(count) + " sites",
               static_cast<double>(count) * eachSite + moments },
    [&]() {
      const ConstPointSpan<3> places(points.data(), count);
      division.Power = std::make_shared<PowerSiteCells>(density
          ? powerCells(places, grid, *density, mass, stages["cells"])
          : PowerSiteCells(places, grid, stages["cells"]));
    });
  // The polygons come first; a pixel belongs to the one that contains its centre.
  division.Labels =
    newArray<SiteIdArray>("SiteId", 1, static_cast<vtkIdType>(grid.NumberOfCells()));
  std::int64_t* labels = division.Labels->GetPointer(0);
  withMemory({ "the polygons in the rows of pixels", static_cast<double>(count) * sizeof(double) },
    [&]() { division.Power->Label(labels, stages["labels"]); });
  // As with Shape Flow, pixels without mass belong to no site. Polygons cover them nevertheless.
  if (density)
  {
    withMemory({ "the masses of " + describeValues(grid) + " pixels",
                 numberOfValues(grid) * sizeof(std::int64_t) },
      [&]() {
        Progress& work = stages["empty pixels"];
        PixelMasses<2>(
          density->Source<2>(), mass / density->Grid().CellMeasure(), grid.Size<2>(), work)
          .RemoveEmptyPixels(labels, work);
      });
  }
  return division;
}

EqualMassCells::Report writePowerCells(vtkPointSet* sites, const ImageGrid& grid,
  InputDensity* density, StoreSlot& kept, Progress& progress, const CellOutputs& outputs)
{
  Stages stages(progress, { { "comparison", 2 }, { "cells", 93 }, { "output", 5 } });
  // Polygons are exact, so that mass, centroid and cost are integrals over them, not sums of
  // pixels. The filter takes no other norm than the squared distance, for which a power diagram is
  // optimal.
  const auto division = updateDivision(identityOfDivision(sites, grid, nullptr, density), kept,
    stages["comparison"], [&]() { return divideByPower(sites, grid, density, stages["cells"]); });
  const PowerSiteCells& power = *division->Power;
  outputs.Labels->GetCellData()->SetScalars(division->Labels);
  addStatistics(
    outputs, [&power](const SiteCellStatistics& statistics) { return power.Measure(statistics); });
  // A cell has less than 6 corners on average (Euler's formula for planar graphs); each takes up to
  // 60 bytes as a point, a line and an entry of a polygon.
  const double bytes = 60.0 * 6.0 * static_cast<double>(power.NumberOfSites());
  withMemory(
    { "the outlines", bytes }, [&]() { writeOutlines<2>(power.Outlines(), outputs.Outlines); });
  writePolygons(
    withMemory({ "the polygons of the cells", bytes }, [&]() { return power.Polygons(); }), outputs,
    stages["output"]);
  return { power.NumberOutside(), 0, {} };
}

// Throws Failure unless the grid can be divided.
void requireDivisible(const ImageGrid& grid, bool isPower)
{
  requireCells(grid);
  // The solver computes diagrams of polygons.
  if (isPower && grid.Dimension() != 2)
  {
    throw Failure("Shape Power needs a domain of two dimensions; this one has " +
      std::to_string(grid.Dimension()));
  }
}

// Said before they are made, since that takes a while.
void warnOfManyPixels(const EqualMassCells& cells, const ImageGrid& grid)
{
  if (areManyPixels(grid))
  {
    cells.Warn(describeLabelPixels(grid));
  }
}

void requireMemoryForLabels(const ImageGrid& grid, double eachPixel, double more)
{
  requireMemory({ "labels of " + describeValues(grid) + " pixels (see Resolution)",
    numberOfValues(grid) * eachPixel + more });
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
  requireDivisible(grid, this->IsPower);
  warnOfManyPixels(*this, grid);
  // Kept labels need no memory for another labelling: only the exponents of the cost changed.
  if (!kept.Holds(identityOfDivision(sites, grid, this->IsPower ? nullptr : &this->Flow)))
  {
    const auto bytes = dispatchDimension(
      grid.Dimension(), bytesOfLabelling<1>, bytesOfLabelling<2>, bytesOfLabelling<3>);
    requireMemoryForLabels(grid, sizeof(std::int64_t), this->IsPower ? 0.0 : bytes(grid));
  }
  // Outputs are written after all checks of properties and memory.
  applyGrid(grid, outputs.Labels);
  writeSites(sites, outputs.Sites);
  if (this->IsPower)
  {
    return writePowerCells(sites, grid, nullptr, kept, stages["cells"], outputs);
  }
  return dispatchDimension(grid.Dimension(), divide<1>, divide<2>, divide<3>)(
    *this, sites, grid, kept, stages["cells"], outputs);
}

EqualMassCells::Report EqualMassCells::Run(vtkPointSet* sites, InputDensity& density,
  FlowCache& cache, StoreSlot& kept, Progress& progress, const CellOutputs& outputs) const
{
  // The pixels fill the density's box, and need not be its cells.
  const ImageGrid grid = LabelGrid{ this->Resolution }.On(density.Grid());
  requireDivisible(grid, this->IsPower);
  warnOfManyPixels(*this, grid);
  const auto bytes = dispatchDimension(grid.Dimension(), bytesOfLabellingByMass<1>,
    bytesOfLabellingByMass<2>, bytesOfLabellingByMass<3>);
  requireMemoryForLabels(
    grid, sizeof(std::int64_t) * (this->IsPower ? 1.0 : 2.0), this->IsPower ? 0.0 : bytes(grid));
  applyGrid(grid, outputs.Labels);
  writeSites(sites, outputs.Sites);
  if (this->IsPower)
  {
    // Power cells need no flow: the tables of an earlier Shape Flow only take memory.
    cache.Release();
    return writePowerCells(sites, grid, &density, kept, progress, outputs);
  }
  return dispatchDimension(grid.Dimension(), divideMass<1>, divideMass<2>, divideMass<3>)(
    *this, sites, grid, density, cache, kept, progress, outputs);
}

} // namespace RectifiedTransport::Bridge

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TransportMap.h"

#include "Bridge/Data/ImageGrids.h"
#include "Bridge/Flow/MapField.h"
#include "Bridge/Plan/FlowCosts.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Equalize/CorrectedImages.h"
#include "Core/Geometry/Boxes/CommonGrid.h"
#include "Core/Geometry/Boxes/GridResolution.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/PartText.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <optional>

namespace RectifiedTransport::Bridge
{

namespace
{

// The box alone matters: few values, however fine the densities are and however far apart.
ImageGrid boxOf(const NamedGrid& source, const NamedGrid& target)
{
  // commonGrid checks on its way that both grids have the same axes, planes and directions.
  int values[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    values[axis] = source.Grid.IsAxis(axis) ? 2 : 1;
  }
  return commonGrid({ source, target }, values, MostCells::Any);
}

// What the optimal map to a target is of.
DataIdentity identityOf(const DataIdentity& source, const DataIdentity& targetData,
  const ImageGrid& sourceGrid, const TargetDensity& target, const OptimalSetting& setting)
{
  // Both densities, their places, and what the solver is asked for. IsOptimal counts because a map
  // that moves points takes more iterations than a map that gives only a bound (leastIterations).
  DataIdentity identity = source;
  identity.Add(targetData);
  identity.AddGrid(sourceGrid);
  identity.AddGrid(target.Density.Grid());
  identity.AddNumbers(&setting.Tolerance, 1);
  identity.AddNumber(setting.IsOptimal ? 1 : 0);
  identity.AddNumber(setting.Certifies ? 1 : 0);
  return identity;
}

// Gives the part of an image the arrays of the density's input, if the samples are on its grid.
// Collective.
void passArrays(
  const InputDensity& density, const ImageGrid& samples, const Extent& part, vtkImageData* output)
{
  if (samples.Extent() == density.Grid().Extent())
  {
    const vtkSmartPointer<vtkImageData> image = density.ImageIn(part);
    output->GetPointData()->PassData(image->GetPointData());
    output->GetCellData()->PassData(image->GetCellData());
  }
}

// One run in D dimensions: table building, sampling of the map, correction, differentiation. The
// samples are the centres of a lattice, moved forward (x(0) to x(1) of Eqs. 10 to 12) or backward
// (Section 4.2). With a target, a sample goes backward to the uniform measure and from there
// forward to the target (Section 3.4), or by the optimal map between both.
template <int D>
class MapMaker
{
public:
  MapMaker(const TransportMap& map, InputDensity& density, TargetDensity* target,
    const ImageGrid& samples, const Extent& wanted, FlowCache& cache, Progress& progress)
    : Map(map)
    , Density(density)
    , Target(target)
    , Samples(samples)
    , Wanted(wanted)
    , Cache(cache)
    , Work(progress)
    , Lattice(samples.Size<D>())
    , All(numberOfCells<D>(this->Lattice))
    , Count(this->All / progress.Group().Count())
    , IsBackward(target || map.Backward)
    , Equalizes(!target && map.Backward && map.EqualizeAreas)
    , Options(this->Equalizes ? AreaCorrection<D>::OptionsFor(map.Flow) : map.Flow)
  {
  }

  TransportMap::Report Make(vtkImageData* output)
  {
    // The weights of the stages are estimated times (CostModel.h), so that progress is about linear
    // in time. They need not be the same on all ranks.
    const auto cells = static_cast<double>(
      this->Density.Grid().NumberOfCells() + (this->Target ? this->CellsOfTarget() : 0));
    const bool equalizes = this->Equalizes;
    const double count = this->Count;
    const bool countsMasses = D == 3 && this->IsBackward;
    const double steps = Cost::flow(this->Options, D) * count;
    Stages stages(this->Work,
      { { "tables", Cost::tables(this->Cache, this->Density) },
        { "target tables", this->CostOfTarget() },
        { "optimal map", this->MustSolve() ? Cost::OptimalCell * cells : 0.0 },
        { "samples", this->Target ? 2.0 * steps : steps },
        { "areas", equalizes ? Cost::equalization(this->Options, D) * cells : 0.0 },
        { "correction", equalizes ? Cost::Seed * count : 0.0 },
        { "reading", Cost::Reading * cells / this->Work.Group().Count() },
        { "write", (countsMasses ? Cost::MassShare : Cost::Write) * count } });
    // The values belong to the points or cells of the output as the density's do to those of its
    // image.
    const int owner = this->Samples.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
    MapField<D> field(this->Density.Grid(), this->Samples,
      tuplesOf(this->Wanted, owner, this->Samples.Extent()),
      "a map of " + describeSize<D>(this->Lattice) + " samples (see SampleDimensions)",
      this->Work.Group(), this->Target != nullptr);
    // All memory is asked for before the first long stage: a user should not wait for an error.
    this->RequireMemoryForTarget();
    // The grid has the origin, spacing and direction of all samples; the extent is this rank's
    // part.
    applyGrid(this->Samples, output);
    output->SetExtent(this->Wanted.data());

    const SharedFlow& shared = this->UpdateTables(stages);
    const RectifiedFlow<D>& flow = shared.Flow<D>();
    const TransportPlan<D> plan = this->Plan(stages["optimal map"]);
    std::vector<FlowReport> reports = this->MoveSamples(plan, field, stages["samples"]);
    // The correction comes before derivatives and costs, which describe the corrected map.
    const int passes = this->Correct(plan, field, stages);
    const MapFigures figures = this->Write(flow, field, stages, output->GetAttributes(owner));
    // Field data are the same on all ranks: figures are of all samples, and counts are summed.
    addFieldValue(output, "TotalMass", shared.TotalMass());
    addFieldValue(output, "TransportCost", figures.Cost);
    addBound<D>(plan, this->Target ? this->Target->Box : this->Density.Grid(), figures.Cost,
      this->Density.Grid(), output);
    const Ranks& ranks = this->Work.Group();
    const std::int64_t moved = sumOverRanks(ranks, reports.back().MovedToMass);
    addFieldValue(output, "MovedSamples", static_cast<double>(moved));
    addFieldValue(output, "FoldedCells", static_cast<double>(figures.Folds.Samples));
    addFieldValues(
      output, "LargestBlockError", { figures.Blocks.Quantile, figures.Blocks.Largest }, 2);
    const bool isUncorrected =
      equalizes && addEqualAreas(output, ranks, passes, reports.front()) == 0;
    addSteps(output, reports);
    // A fold of a thousandth of the samples with mass, or of the area, deserves a warning. Fewer
    // are errors of the integration.
    const bool showsFolds = isWorthWarning(figures.Folds.Samples, figures.WithMass) ||
      isWorthWarning(figures.Folds.Area.Value(), this->All);
    return { this->Samples, this->All, reports, TransportReport(plan), moved, figures.Folds.Samples,
      showsFolds, isUncorrected };
  }

private:
  std::int64_t CellsOfTarget() const { return this->Target->Density.Grid().NumberOfCells(); }
  // The tables of the target are built only if the cache has none for its density.
  double CostOfTarget() const
  {
    return this->Target ? Cost::tables(this->Target->Cache.Tables, this->Target->Density) : 0.0;
  }
  bool MustSolve() const
  {
    // The map of the last run serves again if neither density, grid nor setting has changed, judged
    // by modification times: hashing both densities only to estimate progress would cost too much.
    const OptimalSetting& setting = this->Map.Optimal;
    if (!this->Target)
    {
      return Cost::optimal(this->Cache, this->Density, setting) > 0.0;
    }
    return setting.NeedsMap() &&
      !this->Target->Cache.Map.Holds(identityOf(this->Density.Identity(),
        this->Target->Density.Identity(), this->Density.Grid(), *this->Target, setting));
  }

  // Before the tables: they would take long for nothing.
  void RequireMemoryForTarget() const
  {
    // Collective because modification times are local: either all ranks solve, or none does.
    const Ranks& ranks = this->Work.Group();
    if (this->Target && !onAllRanks(ranks, !this->MustSolve()))
    {
      const double tables = RectifiedFlow<D>::MemoryFor(this->Density.Grid().Size<D>()) +
        RectifiedFlow<D>::MemoryFor(this->Target->Density.Grid().Size<D>());
      requireMemory(this->MemoryForTarget().With(tables));
    }
  }
  // The peak is the solution of the optimal map between the two grids, not its use for samples.
  MemoryPlan MemoryForTarget() const
  {
    return memoryOfOptimalMap<D>(this->Density.Grid().Size<D>(),
      this->Target->Density.Grid().Size<D>(), { this->Map.Optimal }, this->Work.Group());
  }

  // Seeds on a lattice take less memory in tiles than scattered points, which samples are on their
  // way from the uniform measure to a target. Equal areas and the optimal map read whole tables.
  FlowTables Tables(const InputDensity& density, FlowDirection direction, bool isLattice) const
  {
    return requireTables(chooseTables<D>(this->Map.Tables, density.Grid().Size<D>(),
      { this->Options, direction, this->Count, isLattice,
        this->Equalizes ? EqualAreas : this->Map.Optimal.WholeFor() }));
  }

  const SharedFlow& UpdateTables(Stages& stages)
  {
    const FlowTables tables = this->Tables(
      this->Density, this->IsBackward ? FlowDirection::Backward : FlowDirection::Forward, true);
    if (!this->Target)
    {
      return this->Cache.Update(this->Density, stages["tables"], tables, { this->Map.Optimal });
    }
    // With two densities, an error has to say which of them is meant.
    const auto update = [&](FlowCache& flows, InputDensity& density, const std::string& name,
                          FlowTables kind, Progress& making) -> const SharedFlow& {
      try
      {
        return flows.Update(density, making, kind);
      }
      catch (const Failure& failure)
      {
        throw Failure(name, failure);
      }
    };
    const SharedFlow& shared =
      update(this->Cache, this->Density, this->Target->SourceName, tables, stages["tables"]);
    this->Cache.ClearMaps(); // to the uniform measure
    update(this->Target->Cache.Tables, this->Target->Density, this->Target->Name,
      this->Tables(this->Target->Density, FlowDirection::Forward, false), stages["target tables"]);
    return shared;
  }

  TransportPlan<D> Plan(Progress& progress)
  {
    return this->Target
      ? this->PlanToTarget(progress)
      : this->Cache.template Plan<D>({ this->Map.Optimal }, this->Options, this->Density, progress);
  }

  TransportPlan<D> PlanToTarget(Progress& progress)
  {
    const OptimalSetting& setting = this->Map.Optimal;
    TargetCache& kept = this->Target->Cache;
    // Both ends lie in one box, the smallest that contains both domains: squared distances, and
    // with them the cost and its bound, are in the squared unit of that box (LengthScale).
    PlanEnd<D> source =
      planEnd<D>(PlanEnd<D>::In(this->Target->Box, this->Density.Grid()), this->Density);
    PlanEnd<D> target = planEnd<D>(
      PlanEnd<D>::In(this->Target->Box, this->Target->Density.Grid()), this->Target->Density);
    // The tables exist already, so that the plan builds none of its own.
    source.Flow = this->Cache.template Flow<D>();
    target.Flow = kept.Tables.Flow<D>();
    PlanOptions options = planOptions(setting, this->Options);
    options.Optimal.LeastIterations = leastIterations(setting.IsOptimal);
    const MemoryPlan memory = this->MemoryForTarget();
    Stages stages(progress, { { "map", 9 }, { "check", 1 } });
    typename TransportPlan<D>::Map map;
    // The map is solved once for all filters of the process that need it for these densities.
    if (setting.NeedsMap())
    {
      const auto solve = [&]() {
        return withRequiredMemory(memory, [&]() {
          return TransportPlan<D>::Solve(&source, target, options.Optimal, stages["map"]);
        });
      };
      map = kept.Map.Get<typename TransportPlan<D>::Map::element_type>(
        identityOf(this->Cache.Identity(), kept.Tables.Identity(), this->Density.Grid(),
          *this->Target, setting),
        this->Work.Group(), stages["map"], Sharing::Process, solve);
    }
    else
    {
      kept.Map.Release();
    }
    // Construction checks whether the map reaches its target; where it does not, flows move the
    // points and the plan has a warning.
    return withMemory(
      memory, [&]() { return TransportPlan<D>(source, target, options, stages["check"], map); });
  }

  // With a target, reports both flows.
  std::vector<FlowReport> MoveSamples(
    const TransportPlan<D>& plan, MapField<D>& field, Progress& progress) const
  {
    // Positions are written for this rank's part alone, in the memory of field.Positions().
    const auto seeds = FlowSeeds<D>::Lattice(this->Lattice, field.Parts());
    if (!this->Target)
    {
      return plan.Move(this->Map.Backward ? FlowDirection::Backward : FlowDirection::Forward, seeds,
        field.Positions(), progress);
    }
    auto reports =
      withMemory({ "the samples between the densities (see SampleDimensions)",
                   2.0 * D * sizeof(double) * static_cast<double>(field.Part().Count()) },
        [&]() { return plan.Move(FlowDirection::Forward, seeds, field.Positions(), progress); });
    // The optimal map reports once: the other report is that of a flow that moved nothing.
    reports.resize(2);
    return reports;
  }

  // Returns how many passes corrected the areas.
  int Correct(const TransportPlan<D>& plan, MapField<D>& field, Stages& stages)
  {
    // Frees the memory of a correction of an earlier run, which takes D floats a corner of the
    // cells.
    if (!this->Equalizes)
    {
      this->Cache.ClearCorrection();
      return 0;
    }
    // The correction moves the images of the cells' corners towards areas in proportion to the
    // masses (Moser's construction, see EqualizeAreas.h). A sample moves as the corners of its cell
    // do.
    const auto correction =
      this->Cache.template Correction<D>(plan, this->Map.Optimal, this->Options, stages["areas"]);
    correctImages<D>(*correction, latticeStep<D>(this->Lattice, plan.Size()), field.Part(),
      field.Parts(), field.Positions(), stages["correction"]);
    return correction->Report().Passes;
  }

  MapFigures Write(
    const RectifiedFlow<D>& flow, MapField<D>& field, Stages& stages, vtkDataSetAttributes* output)
  {
    // Whole tables may have been made by another filter: these values are read piece by piece.
    this->Density.Prepare(FlowTables::Tiled, stages["reading"]);
    // The errors of blocks and CostDensity of a map between two densities need the values of both.
    std::optional<MapTarget<D>> target;
    if (this->Target)
    {
      InputDensity& density = this->Target->Density;
      density.Prepare(FlowTables::Tiled, stages["reading"]);
      target.emplace(MapTarget<D>{ density.Grid(),
        { density.Source<D>(), this->Target->Cache.Tables.template Flow<D>()->Total() } });
    }
    return field.Write(flow, this->IsBackward ? FlowDirection::Backward : FlowDirection::Forward,
      this->Density.Source<D>(), stages["write"], output, target ? &*target : nullptr);
  }

  const TransportMap& Map;
  InputDensity& Density;
  TargetDensity* const Target;
  const ImageGrid& Samples;
  Extent Wanted; // VTK takes no constant one
  FlowCache& Cache;
  Progress& Work;
  const GridSize<D> Lattice;
  const double All; // samples
  const double Count;
  const bool IsBackward; // samples are of the density, not of the uniform measure
  const bool Equalizes;
  const FlowOptions Options;
};

template <int D>
TransportMap::Report makeMap(const TransportMap& map, InputDensity& density, TargetDensity* target,
  const ImageGrid& samples, const Extent& wanted, FlowCache& cache, Progress& progress,
  vtkImageData* output)
{
  return MapMaker<D>(map, density, target, samples, wanted, cache, progress).Make(output);
}

} // namespace

TargetDensity::TargetDensity(const InputDensity& source, const std::string& sourceName,
  InputDensity& target, const std::string& targetName, TargetCache& cache)
  : Density(target)
  , SourceName(sourceName)
  , Name(targetName)
  , Box(boxOf({ source.Grid(), sourceName }, { target.Grid(), targetName }))
  , Cache(cache)
{
}

ImageGrid TransportMap::SampleGrid(const InputDensity& density) const
{
  return gridWithValues(density.Grid(), this->SampleDimensions.data(), "SampleDimensions");
}

TransportMap::Report TransportMap::Run(InputDensity& density, TargetDensity* target,
  const Extent& wanted, FlowCache& cache, Progress& progress, vtkImageData* output) const
{
  // A rank may want nothing, for example because another filter requested a small extent.
  const ImageGrid samples = this->SampleGrid(density);
  const Extent part = intersectionOf(wanted, samples.Extent());
  passArrays(density, samples, part, output);
  return dispatchDimension(samples.Dimension(), makeMap<1>, makeMap<2>, makeMap<3>)(
    *this, density, target, samples, part, cache, progress, output);
}

} // namespace RectifiedTransport::Bridge

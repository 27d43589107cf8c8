// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MapToTarget.h"

#include "Bridge/Density/CostBound.h"
#include "Bridge/Density/CostModel.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/PairMap.h"
#include "Bridge/Density/TableChoice.h"
#include "Bridge/Flow/MapField.h"
#include "Bridge/Flow/MapShares.h"
#include "Bridge/Flow/TargetTransport.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport::Bridge
{

namespace
{

// Moves the samples from the source to the uniform measure, and on to the target: the points of the
// two unit boxes correspond (Section 3.4).
template <int D>
std::array<FlowReport, 2> moveByFlows(const RectifiedFlow<D>& source,
  const RectifiedFlow<D>& target, const FlowOptions& options, MapField<D>& field,
  Progress& progress)
{
  const LatticeParts<D> parts = field.Parts();
  const PointSpan<D> positions = field.Positions();
  Stages stages(progress, { { "back", 50 }, { "starts", 1 }, { "forth", 48 }, { "images", 1 } });
  const FlowReport back = source.Backward(
    FlowSeeds<D>::Lattice(field.Whole(), parts), positions, options, stages["back"]);

  const std::int64_t count = field.Part().Count();
  const double bytes = 2.0 * D * sizeof(double) * static_cast<double>(count);
  LargeBuffer<double> starts;
  LargeBuffer<double> images;
  withMemory("the samples between the densities (see SampleDimensions)", bytes, [&]() {
    starts = LargeBuffer<double>(count * D);
    images = LargeBuffer<double>(count * D);
  });
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  stages["starts"].For(count, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const double* from = positions[parts.IndexOf(field.Part().CellOf(i))];
      for (int axis = 0; axis < D; ++axis)
      {
        const auto size = static_cast<double>(target.Size()[axis]);
        const double ratio = size / static_cast<double>(source.Size()[axis]);
        starts.data()[D * i + axis] = std::min(size, from[axis] * ratio);
      }
    }
  });
  const FlowReport forth = target.Forward(
    FlowSeeds<D>(starts.data(), count), { images.data(), count }, options, stages["forth"]);
  stages["images"].For(count, grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const double* image = images.data() + D * i;
      std::copy_n(image, D, positions[parts.IndexOf(field.Part().CellOf(i))]);
    }
  });
  return { back, forth };
}

// Before the tables: they would take long for nothing.
template <int D>
void requireMemoryForMap(
  const TransportMap& map, const DensityPair& pair, const TargetTransport& kept, const Ranks& ranks)
{
  const GridSize<D> source = pair.Source.Grid().Size<D>();
  const GridSize<D> target = pair.Target.Grid().Size<D>();
  if (!onAllRanks(ranks, !kept.MustSolve(pair, map.Optimal)))
  {
    memoryOfPair<D>(source, target, { map.Optimal }, ranks)
      .Require(RectifiedFlow<D>::MemoryFor(source) + RectifiedFlow<D>::MemoryFor(target));
  }
}

template <int D>
TransportMap::Report makeMapToTarget(const TransportMap& map, const DensityPair& pair,
  const ImageGrid& samples, const Extent& wanted, FlowCache& cache, TargetTransport& kept,
  Progress& progress, vtkImageData* output)
{
  const Ranks& ranks = progress.Group();
  const GridSize<D> lattice = samples.Size<D>();
  const double all = numberOfCells<D>(lattice);
  const double count = all / ranks.Count();
  const double cells =
    static_cast<double>(pair.Source.Grid().NumberOfCells() + pair.Target.Grid().NumberOfCells());
  const double moving = map.Optimal.IsOptimal ? Cost::Seed : Cost::flow(map.Flow, D);
  Stages stages(progress,
    { { "source tables", Cost::tables(cache, pair.Source) },
      { "target tables", Cost::tables(kept.Tables, pair.Target) },
      { "optimal map", kept.MustSolve(pair, map.Optimal) ? Cost::OptimalCell * cells : 0.0 },
      { "check", map.Optimal.IsOptimal ? moving * count : 0.0 },
      { "samples", (map.Optimal.IsOptimal ? 1.0 : 2.0) * moving * count },
      { "reading", Cost::Reading * cells / ranks.Count() },
      { "write", (D == 3 ? Cost::MassShare : Cost::Write) * count } });
  const int owner = samples.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  MapField<D> field(pair.Source.Grid(), samples, tuplesOf(wanted, owner, samples.Extent()),
    "a map of " + describeSize<D>(lattice) + " samples (see SampleDimensions)", ranks, true);
  requireMemoryForMap<D>(map, pair, kept, ranks);
  applyGrid(samples, output);
  Extent extent = wanted; // VTK takes no constant one
  output->SetExtent(extent.data());

  const auto tablesOf = [&](InputDensity& density, FlowDirection direction, bool isLattice) {
    return chooseTables<D>(map.Tables, density.Grid().Size<D>(),
      { map.Flow, direction, count, isLattice, map.Optimal.WholeFor() });
  };
  const auto update = [&](FlowCache& flows, InputDensity& density, const std::string& name,
                        FlowTables tables, Progress& making) -> const SharedFlow& {
    try
    {
      return flows.Update(density, making, tables);
    }
    catch (const Failure& failure)
    {
      throw Failure(name, failure);
    }
  };
  const SharedFlow& shared = update(cache, pair.Source, pair.SourceName,
    tablesOf(pair.Source, FlowDirection::Backward, true), stages["source tables"]);
  cache.ForgetMaps(); // to the uniform measure
  const SharedFlow& sharedTarget = update(kept.Tables, pair.Target, pair.TargetName,
    tablesOf(pair.Target, FlowDirection::Forward, false), stages["target tables"]);
  const RectifiedFlow<D>& flow = shared.Flow<D>();
  const RectifiedFlow<D>& targetFlow = sharedTarget.Flow<D>();
  const auto optimal = kept.Map<D>(pair, map.Optimal, stages["optimal map"]);
  TransportReport transport;
  if (map.Optimal.IsOptimal)
  {
    const OptimalMemory memory =
      memoryOfPair<D>(flow.Size(), targetFlow.Size(), { map.Optimal }, ranks);
    transport.Warning = unresolvedText(withMemory(
      memory.Purpose, memory.Bytes, [&]() { return optimal->MassError(stages["check"]); }));
    transport.IsOptimal = transport.Warning.empty();
  }
  std::array<FlowReport, 2> flows;
  if (transport.IsOptimal)
  {
    flows[0] = optimal->Forward(FlowSeeds<D>::Lattice(lattice, field.Parts()), field.Positions(),
      map.Flow, stages["samples"]);
  }
  else
  {
    flows = moveByFlows<D>(flow, targetFlow, map.Flow, field, stages["samples"]);
  }
  prepareShares<D>(flow, lattice, field.WeighedPart());
  for (InputDensity* density : { &pair.Source, &pair.Target })
  {
    density->Prepare(FlowTables::Tiled, stages["reading"]);
  }
  const DensitySource<D> target = pair.Target.Source<D>();
  const MapTarget<D> mapTarget{ pair.Target.Grid(), { target, targetFlow.Total() } };
  const MapFigures figures = field.Write(flow, FlowDirection::Backward, pair.Source.Source<D>(),
    stages["write"], output->GetAttributes(owner), &mapTarget);
  addFieldValue(output, "TotalMass", shared.TotalMass());
  addFieldValue(output, "TransportCost", figures.Cost);
  if (optimal)
  {
    const double bound = LengthScale(pair.Box).CostFromUnits(optimal->LowerBound());
    addCostBound(output, bound, figures.Cost, pair.Source.Grid());
  }
  const std::int64_t moved = sumOverRanks(ranks, flows[1].MovedToMass);
  addFieldValue(output, "MovedSamples", static_cast<double>(moved));
  addFieldValue(output, "FoldedCells", static_cast<double>(figures.Folded));
  addFieldTuple(output, "LargestBlockError", { figures.Blocks.Quantile, figures.Blocks.Largest });
  addSteps(output, { flows[0], flows[1] });
  return { samples, all, flows[0], transport, moved, figures.Folded, figures.ShowsFolds, false,
    flows[1] };
}

} // namespace

TransportMap::Report runToTarget(const TransportMap& map, const DensityPair& pair,
  const Extent& wanted, FlowCache& cache, TargetTransport& kept, Progress& progress,
  vtkImageData* output)
{
  const ImageGrid samples = map.SampleGrid(pair.Source);
  const Extent part = intersectionOf(wanted, samples.Extent());
  passArrays(pair.Source, samples, part, output);
  return dispatchDimension(samples.Dimension(), makeMapToTarget<1>, makeMapToTarget<2>,
    makeMapToTarget<3>)(map, pair, samples, part, cache, kept, progress, output);
}

} // namespace RectifiedTransport::Bridge

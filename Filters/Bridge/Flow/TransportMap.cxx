// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TransportMap.h"

#include "Bridge/Density/CostModel.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/TableChoice.h"
#include "Bridge/Flow/CorrectedImages.h"
#include "Bridge/Flow/MapField.h"
#include "Bridge/Flow/MapShares.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>

namespace RectifiedTransport::Bridge
{

namespace
{

template <int D>
TransportMap::Report makeMap(const TransportMap& map, InputDensity& density,
  const ImageGrid& samples, const Extent& wanted, FlowCache& cache, Progress& progress,
  vtkImageData* output)
{
  const Ranks& ranks = progress.Group();
  const GridSize<D> lattice = samples.Size<D>();
  const double all = numberOfCells<D>(lattice);
  const double count = all / ranks.Count();
  const bool equalizes = map.Backward && map.EqualizeAreas;
  const FlowOptions options = equalizes ? AreaCorrection<D>::OptionsFor(map.Flow) : map.Flow;
  const double cells = static_cast<double>(density.Grid().NumberOfCells());
  Stages stages(progress,
    { { "tables", Cost::tables(cache, density) },
      { "optimal map", Cost::optimal(cache, density, map.Optimal) },
      { "samples", Cost::flow(options, D) * count },
      { "areas", equalizes ? Cost::equalization(options, D) * cells : 0.0 },
      { "correction", equalizes ? Cost::Seed * count : 0.0 },
      { "reading", Cost::Reading * cells / ranks.Count() },
      { "write", (map.Backward && D == 3 ? Cost::MassShare : Cost::Write) * count } });
  const int owner = samples.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  MapField<D> field(density.Grid(), samples, tuplesOf(wanted, owner, samples.Extent()),
    "a map of " + describeSize<D>(lattice) + " samples (see SampleDimensions)", ranks);
  applyGrid(samples, output);
  Extent extent = wanted; // VTK takes no constant one
  output->SetExtent(extent.data());

  const FlowTables tables = chooseTables<D>(map.Tables, density.Grid().Size<D>(),
    { options, map.Backward ? FlowDirection::Backward : FlowDirection::Forward, count, true,
      equalizes ? EqualAreas : map.Optimal.WholeFor() });
  const SharedFlow& shared = cache.Update(density, stages["tables"], tables, { map.Optimal });
  const RectifiedFlow<D>& flow = shared.Flow<D>();
  const DensityTransport<D> transport =
    cache.Transport<D>({ map.Optimal }, density, stages["optimal map"]);
  const auto seeds = FlowSeeds<D>::Lattice(lattice, field.Parts());
  FlowReport report = map.Backward
    ? transport.Points().Backward(seeds, field.Positions(), options, stages["samples"])
    : transport.Points().Forward(seeds, field.Positions(), options, stages["samples"]);
  int passes = 0;
  if (equalizes)
  {
    const auto correction = cache.Correction<D>(transport, options, stages["areas"]);
    correctImages<D>(*correction, latticeStep<D>(lattice, flow.Size()), field.Part(), field.Parts(),
      field.Positions(), stages["correction"]);
    passes = correction->Report().Passes;
  }
  else
  {
    cache.ForgetCorrection();
  }
  if (map.Backward)
  {
    prepareShares<D>(flow, field.Whole(), field.Part());
  }
  // Whole tables may have been made by another filter: these values are read piece by piece.
  density.Prepare(FlowTables::Tiled, stages["reading"]);
  const MapFigures figures =
    field.Write(flow, map.Backward ? FlowDirection::Backward : FlowDirection::Forward,
      density.Source<D>(), stages["write"], output->GetAttributes(owner));
  addFieldValue(output, "TotalMass", shared.TotalMass());
  addFieldValue(output, "TransportCost", figures.Cost);
  transport.AddBound(figures.Cost, output);
  const std::int64_t moved = sumOverRanks(ranks, report.MovedToMass);
  addFieldValue(output, "MovedSamples", static_cast<double>(moved));
  addFieldValue(output, "FoldedCells", static_cast<double>(figures.Folded));
  addFieldTuple(output, "LargestBlockError", { figures.Blocks.Quantile, figures.Blocks.Largest });
  const bool isUncorrected = equalizes && addEqualAreas(output, ranks, passes, report) == 0;
  addSteps(output, { report });
  return { samples, all, report, transport.Report(), moved, figures.Folded, figures.ShowsFolds,
    isUncorrected, {} };
}

} // namespace

void passArrays(const InputDensity& density, const ImageGrid& samples,
  const std::array<int, 6>& part, vtkImageData* output)
{
  if (samples.Extent() == density.Grid().Extent())
  {
    const vtkSmartPointer<vtkImageData> image = density.ImageIn(part);
    output->GetPointData()->PassData(image->GetPointData());
    output->GetCellData()->PassData(image->GetCellData());
  }
}

ImageGrid TransportMap::SampleGrid(const InputDensity& density) const
{
  return gridWithValues(density.Grid(), this->SampleDimensions.data(), "SampleDimensions");
}

TransportMap::Report TransportMap::Run(InputDensity& density, const Extent& wanted,
  FlowCache& cache, Progress& progress, vtkImageData* output) const
{
  const ImageGrid samples = this->SampleGrid(density);
  const Extent part = intersectionOf(wanted, samples.Extent());
  passArrays(density, samples, part, output);
  return dispatchDimension(samples.Dimension(), makeMap<1>, makeMap<2>, makeMap<3>)(
    *this, density, samples, part, cache, progress, output);
}

} // namespace RectifiedTransport::Bridge

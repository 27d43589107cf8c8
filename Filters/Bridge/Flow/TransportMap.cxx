// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TransportMap.h"

#include "Bridge/Density/CostModel.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Density/TableChoice.h"
#include "Bridge/Flow/MapField.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/StepReport.h"
#include "Core/Geometry/Dispatch.h"
#include "Core/Parallel/RankExchange.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

namespace
{

// For the masses in the cells of a part of the lattice.
template <int D>
void prepareShares(
  const RectifiedFlow<D>& flow, const GridSize<D>& lattice, const LatticePart<D>& part)
{
  const Point<D> step = latticeStep<D>(lattice, flow.Size());
  GridSize<D> low{};
  GridSize<D> high{};
  for (int a = 0; a < D && part.Count() > 0; ++a)
  {
    low[a] = static_cast<std::int64_t>(static_cast<double>(part.Low[a]) * step[a]);
    const double end = std::ceil(static_cast<double>(part.Low[a] + part.Cells[a]) * step[a]);
    high[a] = std::min(flow.Size()[a], static_cast<std::int64_t>(end) + 1);
  }
  flow.PrepareShares(low, high);
}

// Corrects the images of this rank's samples.
template <int D>
void correct(
  const AreaCorrection<D>& correction, const Point<D>& step, MapField<D>& field, Progress& progress)
{
  constexpr std::int64_t grain = 1 << 12;
  const LatticePart<D>& part = field.Part();
  const LatticeParts<D> parts = field.Parts();
  const PointSpan<D> positions = field.Positions();
  progress.For(part.Count(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const GridSize<D> cell = part.CellOf(i);
      Point<D> sample;
      for (int a = 0; a < D; ++a)
      {
        sample[a] = (static_cast<double>(cell[a]) + 0.5) * step[a];
      }
      correction.Correct(sample.data(), positions[parts.IndexOf(cell)]);
    }
  });
}

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
  const auto ends = stageEnds({ Cost::tables(cache, density), Cost::flow(options, D) * count,
    equalizes ? Cost::equalization(options, D) * cells : 0.0, equalizes ? Cost::Seed * count : 0.0,
    (map.Backward && D == 3 ? Cost::MassShare : Cost::Write) * count });
  const int owner = samples.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL;
  MapField<D> field(density.Grid(), samples, tuplesOf(wanted, owner, samples.Extent()),
    "a map of " + describeSize<D>(lattice) + " samples (see SampleDimensions)", ranks);
  applyGrid(samples, output);
  Extent extent = wanted; // VTK takes no constant one
  output->SetExtent(extent.data());

  const FlowTables tables = chooseTables<D>(map.Tables, density.Grid().Size<D>(),
    { options, map.Backward ? FlowDirection::Backward : FlowDirection::Forward, count, true,
      equalizes ? EqualAreas : "" });
  const SharedFlow& shared = cache.Update(density, progress, ends[0], tables);
  const RectifiedFlow<D>& flow = shared.Flow<D>();
  progress.BeginStage(ends[1]);
  const auto seeds = FlowSeeds<D>::Lattice(lattice, field.Parts());
  const PointTransport<D>& transport = shared.Transport<D>();
  FlowReport report = map.Backward
    ? transport.Backward(seeds, field.Positions(), options, progress.Stage())
    : transport.Forward(seeds, field.Positions(), options, progress.Stage());
  int passes = 0;
  if (equalizes)
  {
    progress.BeginStage(ends[2]);
    const auto correction = cache.Correction<D>(options, progress);
    progress.BeginStage(ends[3], field.Part().Count());
    correct<D>(*correction, latticeStep<D>(lattice, flow.Size()), field, progress);
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
  density.Prepare(FlowTables::Tiled, progress);
  const MapFigures figures =
    field.Write(flow, map.Backward ? FlowDirection::Backward : FlowDirection::Forward,
      density.Source<D>(), progress, 1.0, output->GetAttributes(owner));
  addFieldValue(output, "TotalMass", shared.TotalMass());
  addFieldValue(output, "TransportCost", figures.Cost);
  const std::int64_t moved = sumOverRanks(ranks, report.MovedToMass);
  addFieldValue(output, "MovedSamples", static_cast<double>(moved));
  addFieldValue(output, "FoldedCells", static_cast<double>(figures.Folded));
  addFieldTuple(output, "LargestBlockError", { figures.Blocks.Quantile, figures.Blocks.Largest });
  const bool isUncorrected = equalizes && addEqualAreas(output, ranks, passes, report) == 0;
  addSteps(output, { report });
  return { samples, all, report, moved, figures.Folded, isUncorrected };
}

} // namespace

ImageGrid TransportMap::SampleGrid(const InputDensity& density) const
{
  return gridWithValues(density.Grid(), this->SampleDimensions.data(), "SampleDimensions");
}

TransportMap::Report TransportMap::Run(InputDensity& density, const Extent& wanted,
  FlowCache& cache, Progress& progress, vtkImageData* output) const
{
  const ImageGrid samples = this->SampleGrid(density);
  const Extent part = intersectionOf(wanted, samples.Extent());
  if (samples.Extent() == density.Grid().Extent())
  {
    const vtkSmartPointer<vtkImageData> image = density.ImageIn(part);
    output->GetPointData()->PassData(image->GetPointData());
    output->GetCellData()->PassData(image->GetCellData());
  }
  return dispatchDimension(samples.Dimension(), makeMap<1>, makeMap<2>, makeMap<3>)(
    *this, density, samples, part, cache, progress, output);
}

} // namespace RectifiedTransport

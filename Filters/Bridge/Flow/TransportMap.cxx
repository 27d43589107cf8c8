// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/TransportMap.h"

#include "Bridge/Density/CostModel.h"
#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/TableChoice.h"
#include "Bridge/Flow/MapField.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/FieldValue.h"
#include "Core/Geometry/Dispatch.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

namespace RectifiedTransport
{

namespace
{

template <int D>
TransportMap::Report makeMap(const TransportMap& map, DensityImage& density,
  const ImageGrid& samples, FlowCache& cache, Progress& progress, vtkImageData* output)
{
  const GridSize<D> lattice = samples.Size<D>();
  const double count = numberOfCells<D>(lattice);
  const auto ends = stageEnds({ Cost::tables(cache, density), Cost::flow(map.Flow, D) * count,
    (map.Backward && D == 3 ? Cost::MassShare : Cost::Write) * count });
  MapField<D> field(density.Grid(), lattice,
    "a map of " + describeSize<D>(lattice) + " samples (see SampleDimensions)");
  applyGrid(samples, output);

  const FlowTables tables = chooseTables<D>(map.Tables, density.Grid().Size<D>(),
    { map.Flow, map.Backward ? FlowDirection::Backward : FlowDirection::Forward, count, true, "" });
  const SharedFlow& shared = cache.Update(density, progress, ends[0], tables);
  const RectifiedFlow<D>& flow = shared.Flow<D>();
  progress.BeginStage(ends[1]);
  const FlowReport report = map.Backward
    ? flow.BackwardLattice(lattice, field.Positions(), map.Flow, progress.Stage())
    : flow.ForwardLattice(lattice, field.Positions(), map.Flow, progress.Stage());
  const double cost = field.Write(map.Backward ? &flow : nullptr, progress, 1.0,
    output->GetAttributes(samples.IsOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL));
  addFieldValue(output, "TotalMass", shared.TotalMass());
  addFieldValue(output, "TransportCost", cost);
  return { field.Count(), report.MovedToMass };
}

} // namespace

TransportMap::Report TransportMap::Run(
  DensityImage& density, FlowCache& cache, Progress& progress, vtkImageData* output) const
{
  const ImageGrid samples =
    gridWithValues(density.Grid(), this->SampleDimensions.data(), "SampleDimensions");
  if (samples.Extent() == density.Grid().Extent())
  {
    output->GetPointData()->PassData(density.Image()->GetPointData());
    output->GetCellData()->PassData(density.Image()->GetCellData());
  }
  return dispatchDimension(samples.Dimension(), makeMap<1>, makeMap<2>, makeMap<3>)(
    *this, density, samples, cache, progress, output);
}

} // namespace RectifiedTransport

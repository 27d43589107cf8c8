// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MapField.h"

#include "Bridge/Ranks/SameOnRanks.h"
#include "Bridge/Run/Memory.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/Distributed/BoxExchange.h"
#include "Core/Messages/PartText.h"
#include "Core/Parallel/RankExchange.h"
#include "Core/Parallel/Stages.h"
#include "Core/Quality/MapFolds.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"

#include <algorithm>
#include <utility>

namespace RectifiedTransport::Bridge
{

template <int D>
MapField<D>::MapField(const ImageGrid& geometry, const ImageGrid& samples, const TupleBox& wanted,
  const std::string& purpose, const Ranks& ranks, bool hasTarget)
  : Geometry(geometry)
  , Processes(ranks)
  , Lattice(samples.Size<D>())
  , OwnPart(LatticePart<D>::WholeOf(this->Lattice))
  , Wanted(this->OwnPart)
  , Measured(this->OwnPart)
  , Kept(this->OwnPart)
{
  if (ranks.AreSeveral())
  {
    this->FindParts(samples, wanted, ranks);
  }
  constexpr double real = sizeof(double);
  const double kept = numberOfCells<D>(this->Kept.Cells) + static_cast<double>(this->Ahead);
  const double count = numberOfCells<D>(this->Wanted.Cells);
  const double vectors = D == 3 ? std::max(kept, count) : count;
  const double scratch = D == 3 ? 0.0 : real * D * kept;
  const double scalars = hasTarget ? 3.0 : 2.0;
  requireMemory({ purpose, real * (3.0 * vectors + scalars * count) + scratch });
  this->Displacement = newArray<vtkDoubleArray>("Displacement", 3, static_cast<vtkIdType>(vectors));
  if (D != 3)
  {
    withMemory({ purpose, scratch },
      [&]() { this->PositionBuffer = LargeBuffer<double>(this->Kept.Count() * D); });
  }
}

// Pieces as VTK divides extents, of which points at common faces belong to the upper one.
template <int D>
void MapField<D>::FindParts(const ImageGrid& samples, const TupleBox& wanted, const Ranks& ranks)
{
  const Extent& whole = samples.Extent();
  int axis = 0;
  for (int a = 0; a < 3; ++a)
  {
    this->Start[static_cast<std::size_t>(a)] = whole[static_cast<std::size_t>(2 * a)];
    if (samples.IsAxis(static_cast<std::size_t>(a)))
    {
      this->Axes[static_cast<std::size_t>(axis++)] = a;
    }
  }
  for (const Extent& extent : dividedExtent(whole, ranks.Count()))
  {
    LatticePart<D> part{ {}, {} };
    for (int a = 0; a < D && !isEmpty(extent); ++a)
    {
      const auto along = static_cast<std::size_t>(2 * this->Axes[static_cast<std::size_t>(a)]);
      const bool isLast = extent[along + 1] == whole[along + 1] && samples.IsOnPoints();
      part.Low[a] = extent[along] - whole[along];
      part.Cells[a] = extent[along + 1] - extent[along] + (isLast ? 1 : 0);
    }
    if (this->Held.size() == static_cast<std::size_t>(ranks.Own()))
    {
      this->OwnPart = part;
    }
    this->Held.push_back(this->BoxOf(part));
  }
  this->Wanted = latticePartOf<D>(wanted, samples);
  this->Measured = this->OwnPart.Around(this->Lattice)
                     .With(MapBlocks<D>::SamplesOf(MapBlocks<D>::Of(this->Lattice, this->OwnPart)));
  this->Kept = this->Wanted.Around(this->Lattice).With(this->Measured);
  // Displacements are written layer by layer where positions of layers before were.
  const int last = D - 1;
  if (D == 3 && this->Wanted.Count() > 0 && this->Kept.Low[last] == this->Wanted.Low[last])
  {
    this->Ahead = this->Wanted.Count() / this->Wanted.Cells[last];
  }
}

template <int D>
TupleBox MapField<D>::BoxOf(const LatticePart<D>& part) const
{
  TupleBox box{};
  std::copy(this->Start.begin(), this->Start.end(), box.Low.begin());
  box.Cells.fill(part.IsEmpty() ? 0 : 1);
  for (int a = 0; a < D; ++a)
  {
    const auto along = static_cast<std::size_t>(this->Axes[static_cast<std::size_t>(a)]);
    box.Low[along] += part.Low[a];
    box.Cells[along] = part.Cells[a];
  }
  return box;
}

template <int D>
PointSpan<D> MapField<D>::Positions()
{
  double* first =
    D == 3 ? this->Displacement->GetPointer(3 * this->Ahead) : this->PositionBuffer.data();
  return { first, this->Kept.Count() };
}

// What derivatives at the border of the wanted samples depend on, and figures of this rank's.
template <int D>
void MapField<D>::Complete()
{
  const TupleMemory positions = TupleMemory::Of(this->Positions().data(), D);
  for (const LatticePart<D>& part : { this->Wanted.Around(this->Lattice), this->Measured })
  {
    completeBoxes(
      this->Held, this->BoxOf(part), this->BoxOf(this->Kept), this->Processes, positions);
  }
}

// From the index space of the target to that of the samples, where images may be outside the
// domain.
template <int D>
void MapField<D>::TakeFrom(const MapTarget<D>& target, Progress& progress)
{
  if (target.Grid == this->Geometry)
  {
    return;
  }
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  const PointSpan<D> positions = this->Positions();
  progress.For(positions.size(), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      double x[3];
      target.Grid.template ToPhysical<D>(positions[i], x);
      this->Geometry.template ToIndex<D>(x, positions[i]);
    }
  });
}

template <int D>
MapFigures MapField<D>::Write(const RectifiedFlow<D>& flow, FlowDirection direction,
  const DensitySource<D>& density, Progress& progress, vtkDataSetAttributes* output,
  const MapTarget<D>* target)
{
  if (this->Processes.AreSeveral())
  {
    this->Complete();
  }
  const std::int64_t count = this->Wanted.Count();
  auto divergences = newArray<vtkDoubleArray>("Divergence", 1, count);
  auto determinants = newArray<vtkDoubleArray>("JacobianDeterminant", 1, count);
  const Point<D> step = latticeStep<D>(this->Lattice, this->Geometry.template Size<D>());
  const RectifiedFlow<D>* begins = direction == FlowDirection::Backward ? &flow : nullptr;
  MapFigures figures;
  const bool hasOwn = this->Wanted.Contains(this->OwnPart);
  Stages stages(progress,
    { { "blocks", 20 }, { "target", target ? 8.0 : 0.0 }, { "own part", hasOwn ? 0.0 : 35.0 },
      { "samples", hasOwn ? 70.0 : 35.0 }, { "figures", target ? 8.0 : 0.0 } });
  const MapSamples<D> samples{ this->Lattice, this->OwnPart, this->Kept, this->Positions() };
  figures.Blocks = target
    ? measureBlocksBetween<D>(samples, { density, flow.Total() }, target->Density, stages["blocks"])
    : measureBlocks<D>(samples, density, flow.Total(), direction, stages["blocks"]);
  if (target)
  {
    this->TakeFrom(*target, stages["target"]);
  }
  const MapDerivatives<D> derivatives(
    this->Lattice, this->Wanted, this->Kept, step, this->Positions());
  const MapDisplacement<D> moves(
    this->Geometry, this->Lattice, this->Wanted, this->Kept, this->Positions(), begins);
  const MapFolds<D> folds(this->Lattice, begins);
  FoldCount folded;
  DisplacementSums sums;
  if (!hasOwn)
  {
    Progress& counting = stages["own part"];
    MapDisplacement<D>(
      this->Geometry, this->Lattice, this->OwnPart, this->Kept, this->Positions(), begins)
      .Count(sums, counting);
    folded = folds.Count(this->OwnPart, this->Kept, step, this->Positions(), counting);
  }
  this->WriteSamples(derivatives, moves, sums, stages["samples"], divergences->GetPointer(0),
    determinants->GetPointer(0));
  if (hasOwn)
  {
    folded =
      folds.Count(this->OwnPart, this->Wanted, determinants->GetPointer(0), stages["samples"]);
  }
  const DisplacementSums all = sumOverRanks(this->Processes, sums);
  figures.Cost = moves.MeanSquare(all);
  if (target)
  {
    auto costs = newArray<vtkDoubleArray>("CostDensity", 1, count);
    moves.WriteCosts(
      this->Displacement->GetPointer(0), all, costs->GetPointer(0), stages["figures"]);
    output->AddArray(costs);
  }
  output->SetVectors(std::exchange(this->Displacement, nullptr));
  output->AddArray(divergences);
  output->AddArray(determinants);
  folded = sumOverRanks(this->Processes, folded);
  figures.Folded = folded.Samples;
  if (folded.Samples > 0)
  {
    const std::int64_t withMass =
      sumOverRanks(this->Processes, folds.CountWithMass(this->OwnPart, stages["figures"]));
    figures.ShowsFolds = isWorthWarning(folded.Samples, withMass) ||
      isWorthWarning(folded.Area.Value(), numberOfCells<D>(this->Lattice));
  }
  return figures;
}

// Derivatives depend on the positions of the layers before and after.
template <int D>
void MapField<D>::WriteSamples(const MapDerivatives<D>& derivatives,
  const MapDisplacement<D>& moves, DisplacementSums& sums, Progress& progress, double* divergence,
  double* determinant)
{
  const std::int64_t count = this->Wanted.Count();
  const bool isInPlace = D == 3 && this->Processes.AreSeveral();
  const std::int64_t layers = isInPlace ? this->Wanted.Cells[D - 1] : 1;
  const std::int64_t each = count / std::max<std::int64_t>(1, layers);
  const LatticePart<D> counted =
    this->Wanted.Contains(this->OwnPart) ? this->OwnPart : LatticePart<D>{ {}, {} };
  const PointSpan<3> displacements(this->Displacement->GetPointer(0), count);
  constexpr std::int64_t grain = 4096;
  RectifiedTransport::Parts parts(progress, layers);
  for (std::int64_t layer = 0; layer < layers; ++layer)
  {
    Stages stages(parts[layer], { { "derivatives", 4 }, { "displacements", 6 } });
    stages["derivatives"].For(each, grain, [&](std::int64_t first, std::int64_t last) {
      derivatives.Write(layer * each + first, layer * each + last, divergence, determinant);
    });
    moves.Write(
      layer * each, (layer + 1) * each, counted, displacements, sums, stages["displacements"]);
  }
  this->Displacement->SetNumberOfTuples(static_cast<vtkIdType>(count));
}

template class MapField<1>;
template class MapField<2>;
template class MapField<3>;

} // namespace RectifiedTransport::Bridge

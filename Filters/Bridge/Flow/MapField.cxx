// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MapField.h"

#include "Bridge/Ranks/RankConsistency.h"
#include "Core/Geometry/Distributed/BoxExchange.h"

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
  , Stored(this->OwnPart)
{
  // A single rank computes, keeps and writes the whole lattice: all parts above are the same one.
  if (ranks.AreSeveral())
  {
    this->FindParts(samples, wanted, ranks);
  }
  constexpr double real = sizeof(double);
  // Positions take D doubles a kept sample and displacements 3 a wanted one, which in 3D share
  // memory; the scalars are Divergence, JacobianDeterminant and, with a target, CostDensity.
  const double stored = numberOfCells<D>(this->Stored.Cells) + static_cast<double>(this->Ahead);
  const double count = numberOfCells<D>(this->Wanted.Cells);
  const double vectors = D == 3 ? std::max(stored, count) : count;
  const double scratch = D == 3 ? 0.0 : real * D * stored;
  const double scalars = hasTarget ? 3.0 : 2.0;
  requireMemory({ purpose, real * (3.0 * vectors + scalars * count) + scratch });
  // The output gets this array itself in Write, so that displacements are not copied.
  this->Displacement = newArray<vtkDoubleArray>("Displacement", 3, static_cast<vtkIdType>(vectors));
  if (D != 3)
  {
    withMemory({ purpose, scratch },
      [&]() { this->PositionBuffer = LargeBuffer<double>(this->Stored.Count() * D); });
  }
}

// Divides the samples as VTK divides extents; points at common faces belong to the upper piece.
// Finite differences need the neighbours of wanted samples, so Stored surrounds them.
template <int D>
void MapField<D>::FindParts(const ImageGrid& samples, const TupleBox& wanted, const Ranks& ranks)
{
  // The lattice has only those axes along which the image has several points, in the image's order.
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
  // Every rank finds the parts of all: receivers know without messages who holds which sample. With
  // more ranks than layers, some parts are empty.
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
  // Central differences (paper, Section 4.2, Figure 6) at a sample need one sample on each side.
  // The error of a block needs all samples of the blocks that this rank owns, up to their upper
  // corners, which may belong to the next rank.
  this->Wanted = latticePartOf<D>(wanted, samples);
  this->Measured = this->OwnPart.Around(this->Lattice)
                     .With(MapBlocks<D>::SamplesOf(MapBlocks<D>::Of(this->Lattice, this->OwnPart)));
  this->Stored = this->Wanted.Around(this->Lattice).With(this->Measured);
  // Displacements are written layer by layer where positions of layers before were.
  const int last = D - 1;
  if (D == 3 && this->Wanted.Count() > 0 && this->Stored.Low[last] == this->Wanted.Low[last])
  {
    this->Ahead = this->Wanted.Count() / this->Wanted.Cells[last];
  }
}

template <int D>
TupleBox MapField<D>::BoxOf(const LatticePart<D>& part) const
{
  // Axes that the lattice lacks have one layer of tuples in the image, none if the part is empty.
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
  // Shape: (samples in Stored) x D doubles, axis 0 of the lattice fastest.
  double* first =
    D == 3 ? this->Displacement->GetPointer(3 * this->Ahead) : this->PositionBuffer.data();
  return { first, this->Stored.Count() };
}

// What derivatives at the border of the wanted samples depend on, and figures of this rank's.
template <int D>
void MapField<D>::Complete()
{
  const TupleMemory positions = TupleMemory::Of(this->Positions().data(), D);
  for (const LatticePart<D>& part : { this->Wanted.Around(this->Lattice), this->Measured })
  {
    completeBoxes(
      this->Held, this->BoxOf(part), this->BoxOf(this->Stored), this->Processes, positions);
  }
}

template <int D>
MapFigures MapField<D>::Write(const RectifiedFlow<D>& flow, FlowDirection direction,
  const DensitySource<D>& density, Progress& progress, vtkDataSetAttributes* output,
  const MapTarget<D>* target)
{
  // Every rank knows the images of its own part, and receives those around it before it
  // differentiates.
  if (this->Processes.AreSeveral())
  {
    this->Complete();
  }
  // A value for each wanted sample; a rank that wants none has arrays without tuples, so that all
  // ranks output the same arrays.
  const std::int64_t count = this->Wanted.Count();
  auto divergences = newArray<vtkDoubleArray>("Divergence", 1, count);
  auto determinants = newArray<vtkDoubleArray>("JacobianDeterminant", 1, count);
  auto costs = newArray<vtkDoubleArray>("CostDensity", 1, target ? count : 0);
  const MapFigures figures = writeMap<D>(
    { this->Geometry, this->Lattice, this->OwnPart, this->Wanted, this->Stored, this->Positions() },
    flow, direction, density, target,
    { this->Displacement->GetPointer(0), divergences->GetPointer(0), determinants->GetPointer(0),
      costs->GetPointer(0) },
    progress);
  if (target)
  {
    output->AddArray(costs);
  }
  // In 3D the array was made long enough for the positions, too: what is behind the displacements
  // is no output.
  this->Displacement->SetNumberOfTuples(static_cast<vtkIdType>(count));
  output->SetVectors(std::exchange(this->Displacement, nullptr));
  output->AddArray(divergences);
  output->AddArray(determinants);
  return figures;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(MapField);

} // namespace RectifiedTransport::Bridge

// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MapField.h"

#include "Bridge/Run/Memory.h"
#include "Core/Flow/MapDerivatives.h"
#include "Core/Flow/MapDisplacement.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"

#include <utility>

namespace RectifiedTransport
{

namespace
{

// Without a copy; of memory that outlives it.
vtkSmartPointer<vtkDoubleArray> arrayOn(double* values, int components, std::int64_t tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(components);
  array->SetArray(values, static_cast<vtkIdType>(tuples * components), 1);
  return array;
}

} // namespace

template <int D>
MapField<D>::MapField(const ImageGrid& geometry, const ImageGrid& samples,
  const std::string& purpose, const Ranks* ranks)
  : Geometry(geometry)
  , Processes(ranks)
  , Lattice(samples.Size<D>())
  , OwnPart(LatticePart<D>::WholeOf(this->Lattice))
{
  double count = numberOfCells<D>(this->Lattice);
  if (ranks)
  {
    this->FindParts(samples, *ranks);
    count = numberOfCells<D>(this->OwnPart.Cells);
  }
  constexpr double real = sizeof(double);
  const bool sharesMemory = D == 3 && !ranks;
  const double scratch = sharesMemory ? 0.0 : real * D * count;
  requireMemory(purpose, 5.0 * real * count + scratch);
  this->Around = this->OwnPart;
  this->NumberOfSamples = static_cast<std::int64_t>(count);
  if (!ranks)
  {
    this->Displacement = newArray<vtkDoubleArray>("Displacement", 3, this->NumberOfSamples);
  }
  if (!sharesMemory)
  {
    withMemory(purpose, scratch,
      [&]() { this->PositionBuffer = LargeBuffer<double>(this->NumberOfSamples * D); });
  }
}

// Pieces as VTK divides extents, of which points at common faces belong to the upper one.
template <int D>
void MapField<D>::FindParts(const ImageGrid& samples, const Ranks& ranks)
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
}

template <int D>
TupleBox MapField<D>::BoxOf(const LatticePart<D>& part) const
{
  TupleBox box{ this->Start, this->Start };
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.High[a] = this->Start[a] + (part.Count() > 0 ? 1 : 0);
  }
  for (int a = 0; a < D; ++a)
  {
    const auto along = static_cast<std::size_t>(this->Axes[static_cast<std::size_t>(a)]);
    box.Low[along] = this->Start[along] + static_cast<int>(part.Low[a]);
    box.High[along] = box.Low[along] + static_cast<int>(part.Cells[a]);
  }
  return box;
}

template <int D>
PointSpan<D> MapField<D>::Positions()
{
  double* own = this->PositionBuffer.data();
  return { own ? own : this->Displacement->GetPointer(0), this->Around.Count() };
}

// What derivatives at the part's border depend on.
template <int D>
void MapField<D>::FetchAround()
{
  const LatticePart<D> around = this->OwnPart.Around(this->Lattice);
  LargeBuffer<double> positions(around.Count() * D);
  const auto from = arrayOn(this->PositionBuffer.data(), D, this->OwnPart.Count());
  const auto to = arrayOn(positions.data(), D, around.Count());
  exchangeBoxes(this->Held, this->BoxOf(around), *this->Processes, from, to);
  this->PositionBuffer = std::move(positions);
  this->Around = around;
}

template <int D>
double MapField<D>::Write(const RectifiedFlow<D>* flow, const TupleBox& wanted, Progress& progress,
  double end, vtkDataSetAttributes* output)
{
  if (this->Processes)
  {
    this->FetchAround();
  }
  constexpr double partOfDerivatives = 0.4;
  progress.BeginStage(progress.StageEnd() + partOfDerivatives * (end - progress.StageEnd()));
  std::vector<vtkSmartPointer<vtkDoubleArray>> arrays = this->WriteDerivatives(progress);
  progress.BeginStage(end);
  if (!this->Displacement)
  {
    this->Displacement = newArray<vtkDoubleArray>("Displacement", 3, this->NumberOfSamples);
  }
  const PointSpan<3> displacements(this->Displacement->GetPointer(0), this->NumberOfSamples);
  const double cost = this->Processes
    ? writeDisplacements<D>(this->Geometry, this->Lattice, this->OwnPart, this->Positions(), flow,
        displacements, progress.Stage())
    : writeDisplacements<D>(
        this->Geometry, this->Lattice, this->Positions(), flow, displacements, progress.Stage());
  arrays.insert(arrays.begin(), std::exchange(this->Displacement, nullptr));
  if (this->Processes)
  {
    this->PositionBuffer = {};
    for (vtkSmartPointer<vtkDoubleArray>& array : arrays)
    {
      auto there =
        newArray<vtkDoubleArray>(array->GetName(), array->GetNumberOfComponents(), wanted.Count());
      exchangeBoxes(this->Held, wanted, *this->Processes, array, there);
      array = there;
    }
  }
  output->SetVectors(arrays[0]);
  output->AddArray(arrays[1]);
  output->AddArray(arrays[2]);
  return cost;
}

template <int D>
std::vector<vtkSmartPointer<vtkDoubleArray>> MapField<D>::WriteDerivatives(Progress& progress)
{
  auto divergences = newArray<vtkDoubleArray>("Divergence", 1, this->NumberOfSamples);
  auto determinants = newArray<vtkDoubleArray>("JacobianDeterminant", 1, this->NumberOfSamples);
  double* divergence = divergences->GetPointer(0);
  double* determinant = determinants->GetPointer(0);
  const MapDerivatives<D> derivatives(this->Lattice, this->OwnPart,
    latticeStep<D>(this->Lattice, this->Geometry.template Size<D>()), this->Positions());
  constexpr std::int64_t grain = 4096;
  progress.For(this->NumberOfSamples, grain, [&](std::int64_t first, std::int64_t last) {
    derivatives.Write(first, last, divergence, determinant);
  });
  return { divergences, determinants };
}

template class MapField<1>;
template class MapField<2>;
template class MapField<3>;

} // namespace RectifiedTransport

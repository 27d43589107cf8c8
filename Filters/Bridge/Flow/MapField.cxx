// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MapField.h"

#include "Bridge/Run/Memory.h"
#include "Core/Flow/MapDerivatives.h"
#include "Core/Flow/MapDisplacement.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"

namespace RectifiedTransport
{

template <int D>
MapField<D>::MapField(
  const ImageGrid& geometry, const GridSize<D>& lattice, const std::string& purpose)
  : Geometry(geometry)
  , Lattice(lattice)
{
  constexpr double real = sizeof(double);
  const double count = numberOfCells<D>(lattice);
  const double scratch = D == 3 ? 0.0 : real * D * count;
  requireMemory(purpose, 5.0 * real * count + scratch);
  this->NumberOfSamples = static_cast<std::int64_t>(count);
  this->Displacement = newArray<vtkDoubleArray>("Displacement", 3, this->NumberOfSamples);
  if constexpr (D != 3)
  {
    withMemory(purpose, scratch,
      [&]() { this->PositionBuffer = LargeBuffer<double>(this->NumberOfSamples * D); });
  }
}

template <int D>
PointSpan<D> MapField<D>::Positions()
{
  return { D == 3 ? this->Displacement->GetPointer(0) : this->PositionBuffer.data(),
    this->NumberOfSamples };
}

template <int D>
double MapField<D>::Write(
  const RectifiedFlow<D>* flow, Progress& progress, double end, vtkDataSetAttributes* output)
{
  constexpr double partOfDerivatives = 0.4;
  output->SetVectors(this->Displacement);
  progress.BeginStage(progress.StageEnd() + partOfDerivatives * (end - progress.StageEnd()));
  this->WriteDerivatives(progress, output);
  progress.BeginStage(end);
  return writeDisplacements<D>(this->Geometry, this->Lattice, this->Positions(), flow,
    { this->Displacement->GetPointer(0), this->NumberOfSamples }, progress.Stage());
}

template <int D>
void MapField<D>::WriteDerivatives(Progress& progress, vtkDataSetAttributes* output)
{
  auto divergences = newArray<vtkDoubleArray>("Divergence", 1, this->NumberOfSamples);
  auto determinants = newArray<vtkDoubleArray>("JacobianDeterminant", 1, this->NumberOfSamples);
  output->AddArray(divergences);
  output->AddArray(determinants);
  double* divergence = divergences->GetPointer(0);
  double* determinant = determinants->GetPointer(0);
  const MapDerivatives<D> derivatives(this->Lattice,
    latticeStep<D>(this->Lattice, this->Geometry.template Size<D>()), this->Positions());
  constexpr std::int64_t grain = 4096;
  progress.For(this->NumberOfSamples, grain, [&](std::int64_t first, std::int64_t last) {
    derivatives.Write(first, last, divergence, determinant);
  });
}

template class MapField<1>;
template class MapField<2>;
template class MapField<3>;

} // namespace RectifiedTransport

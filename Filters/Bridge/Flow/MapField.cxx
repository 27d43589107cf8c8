// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Flow/MapField.h"

#include "Bridge/Run/Memory.h"
#include "Core/Flow/LatticeOrder.h"
#include "Core/Flow/MapDerivatives.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Progress.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"

#include <algorithm>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t chunk = 4096;
constexpr double real = sizeof(double);

// The step from one sample to the next, in cells of the density.
template <int D>
Point<D> stepOf(const GridSize<D>& lattice, const GridSize<D>& size)
{
  Point<D> step;
  for (int a = 0; a < D; ++a)
  {
    step[a] = static_cast<double>(size[a]) / static_cast<double>(lattice[a]);
  }
  return step;
}

} // namespace

template <int D>
MapField<D>::MapField(
  const ImageGrid& geometry, const GridSize<D>& lattice, const std::string& purpose)
  : Geometry(geometry)
  , Lattice(lattice)
  , Size(geometry.Size<D>())
{
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
  return this->WriteDisplacement(flow, progress);
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
  const MapDerivatives<D> derivatives(
    this->Lattice, stepOf<D>(this->Lattice, this->Size), this->Positions());
  progress.For(this->NumberOfSamples, chunk, [&](std::int64_t first, std::int64_t last) {
    derivatives.Write(first, last, divergence, determinant);
  });
}

// Sums over fixed chunks, so that the mean does not depend on the executor.
template <int D>
double MapField<D>::WriteDisplacement(const RectifiedFlow<D>* flow, Progress& progress)
{
  struct Sums
  {
    double Cost = 0.0;
    double Weight = 0.0;
  };
  const std::int64_t count = this->NumberOfSamples;
  const Point<D> step = stepOf<D>(this->Lattice, this->Size);
  const LengthScale scale(this->Geometry);
  double* displacement = this->Displacement->GetPointer(0);
  const double* positions = this->Positions().data();
  const auto write = [&](std::int64_t i, Sums& sums) {
    double moved[D];
    Point<D> low;
    Point<D> high;
    std::int64_t rest = i;
    for (int a = 0; a < D; ++a)
    {
      const std::int64_t cell = rest % this->Lattice[a];
      rest /= this->Lattice[a];
      moved[a] = positions[i * D + a] - latticeCentre(cell, this->Lattice[a], this->Size[a]);
      low[a] = static_cast<double>(cell) * step[a];
      high[a] = static_cast<double>(cell + 1) * step[a];
    }
    double* d = displacement + 3 * i; // in 3D the same memory as the position
    this->Geometry.template VectorToPhysical<D>(moved, d);
    const double weight = flow ? flow->Share(low, high) : 1.0;
    sums.Cost += weight * scale.SquareInUnits(d);
    sums.Weight += weight;
  };
  std::vector<Sums> parts(static_cast<std::size_t>((count + chunk - 1) / chunk));
  progress.For(count, chunk, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t begin = first; begin < last; begin += chunk)
    {
      Sums& sums = parts[static_cast<std::size_t>(begin / chunk)];
      for (std::int64_t i = begin; i < std::min(begin + chunk, last); ++i)
      {
        write(i, sums);
      }
    }
  });
  Sums all;
  for (const Sums& part : parts)
  {
    all.Cost += part.Cost;
    all.Weight += part.Weight;
  }
  return scale.CostFromUnits(all.Cost / all.Weight);
}

template class MapField<1>;
template class MapField<2>;
template class MapField<3>;

} // namespace RectifiedTransport

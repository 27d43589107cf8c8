// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/MapDisplacement.h"

#include "Core/Flow/LatticeOrder.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/CountText.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Reduction.h"

#include <functional>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

struct WeightedCost
{
  double Cost = 0.0;
  double Weight = 0.0;
};

WeightedCost operator+(const WeightedCost& a, const WeightedCost& b)
{
  return { a.Cost + b.Cost, a.Weight + b.Weight };
}

template <int Dimension>
class DisplacementRun
{
public:
  DisplacementRun(const ImageGrid& grid, const GridSize<Dimension>& lattice,
    ConstPointSpan<Dimension> positions, const RectifiedFlow<Dimension>* density,
    PointSpan<3> displacements)
    : Grid(grid)
    , Scale(grid)
    , Lattice(lattice)
    , Size(grid.Size<Dimension>())
    , Step(latticeStep<Dimension>(lattice, this->Size))
    , Positions(positions)
    , Density(density)
    , Displacements(displacements)
  {
  }

  double Run(Progress& progress) const
  {
    constexpr std::int64_t chunk = 4096;
    const WeightedCost all = reduceChunks(
      progress, this->Positions.size(), chunk, WeightedCost{},
      [this](std::int64_t first, std::int64_t last) {
        WeightedCost sums;
        for (std::int64_t i = first; i < last; ++i)
        {
          this->Write(i, sums);
        }
        return sums;
      },
      std::plus<>());
    return this->Scale.CostFromUnits(all.Cost / all.Weight);
  }

private:
  void Write(std::int64_t i, WeightedCost& sums) const
  {
    double moved[Dimension];
    Point<Dimension> low;
    Point<Dimension> high;
    std::int64_t rest = i;
    for (int a = 0; a < Dimension; ++a)
    {
      const std::int64_t cell = rest % this->Lattice[a];
      rest /= this->Lattice[a];
      moved[a] = this->Positions[i][a] - latticeCentre(cell, this->Lattice[a], this->Size[a]);
      low[a] = static_cast<double>(cell) * this->Step[a];
      high[a] = static_cast<double>(cell + 1) * this->Step[a];
    }
    double* displacement = this->Displacements[i]; // may be where the position was
    this->Grid.template VectorToPhysical<Dimension>(moved, displacement);
    const double weight = this->Density ? this->Density->Share(low, high) : 1.0;
    sums.Cost += weight * this->Scale.SquareInUnits(displacement);
    sums.Weight += weight;
  }

  const ImageGrid& Grid;
  const LengthScale Scale;
  const GridSize<Dimension> Lattice;
  const GridSize<Dimension> Size;
  const Point<Dimension> Step;
  const ConstPointSpan<Dimension> Positions;
  const RectifiedFlow<Dimension>* const Density;
  const PointSpan<3> Displacements;
};

} // namespace

template <int Dimension>
double writeDisplacements(const ImageGrid& grid, const GridSize<Dimension>& lattice,
  ConstPointSpan<Dimension> positions, const RectifiedFlow<Dimension>* density,
  PointSpan<3> displacements, const Context& context)
{
  const double samples = numberOfCells<Dimension>(lattice);
  for (const std::int64_t count : { positions.size(), displacements.size() })
  {
    if (static_cast<double>(count) != samples)
    {
      throw std::invalid_argument("there are " + std::to_string(count) +
        " positions or displacements, there must be " + describeCount(samples));
    }
  }
  Progress progress(context);
  progress.BeginStage(1.0);
  return DisplacementRun<Dimension>(grid, lattice, positions, density, displacements).Run(progress);
}

template double writeDisplacements<1>(const ImageGrid&, const GridSize<1>&, ConstPointSpan<1>,
  const RectifiedFlow<1>*, PointSpan<3>, const Context&);
template double writeDisplacements<2>(const ImageGrid&, const GridSize<2>&, ConstPointSpan<2>,
  const RectifiedFlow<2>*, PointSpan<3>, const Context&);
template double writeDisplacements<3>(const ImageGrid&, const GridSize<3>&, ConstPointSpan<3>,
  const RectifiedFlow<3>*, PointSpan<3>, const Context&);

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/MapDisplacement.h"

#include "Core/Flow/LatticeOrder.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/CountText.h"
#include "Core/Geometry/LengthScale.h"
#include "Core/Parallel/ExactSum.h"
#include "Core/Parallel/Progress.h"
#include "Core/Parallel/Ranks.h"

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

struct WeightedCost
{
  ExactSum Cost{};
  ExactSum Weight{};

  void Add(const WeightedCost& other)
  {
    this->Cost.Add(other.Cost);
    this->Weight.Add(other.Weight);
  }
};

void checkCount(std::int64_t count, double expected)
{
  if (static_cast<double>(count) != expected)
  {
    throw std::invalid_argument("there are " + std::to_string(count) +
      " positions or displacements, there must be " + describeCount(expected));
  }
}

template <int Dimension>
class DisplacementRun
{
public:
  // `around` is the part of the positions.
  DisplacementRun(const ImageGrid& grid, const GridSize<Dimension>& lattice,
    const LatticePart<Dimension>& part, const LatticePart<Dimension>& around,
    ConstPointSpan<Dimension> positions, const RectifiedFlow<Dimension>* density,
    PointSpan<3> displacements)
    : Grid(grid)
    , Scale(grid)
    , Lattice(lattice)
    , Part(part)
    , Around(around)
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
    const auto all = sumExactly<WeightedCost>(progress, this->Part.Count(), chunk,
      [this](std::int64_t first, std::int64_t last, WeightedCost& sums) {
        for (std::int64_t i = first; i < last; ++i)
        {
          this->Write(i, sums);
        }
      });
    const WeightedCost sums = sumOverRanks(progress.Group(), all);
    return this->Scale.CostFromUnits(sums.Cost.Value() / sums.Weight.Value());
  }

private:
  void Write(std::int64_t i, WeightedCost& sums) const
  {
    double moved[Dimension];
    Point<Dimension> low;
    Point<Dimension> high;
    const GridSize<Dimension> cell = this->Part.CellOf(i);
    const double* position = this->Positions[this->Around.NumberOf(cell)];
    for (int a = 0; a < Dimension; ++a)
    {
      moved[a] = position[a] - latticeCentre(cell[a], this->Lattice[a], this->Size[a]);
      low[a] = static_cast<double>(cell[a]) * this->Step[a];
      high[a] = static_cast<double>(cell[a] + 1) * this->Step[a];
    }
    double* displacement = this->Displacements[i]; // may be where the position was
    this->Grid.template VectorToPhysical<Dimension>(moved, displacement);
    const double weight = this->Density ? this->Density->Share(low, high) : 1.0;
    sums.Cost.Add(weight * this->Scale.SquareInUnits(displacement));
    sums.Weight.Add(weight);
  }

  const ImageGrid& Grid;
  const LengthScale Scale;
  const GridSize<Dimension> Lattice;
  const LatticePart<Dimension> Part;
  const LatticePart<Dimension> Around;
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
  checkCount(positions.size(), samples);
  checkCount(displacements.size(), samples);
  Progress progress(context);
  progress.BeginStage(1.0);
  const auto whole = LatticePart<Dimension>::WholeOf(lattice);
  return DisplacementRun<Dimension>(grid, lattice, whole, whole, positions, density, displacements)
    .Run(progress);
}

template <int Dimension>
double writeDisplacements(const ImageGrid& grid, const GridSize<Dimension>& lattice,
  const LatticePart<Dimension>& part, ConstPointSpan<Dimension> positions,
  const RectifiedFlow<Dimension>* density, PointSpan<3> displacements, const Context& context)
{
  const LatticePart<Dimension> around = part.Around(lattice);
  checkCount(positions.size(), static_cast<double>(around.Count()));
  checkCount(displacements.size(), static_cast<double>(part.Count()));
  Progress progress(context);
  progress.BeginStage(1.0);
  return DisplacementRun<Dimension>(grid, lattice, part, around, positions, density, displacements)
    .Run(progress);
}

template double writeDisplacements<1>(const ImageGrid&, const GridSize<1>&, ConstPointSpan<1>,
  const RectifiedFlow<1>*, PointSpan<3>, const Context&);
template double writeDisplacements<1>(const ImageGrid&, const GridSize<1>&, const LatticePart<1>&,
  ConstPointSpan<1>, const RectifiedFlow<1>*, PointSpan<3>, const Context&);
template double writeDisplacements<2>(const ImageGrid&, const GridSize<2>&, ConstPointSpan<2>,
  const RectifiedFlow<2>*, PointSpan<3>, const Context&);
template double writeDisplacements<2>(const ImageGrid&, const GridSize<2>&, const LatticePart<2>&,
  ConstPointSpan<2>, const RectifiedFlow<2>*, PointSpan<3>, const Context&);
template double writeDisplacements<3>(const ImageGrid&, const GridSize<3>&, ConstPointSpan<3>,
  const RectifiedFlow<3>*, PointSpan<3>, const Context&);
template double writeDisplacements<3>(const ImageGrid&, const GridSize<3>&, const LatticePart<3>&,
  ConstPointSpan<3>, const RectifiedFlow<3>*, PointSpan<3>, const Context&);

} // namespace RectifiedTransport

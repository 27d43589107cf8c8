// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Flow/MapDisplacement.h"

#include "Core/Flow/Particles/LatticeOrder.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Messages/PartText.h"

#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

namespace
{

// Cells a chunk of parallel loops.
constexpr std::int64_t chunk = 4096;

void requireCount(std::int64_t count, double expected)
{
  if (static_cast<double>(count) != expected)
  {
    throw std::invalid_argument("there are " + std::to_string(count) +
      " positions or displacements, there must be " + describeCount(expected));
  }
}

} // namespace

// One displacement for each cell of `part` of the lattice; `within` is the part whose positions are
// given.
template <int Dimension>
MapDisplacement<Dimension>::MapDisplacement(const ImageGrid& grid,
  const GridSize<Dimension>& lattice, const LatticePart<Dimension>& part,
  const LatticePart<Dimension>& within, ConstPointSpan<Dimension> positions,
  const RectifiedFlow<Dimension>* density)
  : Grid(grid)
  , Scale(grid)
  , Lattice(lattice)
  , Part(part)
  , Within(within)
  , Size(grid.Size<Dimension>())
  , Step(latticeStep<Dimension>(lattice, this->Size))
  , Positions(positions)
  , Density(density)
{
  requireCount(positions.size(), numberOfCells<Dimension>(within.Cells));
}

// The displacements of cells [first, last) of the part, and the sums of those that are `counted`:
// overlapping parts of several ranks count each cell once.
template <int Dimension>
void MapDisplacement<Dimension>::Write(std::int64_t first, std::int64_t last,
  const LatticePart<Dimension>& counted, PointSpan<3> displacements, DisplacementSums& sums,
  Progress& progress) const
{
  requireCount(displacements.size(), numberOfCells<Dimension>(this->Part.Cells));
  sums.Add(this->Sum(first, last, counted, displacements.data(), progress));
}

template <int Dimension>
void MapDisplacement<Dimension>::Count(DisplacementSums& sums, Progress& progress) const
{
  sums.Add(this->Sum(0, this->Part.Count(), this->Part, nullptr, progress));
}

// sum w |d|^2 and sum w over the part's cells [first, last), in exact sums, so that the bits do not
// depend on threads or ranks. Writes the displacements d unless the pointer is null.
template <int Dimension>
DisplacementSums MapDisplacement<Dimension>::Sum(std::int64_t first, std::int64_t last,
  const LatticePart<Dimension>& counted, double* displacements, Progress& progress) const
{
  return sumExactly<DisplacementSums>(
    progress, last - first, chunk, [&](std::int64_t b, std::int64_t e, DisplacementSums& found) {
      for (std::int64_t i = first + b; i < first + e; ++i)
      {
        // Without an output the displacement is local.
        double local[3];
        double* displacement = displacements ? displacements + 3 * i : local;
        const GridSize<Dimension> cell = this->Part.CellOf(i);
        this->Displace(cell, displacement);
        if (counted.Contains(cell))
        {
          const double weight = this->WeightOf(cell);
          found.Cost.Add(weight * this->Scale.SquareInUnits(displacement));
          found.Weight.Add(weight);
        }
      }
    });
}

// A cell's share of the mean squared displacement, w |d|^2 / sum w.
template <int Dimension>
void MapDisplacement<Dimension>::WriteCosts(const double* displacements,
  const DisplacementSums& sums, double* costs, Progress& progress) const
{
  const double all = sums.Weight.Value();
  progress.ForEach(this->Part.Count(), chunk, [&](std::int64_t i) {
    // Shares of all counted cells sum to 1, and costs to the mean square.
    const double share = this->WeightOf(this->Part.CellOf(i)) / all;
    const double square = this->Scale.SquareInUnits(displacements + 3 * i);
    costs[i] = this->Scale.SquareFromUnits(share * square);
  });
}

// The transport cost sum w |d|^2 / sum w, in squared physical lengths.
template <int Dimension>
double MapDisplacement<Dimension>::MeanSquare(const DisplacementSums& sums) const
{
  // Squares are summed in units that do not overflow.
  return this->Scale.CostFromUnits(sums.Cost.Value() / sums.Weight.Value());
}

// d = position - centre of the cell, as a physical vector. It may overwrite the position.
template <int Dimension>
void MapDisplacement<Dimension>::Displace(
  const GridSize<Dimension>& cell, double* displacement) const
{
  // In index space first, where the lattice's points are known exactly.
  double moved[Dimension];
  const double* position = this->Positions[this->Within.NumberOf(cell)];
  for (int a = 0; a < Dimension; ++a)
  {
    moved[a] = position[a] - latticePoint(cell[a], 0.5, this->Lattice[a], this->Size[a]);
  }
  this->Grid.template VectorToPhysical<Dimension>(moved, displacement);
}

// The mass of a cell under the density, or 1 for the uniform measure.
template <int Dimension>
double MapDisplacement<Dimension>::WeightOf(const GridSize<Dimension>& cell) const
{
  if (!this->Density)
  {
    return 1.0;
  }
  Point<Dimension> low;
  Point<Dimension> high;
  for (int a = 0; a < Dimension; ++a)
  {
    // The lattice's cell in the density's index space.
    low[a] = static_cast<double>(cell[a]) * this->Step[a];
    high[a] = static_cast<double>(cell[a] + 1) * this->Step[a];
  }
  return this->Density->Share(low, high);
}

template <int Dimension>
double writeDisplacements(const ImageGrid& grid, const GridSize<Dimension>& lattice,
  ConstPointSpan<Dimension> positions, const RectifiedFlow<Dimension>* density,
  PointSpan<3> displacements, const Context& context)
{
  const auto whole = LatticePart<Dimension>::WholeOf(lattice);
  const MapDisplacement<Dimension> run(grid, lattice, whole, whole, positions, density);
  Progress progress(context);
  DisplacementSums sums;
  run.Write(0, whole.Count(), whole, displacements, sums, progress);
  return run.MeanSquare(sums);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(MapDisplacement);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(writeDisplacements);

} // namespace RectifiedTransport

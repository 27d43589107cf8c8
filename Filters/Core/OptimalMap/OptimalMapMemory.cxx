// SPDX-License-Identifier: BSD-3-Clause
// How much memory an optimal map takes.
#include "Core/Grid/NodeLevels.h"
#include "Core/OptimalMap/CouplingCost.h"
#include "Core/OptimalMap/FixedCells.h"
#include "Core/OptimalMap/Masses/MassCorrection.h"
#include "Core/OptimalMap/Masses/SampleCorrection.h"
#include "Core/OptimalMap/OptimalMap.h"
#include "Core/OptimalMap/PotentialSolver.h"

#include <algorithm>
#include <vector>

namespace RectifiedTransport
{

// The most of three moments counts: solving, making a map, and using it.
template <int Dimension>
double OptimalMap<Dimension>::MemoryFor(const GridSize<Dimension>& source,
  const GridSize<Dimension>& target, const OptimalMapOptions& options, const OptimalMapUse& use)
{
  constexpr double real = sizeof(double);
  // Eight threads stand for any number: their arrays of sums are limited anyway (mostArraysOfSums).
  constexpr int threads = 8;
  std::vector<Point<Dimension>> cellSides;
  for (const GridSize<Dimension>& size : { source, target })
  {
    Point<Dimension> sides;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      sides[axis] = 1.0 / static_cast<double>(size[axis]);
    }
    cellSides.push_back(sides);
  }
  const NodeGrid<Dimension> grid{ finestNodeCells<Dimension>(cellSides, options.MostNodes) };
  const double nodes = numberOfCorners<Dimension>(grid.Cells);
  const double densities =
    real * (numberOfCells<Dimension>(source) + numberOfCells<Dimension>(target));
  const double potentials = nodes * real * 6.0; // with hats and cells
  const double refined = options.RefineBound
    ? PotentialSolver<Dimension>::MemoryForRefined(grid.Cells, options.MostNodes)
    : 0.0;
  const double solving =
    std::max(nodes * PotentialSolver<Dimension>::BytesANode(threads), potentials + refined);
  // A map: two gradient maps and minimizers, and what samples and its correction take.
  const double gradients = nodes * real * (2.0 * Dimension + 1.0);
  const double correcting = FixedCells<Dimension>::MemoryFor(grid.Cells) +
    nodes * real * 2.0 * (Dimension + 1.0) + MassCorrection<Dimension>::MemoryFor(target, 1);
  const double kept = FixedCells<Dimension>::MemoryKept(target) + gradients +
    MassCorrection<Dimension>::MemoryKept(target, 1);
  const double coupling =
    use.UpperBound ? nodes * real * Dimension + memoryForCoupling<Dimension>(target, grid) : 0.0;
  const double after = kept + std::max(MemoryForSamples(target, use), coupling);
  // Work on lines of nodes holds some, on a line for each thread that has one.
  constexpr double ofLine = 400.0; // bytes a node of a line
  const double lines = ofLine * (Dimension == 1 ? 1 : threads) *
    static_cast<double>(*std::max_element(grid.Cells.begin(), grid.Cells.end()));
  return densities + lines +
    std::max(solving, potentials + std::max(gradients + correcting, after));
}

template <int Dimension>
double OptimalMap<Dimension>::MemoryForSamples(
  const GridSize<Dimension>& target, const OptimalMapUse& use)
{
  // The samples' starts, which are kept where some stand still.
  constexpr double starts = Dimension * sizeof(double);
  return use.Samples > 0.0
    ? starts * use.Samples + memoryForCorrection<Dimension>(target, use.Samples, use.OnSeveralRanks)
    : 0.0;
}

template double OptimalMap<1>::MemoryFor(
  const GridSize<1>&, const GridSize<1>&, const OptimalMapOptions&, const OptimalMapUse&);
template double OptimalMap<1>::MemoryForSamples(const GridSize<1>&, const OptimalMapUse&);
template double OptimalMap<2>::MemoryFor(
  const GridSize<2>&, const GridSize<2>&, const OptimalMapOptions&, const OptimalMapUse&);
template double OptimalMap<2>::MemoryForSamples(const GridSize<2>&, const OptimalMapUse&);
template double OptimalMap<3>::MemoryFor(
  const GridSize<3>&, const GridSize<3>&, const OptimalMapOptions&, const OptimalMapUse&);
template double OptimalMap<3>::MemoryForSamples(const GridSize<3>&, const OptimalMapUse&);

} // namespace RectifiedTransport

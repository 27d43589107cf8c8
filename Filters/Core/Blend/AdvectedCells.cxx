// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Blend/AdvectedCells.h"

#include "Core/Blend/BlendSplat.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"

#include <functional>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t cellGrain = std::int64_t{ 1 } << 12;

// The centres of the own cells with mass, after their motion.
struct AdvectedCentres
{
  LargeBuffer<double> Places;
  std::vector<double> Masses;
  std::vector<std::int64_t> Numbers; // cell numbers in the grid
};

// Returns for each own cell the sum over the particles in it of their displacement along an axis of
// index space, or for axis D their number. The sums are splats, so that they have the same bits for
// every number of threads and ranks.
template <int D>
LargeBuffer<double> sumMoves(const AdvectedCells<D>& cells, int axis, Progress& progress)
{
  const std::int64_t count = cells.From.size();
  // The displacement of each particle along the axis, in cells.
  LargeBuffer<double> terms(axis < D ? count : 0);
  if (axis < D)
  {
    progress.Threads().For(count, cellGrain, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        double before[D];
        double after[D];
        cells.Grid.template ToIndex<D>(cells.From[i], before);
        cells.Grid.template ToIndex<D>(cells.To[i], after);
        terms.data()[i] = after[axis] - before[axis];
      }
    });
  }
  LargeBuffer<double> sums(cells.Own.Count());
  splatInCells<D>(cells.From, axis < D ? terms.data() : nullptr, nullptr, cells.Grid, cells.Own,
    1.0, sums.data(), progress);
  return sums;
}

// Moves the centre of each cell with mass by the mean displacement (sum of displacements) /
// (number of particles), clamped to the domain.
template <int D>
AdvectedCentres moveCentres(
  const AdvectedCells<D>& cells, const std::vector<LargeBuffer<double>>& moves, Progress& progress)
{
  // Only cells with mass move.
  std::vector<std::int64_t> own;
  for (std::int64_t i = 0; i < cells.Own.Count(); ++i)
  {
    if (cells.Density[i] > 0.0)
    {
      own.push_back(i);
    }
  }
  const auto count = static_cast<std::int64_t>(own.size());
  AdvectedCentres moved;
  moved.Places = LargeBuffer<double>(3 * count);
  moved.Masses.resize(own.size());
  moved.Numbers.resize(own.size());
  const auto all = LatticePart<D>::WholeOf(cells.Grid.template Size<D>());
  const double measure = cells.Grid.CellMeasure();
  progress.Threads().For(count, cellGrain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      const auto n = static_cast<std::size_t>(i);
      const GridSize<D> cell = cells.Own.CellOf(own[n]);
      // The number of particles in the cell, by the splat's weights.
      const double particles = moves[D].data()[own[n]];
      double index[D];
      for (int axis = 0; axis < D; ++axis)
      {
        const double sum = moves[static_cast<std::size_t>(axis)].data()[own[n]];
        index[axis] =
          static_cast<double>(cell[axis]) + 0.5 + (particles > 0.0 ? sum / particles : 0.0);
      }
      cells.Grid.template ClampToDomain<D>(index);
      cells.Grid.template ToPhysical<D>(index, moved.Places.data() + 3 * i);
      moved.Masses[n] = cells.Density[own[n]] * measure;
      moved.Numbers[n] = all.NumberOf(cell);
    }
  });
  progress.Check();
  return moved;
}

} // namespace

template <int D>
void addAdvected(
  const AdvectedCells<D>& cells, const LatticePart<D>& wanted, Progress& progress, double* density)
{
  Stages stages(progress, { { "moves", 7 }, { "splat", 2 } });
  std::vector<LargeBuffer<double>> moves;
  Parts axes(stages["moves"], D + 1);
  for (int axis = 0; axis <= D; ++axis)
  {
    moves.push_back(sumMoves(cells, axis, axes[axis]));
  }
  const AdvectedCentres centres = moveCentres(cells, moves, stages["splat"]);
  const auto count = static_cast<std::int64_t>(centres.Masses.size());
  LargeBuffer<double> moved(wanted.Count());
  // Each cell's mass is splatted at its new centre, in the order of the cells' numbers.
  splatInCells<D>({ centres.Places.data(), count }, centres.Masses.data(), centres.Numbers.data(),
    cells.Grid, wanted, 1.0 / cells.Grid.CellMeasure(), moved.data(), stages["splat"]);
  std::transform(moved.data(), moved.data() + wanted.Count(), density, density, std::plus<>());
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(addAdvected);

} // namespace RectifiedTransport

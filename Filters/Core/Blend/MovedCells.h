// SPDX-License-Identifier: BSD-3-Clause
// The cells of a density that move with particles.
#ifndef RectifiedTransport_MovedCells_h
#define RectifiedTransport_MovedCells_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/RankShare.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

class Progress;

// A part of the cells for each rank; no cell is in two of them.
template <int D>
LatticePart<D> partOfRank(LatticePart<D> cells, const Ranks& ranks)
{
  const auto longest = std::max_element(cells.Cells.begin(), cells.Cells.end());
  const auto axis = static_cast<std::size_t>(longest - cells.Cells.begin());
  const RankShare share(cells.Cells[axis], ranks);
  cells.Low[axis] += share.First;
  cells.Cells[axis] = share.Count;
  return cells;
}

// Cells of a grid with a density, and this rank's particles: where they are in that density, and
// where they are now, physical.
template <int D>
struct MovedCells
{
  const ImageGrid& Grid;
  LatticePart<D> Own;    // each cell is of one rank
  const double* Density; // one value per own cell
  ConstPointSpan<3> From;
  ConstPointSpan<3> To;
};

// Adds the density of the cells, each moved by the mean move of the particles in it; cells without
// particles stay. `density` is that of the cells of a part, which each rank wants. The same bits
// for every number of threads and ranks. Memory: about 8 (6 + D) bytes a cell and 8 a particle.
// Collective. Throws std::bad_alloc and Cancelled.
template <int D>
void addMovedCells(
  const MovedCells<D>& cells, const LatticePart<D>& wanted, Progress& progress, double* density);

} // namespace RectifiedTransport

#endif

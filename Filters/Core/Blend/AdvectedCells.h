// SPDX-License-Identifier: BSD-3-Clause
// The cells of a density that move with particles.
#ifndef RectifiedTransport_AdvectedCells_h
#define RectifiedTransport_AdvectedCells_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/RankShare.h"

#include <algorithm>
#include <cstddef>

namespace RectifiedTransport
{

class Progress;

// Divides cells into a part for each rank, without overlap, along their longest axis.
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

// Cells of a grid with a density, and this rank's particles: their physical places in that density
// and at present.
template <int D>
struct AdvectedCells
{
  const ImageGrid& Grid;
  LatticePart<D> Own;    // each cell belongs to one rank
  const double* Density; // one value per own cell
  ConstPointSpan<3> From;
  ConstPointSpan<3> To;
};

// Adds the density of the cells, each moved by the mean displacement of the particles in it; cells
// without particles stay. `density` has the cells of the part that each rank wants. The bits are
// the same for every number of threads and ranks. Memory: about 8 (6 + D) bytes a cell and 8 a
// particle. Collective. Throws std::bad_alloc and Cancelled.
template <int D>
void addAdvected(
  const AdvectedCells<D>& cells, const LatticePart<D>& wanted, Progress& progress, double* density);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Particles of the pivot, the uniform measure that is transported to each density (paper, Section
// 3.4): equally many in each cell of a grid.
#ifndef RectifiedTransport_PivotLattice_h
#define RectifiedTransport_PivotLattice_h

#include "Core/Tables/Density.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// One particle at each place, in [0, 1], in each cell of a lattice. They are numbered place by
// place, within one over the cells with axis 0 fastest.
template <int Dimension>
struct PivotLattice
{
  GridSize<Dimension> Lattice;
  std::vector<Point<Dimension>> Places;
};

// `perCell` particles, at least 1, in each cell of a grid. Where that is a Dimension-th power they
// are the centres of a finer grid, else the same points of low discrepancy in all cells, with their
// mean at the centre.
template <int Dimension>
PivotLattice<Dimension> pivotLattice(const GridSize<Dimension>& grid, std::int64_t perCell);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The particles of the pivot, the uniform measure that is transported to each density (paper,
// Section 3.4): equally many in each cell of a grid.
#ifndef RectifiedTransport_PivotLattice_h
#define RectifiedTransport_PivotLattice_h

#include "../Geometry/GridSize.h"
#include "../Geometry/Points.h"
#include "../Parallel/Context.h"
#include "FlowOptions.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace RectifiedTransport
{

template <int Dimension>
class RectifiedFlow;

// One particle at each place, in [0, 1], in each cell of a lattice. They are numbered place by
// place; for one place over the cells, axis 0 fastest.
template <int Dimension>
struct PivotLattice
{
  GridSize<Dimension> Lattice;
  std::vector<Point<Dimension>> Places;

  std::int64_t NumberOfParticles() const
  {
    return static_cast<std::int64_t>(numberOfCells<Dimension>(this->Lattice)) *
      static_cast<std::int64_t>(this->Places.size());
  }
};

// `perCell` particles, at least 1, in each cell of a grid. If that is a Dimension-th power, they
// are the centres of a finer grid, else the same low-discrepancy points in all cells, with their
// mean at the centre.
template <int Dimension>
PivotLattice<Dimension> pivotLattice(const GridSize<Dimension>& grid, std::int64_t perCell);

// Advects particles of the pivot, on the box of a density, to the density: those from number
// `first` on, as many as there are positions, with the results of a run of all; the positions are
// in the order of the particles. Collective, each rank for its own. Throws std::invalid_argument,
// std::bad_alloc and Cancelled.
template <int Dimension>
FlowReport transportPivot(const RectifiedFlow<Dimension>& flow,
  const PivotLattice<Dimension>& pivot, std::int64_t first, PointSpan<Dimension> positions,
  const FlowOptions& options = {}, const Context& context = Context());
// All of them.
template <int Dimension>
FlowReport transportPivot(const RectifiedFlow<Dimension>& flow,
  const PivotLattice<Dimension>& pivot, PointSpan<Dimension> positions,
  const FlowOptions& options = {}, const Context& context = Context())
{
  const std::int64_t particles = pivot.NumberOfParticles();
  if (positions.size() != particles)
  {
    throw std::invalid_argument("there is memory for " + std::to_string(positions.size()) +
      " positions, but the pivot has " + std::to_string(particles) + " particles");
  }
  return transportPivot(flow, pivot, 0, positions, options, context);
}

} // namespace RectifiedTransport

#endif

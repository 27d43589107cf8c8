// SPDX-License-Identifier: BSD-3-Clause
// The displacements of a transport map at the cell centres of a lattice, in physical space, and
// the transport's cost (paper, Section 4.2, Figure 6).
#ifndef RectifiedTransport_MapDisplacement_h
#define RectifiedTransport_MapDisplacement_h

#include "Core/Geometry/ImageGrid.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Context.h"

namespace RectifiedTransport
{

template <int Dimension>
class RectifiedFlow;

// Writes image minus centre of each cell of a lattice on the domain of `grid`; `positions` are the
// images in index space, axis 0 fastest. In 3D positions and displacements may share memory.
// Returns the mean squared displacement of the cells, in squared physical units: of those of equal
// measure at time 0, and for a map backwards, which begins at the density, weighted with the share
// of the mass of `density` that is in each. Throws std::overflow_error where that is past the
// largest double, std::bad_alloc and Cancelled.
template <int Dimension>
double writeDisplacements(const ImageGrid& grid, const GridSize<Dimension>& lattice,
  ConstPointSpan<Dimension> positions, const RectifiedFlow<Dimension>* density,
  PointSpan<3> displacements, const Context& context = Context());
// The same of a part of the lattice: `positions` are those of the part with the cells around it,
// and not in the memory of the displacements. The mean is that over the parts of all ranks of the
// context, which call this together with parts that do not overlap.
template <int Dimension>
double writeDisplacements(const ImageGrid& grid, const GridSize<Dimension>& lattice,
  const LatticePart<Dimension>& part, ConstPointSpan<Dimension> positions,
  const RectifiedFlow<Dimension>* density, PointSpan<3> displacements,
  const Context& context = Context());

} // namespace RectifiedTransport

#endif

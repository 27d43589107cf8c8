// SPDX-License-Identifier: BSD-3-Clause
// First derivatives of a transport map at the cell centres of a lattice (paper, Section 4.2, Figure
// 6): central differences, one-sided at the border.
#ifndef RectifiedTransport_MapDerivatives_h
#define RectifiedTransport_MapDerivatives_h

#include "../Geometry/GridSize.h"
#include "../Geometry/LatticePart.h"

#include <cstdint>

namespace RectifiedTransport
{

// The trace of the displacement's gradient and the determinant of the map's Jacobian matrix do not
// change under an affine change of the coordinates of both points and values: those of index space
// hold for every spacing and direction. Along an axis of one cell, the displacement is taken as
// constant.
template <int Dimension>
class MapDerivatives
{
public:
  // `positions` are the images of the cell centres, axis 0 fastest; `step` is the width of a
  // lattice cell in the same units.
  MapDerivatives(const GridSize<Dimension>& lattice, const Point<Dimension>& step,
    ConstPointSpan<Dimension> positions)
    : MapDerivatives(lattice, LatticePart<Dimension>::WholeOf(lattice),
        LatticePart<Dimension>::WholeOf(lattice), step, positions)
  {
  }
  // For a part of the lattice: `positions` are those of a larger part, `within`, which contains the
  // first with the cells around it.
  MapDerivatives(const GridSize<Dimension>& lattice, const LatticePart<Dimension>& part,
    const LatticePart<Dimension>& within, const Point<Dimension>& step,
    ConstPointSpan<Dimension> positions)
    : Lattice(lattice)
    , Part(part)
    , Within(within)
    , Step(step)
    , Positions(positions)
  {
  }

  // A range kernel: writes divergence[i] and determinant[i] for the part's samples [first, last).
  void Write(std::int64_t first, std::int64_t last, double* divergence, double* determinant) const;

private:
  GridSize<Dimension> Lattice;
  LatticePart<Dimension> Part;
  LatticePart<Dimension> Within;
  Point<Dimension> Step;
  ConstPointSpan<Dimension> Positions;
};

} // namespace RectifiedTransport

#endif

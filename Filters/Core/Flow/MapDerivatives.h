// SPDX-License-Identifier: BSD-3-Clause
// First derivatives of a map that is known at the centres of a grid of cells: central differences,
// one-sided at the border.
#ifndef RectifiedTransport_MapDerivatives_h
#define RectifiedTransport_MapDerivatives_h

#include "Core/Tables/Density.h"

#include <cstdint>

namespace RectifiedTransport
{

// The trace of the displacement's gradient and the determinant of the map's Jacobian matrix do not
// change with the coordinates that both points and values are given in, so that what is found in
// index space holds for every spacing and direction. Along an axis of one cell nothing can be told,
// and the displacement is taken to be constant.
template <int Dimension>
class MapDerivatives
{
public:
  // `positions` are where the map takes the centres of the cells, axis 0 fastest; `step` is the
  // width of a cell in the same units.
  MapDerivatives(const GridSize<Dimension>& lattice, const Point<Dimension>& step,
    ConstPointSpan<Dimension> positions)
    : Lattice(lattice)
    , Step(step)
    , Positions(positions)
  {
  }

  // A range kernel: writes divergence[i] and determinant[i] for the samples [first, last).
  void Write(std::int64_t first, std::int64_t last, double* divergence, double* determinant) const;

private:
  GridSize<Dimension> Lattice;
  Point<Dimension> Step;
  ConstPointSpan<Dimension> Positions;
};

} // namespace RectifiedTransport

#endif

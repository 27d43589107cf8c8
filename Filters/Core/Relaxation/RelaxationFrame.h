// SPDX-License-Identifier: BSD-3-Clause
// Isotropic coordinates on the domain of a relaxation, in units of the mean spacing of its points.
#ifndef RectifiedTransport_RelaxationFrame_h
#define RectifiedTransport_RelaxationFrame_h

#include "Core/Geometry/GridSize.h"

#include <cstdint>

namespace RectifiedTransport
{

template <int Dimension>
struct RelaxationFrame
{
  // Throws std::invalid_argument unless the sides of a grid cell are positive and finite.
  RelaxationFrame(
    const GridSize<Dimension>& size, const Point<Dimension>& spacing, std::int64_t points);

  // Returns the side of a cube whose part in the domain has this measure, if it covers thin axes.
  double SideOf(double measure) const;
  // The same for a measure in grid cells.
  double SideOfCells(double cells) const;

  Point<Dimension> Sides;     // sides of the domain, in mean spacings
  Point<Dimension> CellSides; // sides of a grid cell, in mean spacings
};

} // namespace RectifiedTransport

#endif

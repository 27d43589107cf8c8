// SPDX-License-Identifier: BSD-3-Clause
// The share of a density's mass in a box, by summed-area tables (paper, Section 3.3), and the box
// that holds a given share.
#ifndef RectifiedTransport_BoxShare_h
#define RectifiedTransport_BoxShare_h

#include "Core/Geometry/Points.h"
#include "Core/Tables/TableView.h"

namespace RectifiedTransport
{

// The share of the mass in the part of a box that is in the domain, exact to the rounding of the
// sums (2e-16 of the whole); interpolated on graded tables.
template <int Dimension>
double boxShare(
  const TableView<Dimension>& tables, const Point<Dimension>& low, const Point<Dimension>& high);

// The measure, in grid cells, of the smallest box about `centre` that holds a share of the mass,
// clipped to the domain. Half the sides of the box are h * `aspect` with unknown h. The measure of
// the domain if the share is 1 or more, 0 if it is not above 0.
template <int Dimension>
double measureOfShare(const TableView<Dimension>& tables, const Point<Dimension>& centre,
  const Point<Dimension>& aspect, double share);
// The same by the tables of the tile that contains `centre`, if the box fits in them; else by the
// graded tables that the tile was made with.
template <int Dimension>
double measureOfShare(const TableView<Dimension>& graded, const TableView<Dimension>& tile,
  const Point<Dimension>& centre, const Point<Dimension>& aspect, double share);

} // namespace RectifiedTransport

#endif

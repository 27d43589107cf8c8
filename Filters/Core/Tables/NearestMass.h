// SPDX-License-Identifier: BSD-3-Clause
// The nearest grid cell that has mass, for points in empty cells.
#ifndef RectifiedTransport_NearestMass_h
#define RectifiedTransport_NearestMass_h

#include "Core/Geometry/Points.h"
#include "Core/Tables/TableView.h"

namespace RectifiedTransport
{

// Whether the grid cell that holds a point has mass; of a point on a face, any of its cells.
template <int Dimension>
bool hasMass(const TableView<Dimension>& tables, const Point<Dimension>& point);

// The point of a grid cell with mass that is nearest to `point`, at least 2^-20 inside that cell,
// where a cell's sides have the lengths `sides`.
template <int Dimension>
Point<Dimension> nearestMass(
  const TableView<Dimension>& tables, const Point<Dimension>& point, const Point<Dimension>& sides);

// The same for cells whose sides are equal.
template <int Dimension>
Point<Dimension> nearestMass(const TableView<Dimension>& tables, const Point<Dimension>& point)
{
  Point<Dimension> sides;
  sides.fill(1.0);
  return nearestMass<Dimension>(tables, point, sides);
}

} // namespace RectifiedTransport

#endif

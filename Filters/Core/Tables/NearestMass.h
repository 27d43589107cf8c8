// SPDX-License-Identifier: BSD-3-Clause
// The nearest grid cell that has mass, for points in empty cells.
#ifndef RectifiedTransport_NearestMass_h
#define RectifiedTransport_NearestMass_h

#include "Core/Geometry/Points.h"
#include "Core/Tables/TableView.h"

namespace RectifiedTransport
{

// Whether the grid cell that contains a point has mass; on a face, whether any of its cells has.
template <int Dimension>
bool hasMass(const TableView<Dimension>& tables, const Point<Dimension>& point);

// The point nearest to `point` in a grid cell with mass, at least 2^-20 inside that cell. A cell's
// sides have the lengths `sides`.
template <int Dimension>
Point<Dimension> nearestMass(
  const TableView<Dimension>& tables, const Point<Dimension>& point, const Point<Dimension>& sides);

// The same for cells with equal sides.
template <int Dimension>
Point<Dimension> nearestMass(const TableView<Dimension>& tables, const Point<Dimension>& point)
{
  Point<Dimension> sides;
  sides.fill(1.0);
  return nearestMass<Dimension>(tables, point, sides);
}

} // namespace RectifiedTransport

#endif

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

// The point of a grid cell with mass that is nearest to `point`, at least 2^-20 inside that cell.
template <int Dimension>
Point<Dimension> nearestMass(const TableView<Dimension>& tables, const Point<Dimension>& point);

} // namespace RectifiedTransport

#endif

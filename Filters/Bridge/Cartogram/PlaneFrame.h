// SPDX-License-Identifier: BSD-3-Clause
// Coordinates in the plane of flat data.
#ifndef RectifiedTransport_PlaneFrame_h
#define RectifiedTransport_PlaneFrame_h

#include "Core/Geometry/Points.h"

namespace RectifiedTransport
{

class PlaneFrame
{
public:
  // The plane through a point with a normal of any length above 0. The axes of a plane across the
  // z axis are x and y, exactly.
  PlaneFrame(const Point<3>& origin, const Point<3>& normal);

  Point<2> ToPlane(const Point<3>& place) const;
  // Of a place, signed.
  double Distance(const Point<3>& place) const;
  Point<3> ToSpace(const Point<2>& inPlane, double distance) const;

private:
  Point<3> Origin;
  Point<3> Axes[3]; // the last is the normal
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Coordinates in the plane of flat data.
#ifndef RectifiedTransport_PlaneFrame_h
#define RectifiedTransport_PlaneFrame_h

#include "Core/Geometry/PointBounds.h"
#include "Core/Geometry/Points.h"

#include <vector>

namespace RectifiedTransport
{

class PlaneFrame
{
public:
  // The plane through a point with a normal of any length above 0. The axes of a plane across the
  // z axis are x and y, exactly.
  PlaneFrame(const Point<3>& origin, const Point<3>& normal);

  Point<2> ToPlane(const Point<3>& place) const;
  const Point<3>& Normal() const { return this->Axes[2]; } // unit vector, upwards
  // The signed distance of a place from the plane, positive on the normal's side.
  double Distance(const Point<3>& place) const;
  Point<3> ToSpace(const Point<2>& inPlane, double distance) const;

private:
  Point<3> Origin;
  Point<3> Axes[3]; // the last is the normal
};

// The plane of rings: across the sum of their area vectors, all turned one way.
class RingPlane
{
public:
  // The points of a ring in their order.
  void Add(const std::vector<Point<3>>& ring);

  bool HasArea() const;
  // The frame of the plane through the middle of the bounds. The rings must have an area.
  PlaneFrame Frame() const;
  // The diagonal of the bounds.
  double Extent() const;

private:
  PointBounds Bounds;
  Point<3> Largest{ 0.0, 0.0, 0.0 }; // longest area vector of a ring
  Point<3> Sum{ 0.0, 0.0, 0.0 };     // sum of the area vectors
};

} // namespace RectifiedTransport

#endif

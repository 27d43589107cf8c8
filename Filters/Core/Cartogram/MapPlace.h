// SPDX-License-Identifier: BSD-3-Clause
// Where the square about a map is in space.
#ifndef RectifiedTransport_MapPlace_h
#define RectifiedTransport_MapPlace_h

#include "Core/Cartogram/Cartogram.h"
#include "Core/Cartogram/MapProjection.h"
#include "Core/Geometry/PlaneFrame.h"

namespace RectifiedTransport
{

struct MapPlace
{
  MapProjection Projection; // to the space of the frame
  PlaneFrame Frame;
  CartogramBox Box;
  double Blend; // the part of the way from before to after

  Point<2> ToIndex(const Point<3>& place) const
  {
    return this->Box.ToIndex(this->Frame.ToPlane(place));
  }
  // Returns the place between two places in index space, at a distance from the plane.
  Point<3> Blended(const Point<2>& before, const Point<2>& after, double distance) const
  {
    const Point<2> between{ before[0] + this->Blend * (after[0] - before[0]),
      before[1] + this->Blend * (after[1] - before[1]) };
    return this->Frame.ToSpace(this->Box.ToPlace(between), distance);
  }
};

} // namespace RectifiedTransport

#endif

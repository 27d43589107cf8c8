// SPDX-License-Identifier: BSD-3-Clause
// What moves along with a map: the lines of a graticule, and the points of an overlay.
#ifndef RectifiedTransport_MapOverlays_h
#define RectifiedTransport_MapOverlays_h

#include "Core/Cartogram/Cartogram.h"
#include "Core/Cartogram/MapProjection.h"
#include "Core/Geometry/PlaneFrame.h"

#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

// Where the square about a map is in space.
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

class MapOverlays
{
public:
  // `map` is in index space; `place` must outlive this object.
  MapOverlays(const MapPlace& place, const RegionMap& map);

  // Adds points of the overlay. Throws Failure if they are to be projected and cannot be.
  void AddOverlay(std::vector<Point<3>> points);
  // The points to be moved, in index space.
  OverlayPoints& Points() { return this->Moved; }

  // How many points the graticule's lines have up to the end of each.
  const std::vector<std::size_t>& LineEnds() const { return this->Ends; }
  // Where points are after the move, by their numbers.
  Point<3> GraticulePoint(std::size_t point) const
  {
    return this->Place.Blended(this->Before[point], this->Moved[point], 0.0);
  }
  Point<3> OverlayPoint(std::size_t point) const;

private:
  const MapPlace& Place;
  OverlayPoints Moved; // points of the graticule, then those of the overlay
  OverlayPoints Before;
  std::vector<std::size_t> Ends;
  std::vector<Point<3>> OverlayBefore; // projected
};

} // namespace RectifiedTransport

#endif

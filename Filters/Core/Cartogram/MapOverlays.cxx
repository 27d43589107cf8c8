// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/MapOverlays.h"

#include "Core/Geometry/PointBounds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace RectifiedTransport
{

namespace
{

constexpr int squares = 16;   // squares of the graticule along each side of the raster
constexpr int mostParts = 16; // points along a square's side

// The squares that a map reaches along an axis, with the raster's margin around it.
struct SquareRange
{
  int First;
  int Last; // one beyond
};

std::array<SquareRange, 2> squaresOf(const RegionMap& map, double side)
{
  // The graticule covers the map and the raster's margin around it, clipped to the raster.
  const auto bounds = Bounds<2>::Of(map.Points());
  const double margin = 0.5 * (side - bounds.LongestSide());
  // A map that ends on a line of the graticule up to rounding does not reach the next square.
  constexpr double rounding = 1e-6;
  std::array<SquareRange, 2> reach;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    reach[axis] = {
      std::max(
        0, static_cast<int>(std::floor((bounds.Low[axis] - margin) / side * squares + rounding))),
      std::min(squares,
        static_cast<int>(std::ceil((bounds.High[axis] + margin) / side * squares - rounding)))
    };
  }
  return reach;
}

} // namespace

MapOverlays::MapOverlays(const MapPlace& place, const RegionMap& map)
  : Place(place)
{
  const auto side = static_cast<double>(place.Box.Side);
  // The parts of a line are not shorter than cells.
  const int parts = std::clamp(static_cast<int>(place.Box.Side / squares), 1, mostParts);
  const std::array<SquareRange, 2> reach = squaresOf(map, side);
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const SquareRange across = reach[axis];
    const SquareRange along = reach[1 - axis];
    for (int line = across.First; line <= across.Last; ++line)
    {
      // A line has points between the squares, too, so that it can bend.
      for (int i = parts * along.First; i <= parts * along.Last; ++i)
      {
        Point<2> point;
        point[axis] = side * line / squares;
        point[1 - axis] = side * i / (squares * parts);
        this->Moved.push_back(point);
      }
      this->Ends.push_back(this->Moved.size());
    }
  }
  // The places before the motion, for blends of both.
  this->Before = this->Moved;
}

void MapOverlays::AddOverlay(std::vector<Point<3>> points)
{
  // The overlay has the projection of the map.
  this->Place.Projection.Require(points, "Overlay");
  const std::size_t first = this->Moved.size();
  this->Moved.resize(first + points.size());
  this->Before.resize(this->Moved.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = this->Place.Projection.Project(points[i]);
    this->Moved[first + i] = this->Before[first + i] = this->Place.ToIndex(points[i]);
  }
  this->OverlayBefore.insert(this->OverlayBefore.end(), points.begin(), points.end());
}

Point<3> MapOverlays::OverlayPoint(std::size_t point) const
{
  const std::size_t at = this->Ends.back() + point;
  const Point<3>& before = this->OverlayBefore[point];
  const Point<3> place =
    this->Place.Blended(this->Before[at], this->Moved[at], this->Place.Frame.Distance(before));
  // For a point so far away that its index is infinite, the displacement is below rounding.
  const bool isFinite = std::all_of(
    place.begin(), place.end(), [](double coordinate) { return std::isfinite(coordinate); });
  return isFinite ? place : before;
}

} // namespace RectifiedTransport

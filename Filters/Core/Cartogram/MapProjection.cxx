// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/MapProjection.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/PropertyCheck.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace RectifiedTransport
{

namespace
{

// The radius, in kilometres, of a sphere with the area of the earth.
constexpr double radius = 6371.0;
constexpr double radian = 3.14159265358979323846 / 180.0;
constexpr double farthestEast = 360.0;
constexpr double farthestNorth = 90.0;

// Rounds degrees to 2^-50, a ten-thousandth of a micrometre on the ground, so that sine and cosine
// have the same bits on every machine.
CosineAndSine cosineAndSineOf(double degrees)
{
  constexpr int bits = 50;
  return cosineAndSine(
    static_cast<std::int64_t>(std::round(std::ldexp(degrees, bits))), std::int64_t{ 360 } << bits);
}

// Returns whether a place can be a longitude and a latitude; longitudes may go around once more.
bool isOnEarth(const Point<3>& place)
{
  constexpr double rounding = 1e-6;
  return std::abs(place[0]) <= farthestEast + rounding &&
    std::abs(place[1]) <= farthestNorth + rounding;
}

} // namespace

MapProjection::MapProjection(const std::vector<Point<3>>& places)
  : Cosine(1.0)
{
  this->Require(places, "input");
  // The latitude p is the middle between the southernmost and the northernmost one.
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const Point<3>& place : places)
  {
    low = std::min(low, place[1]);
    high = std::max(high, place[1]);
  }
  this->Cosine = cosineAndSineOf(0.5 * (low + high)).Cosine;
}

Point<3> MapProjection::Project(const Point<3>& place) const
{
  if (this->Cosine == 0.0)
  {
    return place;
  }
  const double latitude = std::clamp(place[1], -farthestNorth, farthestNorth);
  return { radius * this->Cosine * radian * place[0],
    radius / this->Cosine * cosineAndSineOf(latitude).Sine, place[2] };
}

void MapProjection::Require(const std::vector<Point<3>>& places, const char* what) const
{
  const auto wrong = std::find_if_not(places.begin(), places.end(), isOnEarth);
  if (this->Cosine != 0.0 && wrong != places.end())
  {
    fail("Projection is EqualArea, and point ", wrong - places.begin(), " of the ", what,
      " is at (", textOf((*wrong)[0]), ", ", textOf((*wrong)[1]),
      "); points must be longitudes from -360 to 360 and latitudes from -90 to 90, in degrees");
  }
}

} // namespace RectifiedTransport

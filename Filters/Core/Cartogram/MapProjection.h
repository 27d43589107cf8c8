// SPDX-License-Identifier: BSD-3-Clause
// Longitudes and latitudes in degrees to a map projection that keeps areas.
#ifndef RectifiedTransport_MapProjection_h
#define RectifiedTransport_MapProjection_h

#include "Core/Geometry/Points.h"

#include <vector>

namespace RectifiedTransport
{

// Indexed by the enumeration of vtkCartogram.
constexpr const char* ProjectionTexts[] = { "None", "EqualArea" };

// None, or Lambert's cylindrical equal-area projection: x = R cos(p) lambda, y = R sin(phi) /
// cos(p), with the least bending of shapes at the latitude p; kilometres of a sphere with the
// earth's area.
class MapProjection
{
public:
  MapProjection() = default;
  // Projects with p at the mean of the southernmost and the northernmost latitude. Throws Failure
  // for places that are not longitudes and latitudes.
  explicit MapProjection(const std::vector<Point<3>>& places);

  // Keeps the third coordinate.
  Point<3> Project(const Point<3>& place) const;
  // Throws Failure, if there is a projection, for places of `what` that are no longitudes and
  // latitudes.
  void Require(const std::vector<Point<3>>& places, const char* what) const;

private:
  double Cosine = 0.0; // cosine of the latitude p; 0 without a projection
};

} // namespace RectifiedTransport

#endif

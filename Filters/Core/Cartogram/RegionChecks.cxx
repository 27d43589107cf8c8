// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Cartogram/RegionChecks.h"

#include "Core/Cartogram/Cartogram.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/PartText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace RectifiedTransport
{

namespace
{

// Counts regions that lack something, and keeps the first one.
class EmptyRegions
{
public:
  explicit EmptyRegions(const std::vector<std::string>& names)
    : Names(names)
  {
  }

  void Add(std::size_t region) { this->First = this->Count++ == 0 ? region : this->First; }
  bool Any() const { return this->Count > 0; }
  // Returns a text such as "2 of 5 regions (40 %) have no area (the first is the region 'x')".
  std::string Lack(const std::string& what) const
  {
    return describePart(this->Count, static_cast<std::int64_t>(this->Names.size()), "regions") +
      " have no " + what + " (the first is the region " + this->Names[this->First] + ")";
  }

private:
  const std::vector<std::string>& Names;
  std::int64_t Count = 0;
  std::size_t First = 0;
};

} // namespace

PlaneFrame planeOfRegions(const std::vector<Point<3>>& places, const RingVisits& visitRings)
{
  // The plane is fitted to the rings, weighted by their areas, so that open lines and stray points
  // do not tilt it.
  RingPlane plane;
  std::vector<Point<3>> ring;
  visitRings([&](const std::vector<std::int64_t>& points) {
    ring.clear();
    for (const std::int64_t point : points)
    {
      ring.push_back(places[static_cast<std::size_t>(point)]);
    }
    plane.Add(ring);
  });
  if (!plane.HasArea())
  {
    fail("The regions have no area; they must be polygons or closed lines in a plane");
  }
  const PlaneFrame frame = plane.Frame();
  // The largest distance from the plane, relative to the map's extent.
  constexpr double flat = 1e-4;
  // Every point must be near the plane, or the map is not flat.
  double farthest = 0.0;
  for (const Point<3>& place : places)
  {
    farthest = std::max(farthest, std::abs(frame.Distance(place)));
  }
  if (farthest > flat * plane.Extent())
  {
    fail("The regions are not in a plane: points are up to ", farthest, " away from one, of ",
      plane.Extent(), " in all; project them first");
  }
  return frame;
}

double requireAreas(const std::vector<double>& areas, const std::vector<std::string>& names)
{
  constexpr double nothing = 1e-15; // relative to the sum
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  EmptyRegions empty(names);
  // An area that rounding alone may produce has no density.
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    if (!(areas[i] > nothing * sum))
    {
      empty.Add(i);
    }
  }
  if (empty.Any())
  {
    fail(empty.Lack("area"), "; remove them, with Threshold");
  }
  return sum;
}

std::int32_t completeMasses(std::vector<double>& masses, double leastShare,
  const std::vector<double>& areas, const std::vector<std::string>& names,
  std::vector<std::string>& warnings)
{
  // Relative to the mean density: with less, errors would not be finite.
  constexpr double nothing = 1e-100;
  const double land = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
  EmptyRegions empty(names);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    // A region without mass cannot have the area 0 in the cartogram; it gets the least density.
    const double area = areas[i] / land;
    if (!(masses[i] / total > nothing * area))
    {
      empty.Add(i);
      masses[i] = leastRegionDensity * total * area;
    }
  }
  if (empty.Any())
  {
    warnings.push_back(empty.Lack("mass") +
      "; they get a ten-thousandth of the mean density, as no area can be shown");
  }
  const std::int32_t enlarged = leastShare > 0.0 ? raiseMasses(masses, leastShare) : 0;
  if (enlarged > 0)
  {
    warnings.push_back(describePart(enlarged, static_cast<std::int64_t>(masses.size()), "regions") +
      " are enlarged to MinimumShare");
  }
  return enlarged;
}

} // namespace RectifiedTransport

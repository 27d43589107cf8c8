// SPDX-License-Identifier: BSD-3-Clause
// What regions need for a cartogram: a plane, areas and masses.
#ifndef RectifiedTransport_RegionChecks_h
#define RectifiedTransport_RegionChecks_h

#include "Core/Geometry/PlaneFrame.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Calls visit(points) for each closed ring, with the numbers of its points.
using RingVisits =
  std::function<void(const std::function<void(const std::vector<std::int64_t>&)>&)>;

// Throws Failure if the rings have no area or the places are not in one plane.
PlaneFrame planeOfRegions(const std::vector<Point<3>>& places, const RingVisits& visitRings);

// Throws Failure if an area is nothing compared with their sum, which it returns. `names` are the
// regions' names.
double requireAreas(const std::vector<double>& areas, const std::vector<std::string>& names);

// Gives regions without mass the least that a region has, and enlarges those below a share of the
// sum to it (see raiseMasses). Returns how many these are. Adds warnings.
std::int32_t completeMasses(std::vector<double>& masses, double leastShare,
  const std::vector<double>& areas, const std::vector<std::string>& names,
  std::vector<std::string>& warnings);

} // namespace RectifiedTransport

#endif

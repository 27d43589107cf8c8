// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a map or with its cartogram, in words.
#ifndef RectifiedTransport_MapWarnings_h
#define RectifiedTransport_MapWarnings_h

#include "Core/Cartogram/Cartogram.h"

#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// Whether places may be longitudes and latitudes in degrees: all are on the earth, and the map is
// wide, or as far from the equator as countries are.
bool looksLikeDegrees(const std::vector<Point<3>>& places);

// Adds warnings on errors of a cartogram's areas, with a remedy. `masses` and `names` are those of
// the regions. Returns how many regions miss the tolerance; with less than 1 % of the mass in all
// they are no warning.
std::int64_t addWarnings(const CartogramResult& result, const std::vector<double>& masses,
  const std::vector<std::string>& names, std::int64_t rings, double tolerance,
  std::vector<std::string>& warnings);

} // namespace RectifiedTransport

#endif

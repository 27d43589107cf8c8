// SPDX-License-Identifier: BSD-3-Clause
// What a user should know of a map to the unit square.
#ifndef RectifiedTransport_ParameterizationReport_h
#define RectifiedTransport_ParameterizationReport_h

#include "Surfaces/Parameterization/MapDistortion.h"

#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// How far the map is from its goal.
struct ParameterizationReport
{
  std::int64_t Triangles;
  std::int64_t Collapsed; // all points on one side of the square
  MapDistortion Distortion;
  bool Polish;
  bool IsCut;         // along seams, or in several components
  std::string Repair; // what was repaired in the surface; empty if nothing was

  // What a user should know; usually nothing.
  std::vector<std::string> Warnings() const;
};

// A warning about triangles that have no area in the map; Corners help if the surface is not cut.
std::string collapsedWarning(std::int64_t collapsed, std::int64_t triangles, bool isCut = false);

} // namespace RectifiedTransport

#endif

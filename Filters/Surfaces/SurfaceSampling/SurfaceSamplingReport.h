// SPDX-License-Identifier: BSD-3-Clause
// What a user should know of the samples of a surface.
#ifndef RectifiedTransport_SurfaceSamplingReport_h
#define RectifiedTransport_SurfaceSamplingReport_h

#include <cstdint>
#include <string>
#include <vector>

namespace RectifiedTransport
{

// The numbers of one run, for warnings.
struct SurfaceSamplingReport
{
  std::int64_t Particles = 0;
  std::int64_t Moved = 0; // from empty cells of the grid to the nearest mass
  std::string Steps;      // a warning; empty if there is none
  std::int64_t Triangles = 0;
  std::int64_t Collapsed = 0; // triangles without area in the map
  double PatchError = 0.0;
  bool IsAreaPreserving = false; // the map that the particles come from
  std::string Repair;            // what was repaired in the surface; empty if nothing was

  std::vector<std::string> Warnings() const;
};

} // namespace RectifiedTransport

#endif

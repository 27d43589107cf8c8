// SPDX-License-Identifier: BSD-3-Clause
// What was repaired in a surface, in words.
#ifndef RectifiedTransport_RepairText_h
#define RectifiedTransport_RepairText_h

#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <string>

namespace RectifiedTransport
{

struct RepairCounts : SurfaceRepairs
{
  std::int64_t TJunctions = 0;
  double Gap = 0.0;             // largest gap at T-junctions; 0 if only rounding makes gaps
  std::int64_t PartedEdges = 0; // edges of more than two triangles
};

// "The input surface was repaired: 2 points in no polygon left out, ..."; empty if nothing was.
std::string repairWarning(const RepairCounts& counts);

} // namespace RectifiedTransport

#endif

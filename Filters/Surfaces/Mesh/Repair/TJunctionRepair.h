// SPDX-License-Identifier: BSD-3-Clause
// Closes the T-junctions of a surface, also those that triangles without area leave.
#ifndef RectifiedTransport_TJunctionRepair_h
#define RectifiedTransport_TJunctionRepair_h

#include "Core/Parallel/Context.h"
#include "Surfaces/Mesh/Repair/SplitSurface.h"
#include "Surfaces/Mesh/TriangleSurface.h"

#include <cstdint>
#include <optional>

namespace RectifiedTransport
{

// Which T-junctions are closed.
enum class TJunctionScope
{
  All,
  OfDegenerateTriangles // that these leave; all edges that were open stay open
};

struct TJunctionRepair
{
  std::optional<SplitSurface> Parts; // none if no triangle was cut
  std::int64_t TJunctions = 0;       // at edges that were open
  std::int64_t FlatTriangles = 0;    // that were left out
};

// Points at one place count as one. Those that differ by rounding do, too, if then fewer edges are
// open and more T-junctions found. A triangle of three points on a line is left out, unless its
// longest side is on the boundary, and the one across that side is cut at its third point; not if
// that would leave more edges open. Parts have points of the surface; points are not moved.
//
// O(triangles log triangles). Memory: 150 bytes a triangle and 72 a point. The result does not
// depend on threads. Throws std::bad_alloc and Cancelled.
TJunctionRepair repairTJunctions(
  const TriangleSurface& surface, TJunctionScope scope, const Context& context = Context());

} // namespace RectifiedTransport

#endif

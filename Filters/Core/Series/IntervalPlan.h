// SPDX-License-Identifier: BSD-3-Clause
// The plan between the densities of two steps.
#ifndef RectifiedTransport_IntervalPlan_h
#define RectifiedTransport_IntervalPlan_h

#include "Core/Plan/TransportPlan.h"
#include "Core/Series/SeriesParticles.h"

#include <memory>

namespace RectifiedTransport
{

// Returns about how many bytes the flows take with whole tables and the advection of points.
double bytesOfIntervalFlows(const SeriesStep& from, const SeriesStep& to);

// Both steps have mass, and the box contains their grids; lengths are in its LengthScale. The
// steps need not outlive the plan: its map or its flows are made. Collective. Throws std::bad_alloc
// and Cancelled.
template <int D>
std::unique_ptr<const TransportPlan<D>> planInterval(const SeriesStep& from, const SeriesStep& to,
  const ImageGrid& box, bool isOptimal, Progress& progress);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Where the particles of the pivot are in a density on a grid.
#ifndef RectifiedTransport_PivotPositions_h
#define RectifiedTransport_PivotPositions_h

#include "Core/Flow/PivotLattice.h"
#include "Core/Flow/RectifiedFlow.h"
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"

namespace RectifiedTransport
{

// As transportPivot of a share of the particles, to physical points. In 3D no other memory is used.
template <int D>
FlowReport writePivot(const RectifiedFlow<D>& flow, const ImageGrid& grid,
  const PivotLattice<D>& pivot, const RankShare& share, PointSpan<3> physical,
  const FlowOptions& options, Progress& progress)
{
  Stages stages(progress, { { "flow", 94 }, { "positions", 2 } });
  LargeBuffer<double> buffer(D == 3 ? 0 : physical.size() * D);
  const PointSpan<D> positions(D == 3 ? physical.data() : buffer.data(), physical.size());
  const FlowReport report =
    transportPivot<D>(flow, pivot, share.First, positions, options, stages["flow"]);
  writePhysical<D>(grid, positions, stages["positions"], physical);
  return report;
}

} // namespace RectifiedTransport

#endif

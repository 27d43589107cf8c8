// SPDX-License-Identifier: BSD-3-Clause
// Splats the masses of distributed points.
#ifndef RectifiedTransport_DistributedSplat_h
#define RectifiedTransport_DistributedSplat_h

#include "Bridge/Ranks/TupleBoxes.h"
#include "Bridge/Splat/MassSplat.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

namespace RectifiedTransport::Bridge
{

// As splatPoints, for the points of all ranks, in the order of the ranks and then of their points.
// Each rank gets the cells (or dual cells) of its box `wanted`, tuples of the target's whole
// geometry as tuplesOf(extent, owner, whole) gives them. Boxes may be empty and may overlap.
// `cells` has wanted.Count() tuples. `order` may be nullptr; else it has a key for each point. If
// all ranks that have points give keys, the terms of a cell are added in the order of the keys
// (equal keys: by rank, then by index). Collective on the ranks of the progress. Returns how many
// points of all ranks are outside the domain. Memory: about 100 bytes for each point that a rank
// sends, and as much for each that reaches its box. Throws Failure if memory is short, and
// Cancelled.
std::int64_t splatDistributed(vtkDataArray* points, const double* masses, double massEach,
  const std::int64_t* order, const SplatTarget& target, const TupleBox& wanted, Progress& progress,
  vtkDoubleArray* cells);

} // namespace RectifiedTransport::Bridge

#endif

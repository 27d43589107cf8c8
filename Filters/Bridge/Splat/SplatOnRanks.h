// SPDX-License-Identifier: BSD-3-Clause
// The splat of distributed points and its total mass, bitwise as on one rank.
#ifndef RectifiedTransport_SplatOnRanks_h
#define RectifiedTransport_SplatOnRanks_h

#include "Bridge/Points/SplatTarget.h"
#include "Bridge/Ranks/TupleBoxes.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Progress.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDoubleArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

class PointMasses;
class DistributedPoints;

// The masses are those of all points of the set.
struct RankSplatInput
{
  const DistributedPoints& Points;
  const PointMasses& Masses;
  const SplatTarget& Target;
};

// Tuples of the image.
struct RankSplatBoxes
{
  TupleBox Whole;
  TupleBox Wanted; // by this rank
};

struct RankSplat
{
  std::int64_t Outside; // of the points of all ranks
  double TotalMass;     // that the whole image holds
};

// Writes the wanted cells. Runs as the current stage. Collective on the ranks of the progress.
// Throws Failure and Cancelled.
RankSplat splatOnRanks(const RankSplatInput& input, const RankSplatBoxes& boxes, Progress& progress,
  vtkDoubleArray* cells);

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// What must be the same on all ranks, and the part of an output that each rank gives.
#ifndef RectifiedTransport_RankConsistency_h
#define RectifiedTransport_RankConsistency_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/TupleBoxes.h"
#include "Core/Parallel/Ranks.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkInformation;
class vtkObject;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// Throws Failure if a text is not the same on all ranks that have one; `what` begins the message,
// and `rule` ends it. Returns the text; empty if no rank has one. Collective.
std::string requireSameOnRanks(const Ranks& ranks, const std::string& own, const std::string& what,
  const std::string& rule = "it must be of one type on all");

// Throws Failure if a property that PrintSelf prints after Threading is not the same on all ranks.
// Collective.
void requireSameProperties(vtkObject* filter, const Ranks& ranks);

// Whether all ranks have the same data, or none has any: one data set, not parts of one. `data` may
// be nullptr. Collective.
bool areSameOnRanks(vtkDataObject* data, const Ranks& ranks);

// The pieces into which VTK divides an extent; points at their faces are in both.
std::vector<Extent> dividedExtent(const Extent& whole, int ranks);

// The part of an image that this rank outputs. A single rank outputs all of it. Otherwise, if all
// ranks have announced the whole extent, it is the requested part, with at least a layer of cells;
// else its piece of the whole, because requests then refer to another extent. Collective.
Extent extentToGive(const Extent& whole, vtkInformation* output, const Ranks& ranks);

} // namespace RectifiedTransport::Bridge

#endif

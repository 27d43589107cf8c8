// SPDX-License-Identifier: BSD-3-Clause
// Data sets that lie on several ranks, gathered.
#ifndef RectifiedTransport_GatheredParts_h
#define RectifiedTransport_GatheredParts_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// A data set with points, or the part of one that a rank has.
struct DataPart
{
  std::int64_t Number = 0; // of the data set, the same on all ranks
  std::string Name;
  vtkSmartPointer<vtkDataSet> Data;
};

enum class Receivers
{
  All,
  First // the first rank alone
};

struct GatheredParts
{
  // Those of all ranks by their numbers, and of one number by rank; none where this rank is no
  // receiver.
  std::vector<DataPart> Parts;
  // Whether every rank has all parts itself.
  bool AreWhole = false;
};

// What several ranks have of one number and is the same, as of data that are whole on each, counts
// once, as that of the lowest rank. `own` are sorted by number. Called by all ranks. Throws Failure
// for types that cannot be sent, and std::bad_alloc.
GatheredParts gatherDataParts(
  const std::vector<DataPart>& own, const Ranks& ranks, Receivers receivers);

} // namespace RectifiedTransport

#endif

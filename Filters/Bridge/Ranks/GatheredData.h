// SPDX-License-Identifier: BSD-3-Clause
// Distributed data sets, gathered on all ranks or on the first one.
#ifndef RectifiedTransport_GatheredData_h
#define RectifiedTransport_GatheredData_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// A data set with points, or the part of one that a rank has.
struct DataPart
{
  std::int64_t Number = 0; // the number of the data set, the same on all ranks
  std::string Name;
  vtkSmartPointer<vtkDataSet> Data;
};

enum class Receivers
{
  All,
  First // the first rank only
};

struct GatheredParts
{
  // The parts of all ranks in the order of their numbers, then of the ranks; none if this rank is
  // no receiver.
  std::vector<DataPart> Parts;
  // Whether every rank has all parts itself.
  bool AreWhole = false;
};

// If several ranks have the same data under one number, they count once, as those of the lowest
// rank. `own` is sorted by number. Collective. Throws Failure for types that cannot be sent, and
// std::bad_alloc.
GatheredParts gatherDataParts(
  const std::vector<DataPart>& own, const Ranks& ranks, Receivers receivers);

// What counts of a point set: all of its points, or those of its cells.
enum class PointSetKind
{
  Points,
  Surface,
  Polygons // a surface whose points the caller merges
};

// A distributed point set as one: the points and cells of rank 0 first, with the arrays that all
// ranks have. Data that are the same on several ranks count once. Duplicates that ghost arrays mark
// do not count. Points: those that countedPoints gives. Surface: points of several ranks at the
// same position become one, so that it is whole. nullptr if this rank is no receiver or no rank has
// points. Arrays that are too short on a rank have no tuples. `own` may be nullptr.
// Collective. Throws Failure for types that differ, and std::bad_alloc.
vtkSmartPointer<vtkPointSet> gatherPoints(
  vtkPointSet* own, const Ranks& ranks, Receivers receivers, PointSetKind kind);

} // namespace RectifiedTransport::Bridge

#endif

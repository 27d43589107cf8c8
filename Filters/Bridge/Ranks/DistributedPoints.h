// SPDX-License-Identifier: BSD-3-Clause
// Points that lie on several ranks: which of them count, and in which order.
#ifndef RectifiedTransport_DistributedPoints_h
#define RectifiedTransport_DistributedPoints_h

#include "Bridge/Points/GhostFlags.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Of a data set that is the same on all ranks the points of the first rank alone count, and of the
// points of a mesh that ranks share at the borders of their cells those of the lowest one.
// Particles lie on ranks in another order than on one: their order is that of the integers in their
// point array SeedId, or else of their global ids, where all ranks that have points have the array.
class DistributedPoints
{
public:
  // Without the points that the ghost array marks with one of these flags. Collective;
  // `own` may be nullptr. Throws Failure.
  DistributedPoints(vtkPointSet* own, unsigned char ghosts, const Ranks& ranks);

  // Of this rank; without points where none count.
  vtkPointSet* Set() const { return this->Points; }
  const CountedPoints& Counted() const { return this->Number; }
  // The number of points of all ranks.
  std::int64_t All() const { return this->Total; }
  // One for each counted point; nullptr where the order is that of the ranks and their points.
  const std::int64_t* Keys() const { return this->Order.data(); }
  // The tuples of the counted points: the array itself, or a copy.
  vtkSmartPointer<vtkDataArray> TuplesOf(vtkDataArray* array) const;

private:
  void FindKeys(const Ranks& ranks);

  vtkSmartPointer<vtkPointSet> Points;
  CountedPoints Number;
  std::int64_t Total;
  LargeBuffer<std::int64_t> Order;
};

// The points of this rank that count, with their arrays, where duplicates that the ghost array
// marks do not: the set itself where all of them do, else points with a vertex each. A single rank
// gets what it gave. Collective; `given` may be nullptr. Throws Failure.
vtkSmartPointer<vtkPointSet> countedPoints(vtkPointSet* given, const Ranks& ranks);

} // namespace RectifiedTransport

#endif

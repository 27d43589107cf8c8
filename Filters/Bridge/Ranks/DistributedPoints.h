// SPDX-License-Identifier: BSD-3-Clause
// Points distributed over ranks: which of them count, and in which order.
#ifndef RectifiedTransport_DistributedPoints_h
#define RectifiedTransport_DistributedPoints_h

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"

#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// If every rank holds the same data set, only rank 0's points count. If ranks share points of a
// mesh at the borders of their cells, those of the lowest rank count. The order of particles on
// several ranks differs from that on one. It is therefore that of the integer point array SeedId,
// or else of the global ids, if all ranks that have points have the array.
class DistributedPoints
{
public:
  // Points that the ghost array marks with one of these flags do not count. `own` may be nullptr.
  // Collective. Throws Failure.
  DistributedPoints(vtkPointSet* own, unsigned char ghosts, const Ranks& ranks);

  // This rank's points; without points if none count.
  vtkPointSet* Set() const { return this->Points; }
  const NonGhostPoints& Counted() const { return this->Number; }
  // The number of points of all ranks.
  std::int64_t All() const { return this->Total; }
  // One for each counted point; nullptr if the order is that of the ranks and their points.
  const std::int64_t* Keys() const { return this->Order.data(); }
  // The tuples of the counted points: the array itself, or a copy.
  vtkSmartPointer<vtkDataArray> TuplesOf(vtkDataArray* array) const;

private:
  void FindKeys(const Ranks& ranks);

  vtkSmartPointer<vtkPointSet> Points;
  NonGhostPoints Number;
  std::int64_t Total;
  LargeBuffer<std::int64_t> Order;
};

// The points of this rank that count, with their arrays. Duplicates that the ghost array marks do
// not count. Returns the set itself if all its points count, else points with a vertex each. A
// single rank gets its own set. `given` may be nullptr. Collective. Throws Failure.
vtkSmartPointer<vtkPointSet> countedPoints(vtkPointSet* given, const Ranks& ranks);

} // namespace RectifiedTransport::Bridge

#endif

// SPDX-License-Identifier: BSD-3-Clause
// A tree of bounding boxes over points that reach as far as their spacings. It finds the points
// whose kernels may overlap a box. Its leaves are blocks of `repulsionBlock` points (the last may
// have fewer), as the kernels take them.
#ifndef RectifiedTransport_NeighbourTree_h
#define RectifiedTransport_NeighbourTree_h

#include "Core/Geometry/Points.h"
#include "Core/Geometry/Trees/BlockTree.h"
#include "Core/Relaxation/Kernels/RepulsionKernels.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

template <int Dimension>
ScaledPoint<Dimension> scaledPoint(const Point<Dimension>& x, double spacing, double mass)
{
  ScaledPoint<Dimension> point;
  std::copy_n(x.begin(), Dimension, point.X);
  point.Spacing = spacing;
  point.Square = spacing * spacing;
  point.Mass = mass;
  return point;
}

// The blocks and points in reach of some blocks, and their memory, which is used again.
struct Neighbourhood
{
  std::int64_t First = 0; // the blocks [First, Last) for which Blocks were found
  std::int64_t Last = 0;
  std::vector<std::int64_t> Blocks;
  std::vector<std::int64_t> Points; // their numbers in the order of the tree, for one of them
  std::int64_t Count = 0;           // number of valid entries in Points
};

template <int Dimension>
class NeighbourTree
{
public:
  // Reorders the points. The order depends only on the set of points. Polls for cancellation.
  void Build(const std::vector<ScaledPoint<Dimension>>& points, Progress& progress);
  // Keeps the order of points that are near each other in it, to save time.
  void BuildInOrder(const std::vector<ScaledPoint<Dimension>>& points, Progress& progress);
  // Updates the boxes after points have changed.
  void Update();

  std::int64_t Size() const { return this->Count; }
  std::int64_t Blocks() const { return static_cast<std::int64_t>(this->Sorted.size()); }
  const ScaledBlock<Dimension>* Points() const { return this->Sorted.data(); }
  ScaledPoint<Dimension> Get(std::int64_t i) const;
  void Set(std::int64_t i, const ScaledPoint<Dimension>& point);
  // The original indices of the points given to Build; nothing after BuildInOrder.
  const std::int64_t* Order() const { return this->Places.data(); }

  // The points of a block, the last one repeated to fill it. Returns how many there are.
  int Fill(std::int64_t block, RepulsionBlock<Dimension>& into) const;

  // Finds the points y to which points of a block of `targets` may be closer than sqrt(reach * (the
  // sum of both squared spacings)). Fastest for blocks in their order, up to the block `last`: what
  // is in reach of neighbouring blocks is found once.
  void FindNearby(const NeighbourTree& targets, std::int64_t block, std::int64_t last, double reach,
    Neighbourhood& found) const;

private:
  // Begin() allocates blocks for `points` points; End() marks the missing ones and builds the
  // boxes.
  void Begin(std::int64_t points);
  void End();
  BlockBounds<Dimension> BoundsOf(std::int64_t block) const;

  RepulsionKernels<Dimension> Kernels = repulsionKernels<Dimension>();
  std::int64_t Count = 0;
  std::vector<ScaledBlock<Dimension>> Sorted;
  std::vector<std::int64_t> Places;
  BlockTree<Dimension> Boxes; // its `Largest` is the largest squared spacing in a box
};

} // namespace RectifiedTransport

#endif

// SPDX-License-Identifier: BSD-3-Clause
// A tree of bounding boxes over points that reach as far as their spacings. It finds the points
// whose kernels may overlap a box. Its leaves are blocks of `repulsionBlock` points (the last may
// have fewer), as the kernels take them.
#ifndef RectifiedTransport_ReachTree_h
#define RectifiedTransport_ReachTree_h

#include "Core/Geometry/Points.h"
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

template <int Dimension>
class ReachTree
{
public:
  // Reorders the points. The order depends only on the set of points. Polls for cancellation.
  void Build(std::vector<ScaledPoint<Dimension>> points, Progress& progress);
  // Updates the boxes after points have changed.
  void Update();

  std::int64_t Size() const { return static_cast<std::int64_t>(this->Sorted.size()); }
  std::int64_t Blocks() const { return (this->Size() + repulsionBlock - 1) / repulsionBlock; }
  ScaledPoint<Dimension>* Points() { return this->Sorted.data(); }
  const ScaledPoint<Dimension>* Points() const { return this->Sorted.data(); }
  // The original indices of the points given to Build.
  const std::int64_t* Order() const { return this->Places.data(); }

  // The points of a block, the last one repeated to fill it. Returns how many there are.
  int Fill(std::int64_t block, RepulsionBlock<Dimension>& into) const;

  // Finds the points y to which points of a block of `targets` may be closer than sqrt(reach * (the
  // sum of both squared spacings)).
  void FindInReach(const ReachTree& targets, std::int64_t block, double reach,
    std::vector<ScaledPoint<Dimension>>& found) const;

private:
  struct Box
  {
    double Low[Dimension];
    double High[Dimension];
    double Square;      // the largest squared spacing
    std::int64_t First; // blocks [First, Last)
    std::int64_t Last;
    std::int64_t Second; // the first child is the next box; -1 in a leaf
  };

  void MakeBoxes();
  void Bound(Box& leaf) const;

  std::vector<ScaledPoint<Dimension>> Sorted;
  std::vector<std::int64_t> Places;
  std::vector<Box> Boxes;
  std::vector<std::int64_t> BlockBox;
};

} // namespace RectifiedTransport

#endif

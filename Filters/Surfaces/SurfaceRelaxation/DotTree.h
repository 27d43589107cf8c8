// SPDX-License-Identifier: BSD-3-Clause
// Dots in the order of k-d cuts, and a tree of their bounding boxes, which finds those that may
// push the dots of a block.
#ifndef RectifiedTransport_DotTree_h
#define RectifiedTransport_DotTree_h

#include "Core/Geometry/Trees/BlockTree.h"
#include "Surfaces/SurfaceRelaxation/Kernels/DotKernels.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;

// How many of `dots` dots are in the first half of a cut: whole blocks, as far as there are any.
inline std::int64_t dotsBeforeCut(std::int64_t dots)
{
  const std::int64_t blocks = (dots + dotBlock - 1) / dotBlock;
  return blocks > 1 ? dotBlock * (blocks / 2) : dots / 2;
}

// The largest number of a box is the dots' spacing.
using DotBox = BlockBounds<3>;

class DotTree
{
public:
  // Dots are in the order of the cuts. Blocks of dotBlock dots are the leaves.
  explicit DotTree(std::int64_t dots);
  static double MemoryFor(std::int64_t dots);

  std::int64_t Blocks() const { return this->Tree.Blocks(); }
  // Bounds the dots. Throws Cancelled.
  void Update(const ScaledDot* dots, Progress& progress);

  const DotBox& BoxOf(std::int64_t block) const { return this->Tree[block]; }
  // The blocks with dots that may push those of the blocks [first, last), in their order.
  void FindNearby(std::int64_t first, std::int64_t last, std::vector<std::int64_t>& found) const;
  // Those of some blocks with dots that may push those of one.
  void Select(const std::vector<std::int64_t>& from, std::int64_t block,
    std::vector<std::int64_t>& found) const;

private:
  std::int64_t Dots;
  BlockTree<3> Tree;
};

} // namespace RectifiedTransport

#endif

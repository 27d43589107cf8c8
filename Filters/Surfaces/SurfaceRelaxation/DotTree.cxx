// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SurfaceRelaxation/DotTree.h"

#include "Core/Parallel/Progress.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

// The bounds of some dots, and the largest of their spacings h = 1 / Inverse.
DotBox boundsOf(const ScaledDot* first, const ScaledDot* last)
{
  constexpr double most = std::numeric_limits<double>::infinity();
  DotBox box{ { most, most, most }, { -most, -most, -most }, 0.0 };
  double inverse = most;
  for (const ScaledDot* dot = first; dot < last; ++dot)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      box.Low[axis] = std::min(box.Low[axis], dot->X[axis]);
      box.High[axis] = std::max(box.High[axis], dot->X[axis]);
    }
    // The largest spacing has the least inverse.
    inverse = std::min(inverse, dot->Inverse);
  }
  box.Largest = 1.0 / inverse;
  return box;
}

// Dots of spacings h and k push each other up to the squared distance R^2 h k.
bool isInReach(const DotBox& a, const DotBox& b)
{
  return squaredGap<3>(a, b) < squaredDotReach * a.Largest * b.Largest;
}

} // namespace

DotTree::DotTree(std::int64_t dots)
  : Dots(dots)
  , Tree((dots + dotBlock - 1) / dotBlock)
{
}

double DotTree::MemoryFor(std::int64_t dots)
{
  return BlockTree<3>::MemoryFor(static_cast<double>(dots) / dotBlock + 1.0);
}

void DotTree::Update(const ScaledDot* dots, Progress& progress)
{
  constexpr std::int64_t grain = 256;
  progress.ForEach(this->Blocks(), grain, [&](std::int64_t block) {
    this->Tree[block] =
      boundsOf(dots + block * dotBlock, dots + std::min((block + 1) * dotBlock, this->Dots));
  });
  progress.Check();
  // Leaves are independent; the boxes above them take a pass over the tree.
  this->Tree.Update();
  progress.Check();
}

// For a group of blocks at once: their common bounds find all blocks that may push any of them.
void DotTree::FindNearby(
  std::int64_t first, std::int64_t last, std::vector<std::int64_t>& found) const
{
  const DotBox target = this->Tree.BoundsOf(first, last);
  this->Tree.Find([&](const DotBox& box) { return isInReach(box, target); }, found);
}

void DotTree::Select(
  const std::vector<std::int64_t>& from, std::int64_t block, std::vector<std::int64_t>& found) const
{
  const DotBox target = this->BoxOf(block);
  found.resize(from.size());
  std::size_t count = 0;
  for (const std::int64_t other : from)
  {
    // Without a branch, which nobody can predict.
    found[count] = other;
    count += isInReach(this->BoxOf(other), target) ? 1 : 0;
  }
  found.resize(count);
}

} // namespace RectifiedTransport

// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SurfaceRelaxation/DotTree.h"

#include "Core/Parallel/Progress.h"

#include <limits>

namespace RectifiedTransport
{

namespace
{

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
    inverse = std::min(inverse, dot->Inverse);
  }
  box.Spacing = 1.0 / inverse;
  return box;
}

DotBox joined(const DotBox& a, const DotBox& b)
{
  DotBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.Low[axis] = std::min(a.Low[axis], b.Low[axis]);
    box.High[axis] = std::max(a.High[axis], b.High[axis]);
  }
  box.Spacing = std::max(a.Spacing, b.Spacing);
  return box;
}

double squaredGap(const DotBox& a, const DotBox& b)
{
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Not the maximum of a list: compilers keep that one in memory.
    const double above = a.Low[axis] - b.High[axis];
    const double below = b.Low[axis] - a.High[axis];
    const double most = above > below ? above : below;
    const double gap = most > 0.0 ? most : 0.0;
    squared += gap * gap;
  }
  return squared;
}

bool isInReach(const DotBox& a, const DotBox& b)
{
  return squaredGap(a, b) < squaredDotReach * a.Spacing * b.Spacing;
}

} // namespace

DotTree::DotTree(std::int64_t dots)
  : Dots(dots)
  , NumberOfBlocks((dots + dotBlock - 1) / dotBlock)
  , Leaves(this->NumberOfBlocks)
  , Nodes(std::max<std::int64_t>(2 * this->NumberOfBlocks - 1, 0))
{
}

double DotTree::MemoryFor(std::int64_t dots)
{
  return 3.0 * sizeof(DotBox) * (static_cast<double>(dots) / dotBlock + 1.0);
}

void DotTree::Update(const ScaledDot* dots, Progress& progress)
{
  constexpr std::int64_t grain = 256;
  progress.For(this->NumberOfBlocks, grain, [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t block = from; block < to; ++block)
    {
      this->Leaves.data()[block] =
        boundsOf(dots + block * dotBlock, dots + std::min((block + 1) * dotBlock, this->Dots));
    }
  });
  progress.Check();
  if (this->NumberOfBlocks > 0)
  {
    this->Join(0, this->NumberOfBlocks, 0);
  }
  progress.Check();
}

void DotTree::Join(std::int64_t node, std::int64_t blocks, std::int64_t first)
{
  if (blocks == 1)
  {
    this->Nodes.data()[node] = this->Leaves.data()[first];
    return;
  }
  const std::int64_t half = blocks / 2;
  this->Join(node + 1, half, first);
  this->Join(node + 2 * half, blocks - half, first + half);
  this->Nodes.data()[node] =
    joined(this->Nodes.data()[node + 1], this->Nodes.data()[node + 2 * half]);
}

void DotTree::FindInReach(
  std::int64_t first, std::int64_t last, std::vector<std::int64_t>& found) const
{
  struct Part
  {
    std::int64_t Node;
    std::int64_t Blocks;
    std::int64_t First;
  };
  DotBox target = this->BoxOf(first);
  for (std::int64_t block = first + 1; block < last; ++block)
  {
    target = joined(target, this->BoxOf(block));
  }
  found.clear();
  Part stack[64]; // more than the tree's depth
  int depth = 0;
  stack[depth++] = { 0, this->NumberOfBlocks, 0 };
  while (depth > 0)
  {
    const Part part = stack[--depth];
    if (!isInReach(this->Nodes.data()[part.Node], target))
    {
      continue;
    }
    if (part.Blocks == 1)
    {
      found.push_back(part.First);
      continue;
    }
    const std::int64_t half = part.Blocks / 2;
    stack[depth++] = { part.Node + 2 * half, part.Blocks - half, part.First + half };
    stack[depth++] = { part.Node + 1, half, part.First };
  }
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

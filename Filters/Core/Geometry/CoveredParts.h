// SPDX-License-Identifier: BSD-3-Clause
// Boxes of the cells of a lattice that finer cells cover.
#ifndef RectifiedTransport_CoveredParts_h
#define RectifiedTransport_CoveredParts_h

#include "Core/Geometry/LatticePart.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

// The coarse cells that a part of a fine lattice touches. Along each axis, `ratio` fine cells fit
// into a coarse one; floor(low / ratio) to floor((end - 1) / ratio).
template <int Dimension>
LatticePart<Dimension> coarsened(const LatticePart<Dimension>& fine, int ratio)
{
  const auto at = [ratio](std::int64_t cell) { // rounded down
    return (cell >= 0 ? cell : cell - ratio + 1) / ratio;
  };
  LatticePart<Dimension> coarse;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    coarse.Low[axis] = at(fine.Low[axis]);
    coarse.Cells[axis] = at(fine.End(axis) - 1) - coarse.Low[axis] + 1;
  }
  return coarse;
}

// Calls visit(i, covered) for cells of coarse[i] that parts of the finer lattice cover. The time is
// nearly linear in the parts unless some are much wider than others.
template <int Dimension, class Visit>
void visitCovered(const std::vector<LatticePart<Dimension>>& coarse,
  const std::vector<LatticePart<Dimension>>& fine, int ratio, const Visit& visit)
{
  std::vector<std::size_t> order(coarse.size()); // by their first cells along axis 0
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return coarse[a].Low[0] < coarse[b].Low[0]; });
  // No part begins farther than the widest one before the first covered cell: a binary search finds
  // where those begin that may reach it.
  std::int64_t widest = 0;
  for (const LatticePart<Dimension>& part : coarse)
  {
    widest = std::max(widest, part.Cells[0] - 1);
  }
  for (const LatticePart<Dimension>& part : fine)
  {
    const LatticePart<Dimension> covered = coarsened(part, ratio);
    auto next = std::lower_bound(order.begin(), order.end(), covered.Low[0] - widest,
      [&](std::size_t i, std::int64_t cell) { return coarse[i].Low[0] < cell; });
    for (; next != order.end() && coarse[*next].Low[0] < covered.End(0); ++next)
    {
      const LatticePart<Dimension> common = covered.And(coarse[*next]);
      if (!common.IsEmpty())
      {
        visit(*next, common);
      }
    }
  }
}

} // namespace RectifiedTransport

#endif
